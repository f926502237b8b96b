// SPDX-License-Identifier: BSD-3-Clause
// Pictures do not depend on the unit of length of the world: each mapper, whatever rays gather and
// whatever camera sees it, gives the picture of scale 1.

#include "Observer.h"
#include "RayCastScene.h"

#include "vtkCellData.h"
#include "vtkContourValues.h"
#include "vtkCullerCollection.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkPlane.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{

using Factory = vtkSmartPointer<vtkTetrahedraVolumeMapper> (*)();

template <class Mapper>
vtkSmartPointer<vtkTetrahedraVolumeMapper> Make()
{
  return vtkSmartPointer<Mapper>::New();
}

// Of a channel: what scale 1 has is rounded otherwise. Distances, in sizes of the box.
constexpr double ColorTolerance = 2e-4;
constexpr double DepthTolerance = 2e-5;

// Centimetres of a galaxy are 3.1e21 a kiloparsec.
constexpr double Scales[] = { 1e-30, 1e-20, 1e-18, 1e18, 3.1e21, 1e30 };

class ScaledScene : public RayCastScene
{
public:
  ScaledScene(double size, bool parallel, Factory factory, const Vector& lower = { 0, 0, 0 })
    : RayCastScene(64, 48, { size * lower[0], size * lower[1], size * lower[2] }, size)
    , Subject(factory())
  {
    vtkNew<vtkDoubleArray> ofCells;
    ofCells->SetName("OfCells");
    for (std::size_t cell = 0; cell < this->Mesh.GetNumberOfCells(); ++cell)
    {
      ofCells->InsertNextValue(std::sin(1.7 * static_cast<double>(cell)));
    }
    this->Grid->GetCellData()->AddArray(ofCells);
    this->Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 0.2);
    this->Parallel = parallel;
    this->SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 });
    // Those of VTK leave out what is smaller than 1e-20.
    this->Renderer->GetCullers()->RemoveAllItems();
    this->Use(this->Subject);
  }

  vtkSmartPointer<vtkTetrahedraVolumeMapper> Subject;
};

struct Picture
{
  std::vector<float> Colors, Depths;
};

Picture Render(ScaledScene& scene)
{
  scene.Window->Render();
  const vtkIdType pixels = scene.Subject->GetOutputImage()->GetNumberOfPoints();
  return pixels == 0 ? Picture()
                     : Picture{ { scene.GetColors(), scene.GetColors() + 4 * pixels },
                         { scene.GetDepths(), scene.GetDepths() + pixels } };
}

void ExpectSame(const Picture& picture, double size, const Picture& expected)
{
  ASSERT_EQ(picture.Colors.size(), expected.Colors.size());
  ASSERT_FALSE(picture.Colors.empty());
  double worst = 0;
  double worstDepth = 0;
  std::size_t covered = 0;
  for (std::size_t k = 0; k < expected.Colors.size(); ++k)
  {
    ASSERT_TRUE(std::isfinite(picture.Colors[k]));
    worst = std::max<double>(worst, std::abs(picture.Colors[k] - expected.Colors[k]));
  }
  for (std::size_t k = 0; k < expected.Depths.size(); ++k)
  {
    covered += expected.Depths[k] != -1;
    ASSERT_EQ(picture.Depths[k] == -1, expected.Depths[k] == -1);
    if (expected.Depths[k] != -1)
    {
      worstDepth = std::max(worstDepth, std::abs(picture.Depths[k] / size - expected.Depths[k]));
    }
  }
  EXPECT_GT(covered, expected.Depths.size() / 5);
  EXPECT_LE(worst, ColorTolerance);
  EXPECT_LE(worstDepth, DepthTolerance);
}

class WorldScale : public testing::TestWithParam<Factory>
{
public:
  void ExpectAnyScale(const std::function<void(ScaledScene&)>& set)
  {
    for (const bool parallel : { false, true })
    {
      ScaledScene one(1, parallel, GetParam());
      set(one);
      const Picture expected = Render(one);
      for (const double scale : Scales)
      {
        SCOPED_TRACE((parallel ? "parallel, scale " : "perspective, scale ") +
          std::to_string(std::log10(scale)));
        ScaledScene scene(scale, parallel, GetParam());
        set(scene);
        ExpectSame(Render(scene), scale, expected);
      }
    }
  }
};

TEST_P(WorldScale, Composite)
{
  this->ExpectAnyScale([](ScaledScene&) {});
}

TEST_P(WorldScale, ScalarsAtCells)
{
  this->ExpectAnyScale(
    [](ScaledScene& scene)
    {
      scene.Subject->SetScalarModeToUseCellFieldData();
      scene.Subject->SelectScalarArray("OfCells");
    });
}

TEST_P(WorldScale, Isosurfaces)
{
  this->ExpectAnyScale([](ScaledScene& scene) { scene.Subject->SetBlendModeToIsoSurface(); });
}

// By a light near the box, which fades with the distance.
TEST_P(WorldScale, Lit)
{
  this->ExpectAnyScale(
    [](ScaledScene& scene)
    {
      vtkNew<vtkLight> light;
      light->SetPositional(true);
      light->SetConeAngle(90);
      light->SetPosition(1.5 * scene.Size, 2 * scene.Size, 1.2 * scene.Size);
      light->SetAttenuationValues(0.2, 0, 0.4 / (scene.Size * scene.Size));
      scene.Renderer->AddLight(light);
      scene.Volume->GetProperty()->ShadeOn();
    });
}

TEST_P(WorldScale, ClippedAndCropped)
{
  this->ExpectAnyScale(
    [](ScaledScene& scene)
    {
      const double s = scene.Size;
      // Not by the camera's range, which vtkCamera makes 1e-20 long at least.
      vtkNew<vtkPlane> plane;
      plane->SetOrigin(0.5 * s, 0.5 * s, 0.6 * s);
      plane->SetNormal(-0.2, -0.3, -0.7);
      scene.Subject->AddClippingPlane(plane);
      scene.Subject->CroppingOn();
      scene.Subject->SetCroppingRegionPlanes(0.2 * s, 0.7 * s, 0.3 * s, 0.8 * s, 0.1 * s, 0.6 * s);
      scene.Subject->SetCroppingRegionFlags(0x5ffffff);
    });
}

// Far from the origin, in sizes of the box.
TEST_P(WorldScale, FarFromTheOrigin)
{
  const Vector lower = { 1000, -3000, 2000 };
  ScaledScene one(1, false, GetParam(), lower);
  const Picture expected = Render(one);
  for (const double scale : { 1e-26, 1e-6, 1e6, 1e26 })
  {
    SCOPED_TRACE(scale);
    ScaledScene scene(scale, false, GetParam(), lower);
    ExpectSame(Render(scene), scale, expected);
  }
}

// What single precision can't hold is an error, not an empty picture.
TEST_P(WorldScale, OutOfRangeIsAnError)
{
  for (const double scale : { 1e-33, 1e33 })
  {
    ScaledScene scene(scale, false, GetParam());
    const MessageObserver errors(scene.Subject);
    scene.Window->Render();
    EXPECT_NE(errors.Text.find("too small or too large"), std::string::npos) << errors.Text;
    EXPECT_EQ(scene.Subject->GetOutputImage()->GetNumberOfPoints(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(AllMappers, WorldScale,
  testing::Values(&Make<vtkTetrahedraRayCastMapper>, &Make<vtkTetrahedraGPURayCastMapper>,
    &Make<vtkTetrahedraProjectionMapper>));

class WorldScaleOfSurfaces : public WorldScale
{
};

// By a light near the box, of which surfaces block some, and with what is nearby.
TEST_P(WorldScaleOfSurfaces, InShadows)
{
  this->ExpectAnyScale(
    [](ScaledScene& scene)
    {
      vtkNew<vtkLight> light;
      light->SetPositional(true);
      light->SetConeAngle(90);
      light->SetPosition(1.5 * scene.Size, 2 * scene.Size, 1.2 * scene.Size);
      scene.Renderer->AddLight(light);
      scene.Volume->GetProperty()->ShadeOn();
      auto* tracer = vtkTetrahedraIsosurfaceMapper::SafeDownCast(scene.Subject);
      tracer->ShadowsOn();
      tracer->AmbientOcclusionOn();
      tracer->SetAmbientOcclusionRadius(0.3 * scene.Size);
    });
}

INSTANTIATE_TEST_SUITE_P(
  Tracer, WorldScaleOfSurfaces, testing::Values(&Make<vtkTetrahedraIsosurfaceMapper>));

// Rays that a graphics card can't hold: the camera is beyond all single precision numbers.
TEST(WorldScaleOfRays, TooFarCameraIsAnError)
{
  ScaledScene scene(1, true, &Make<vtkTetrahedraGPURayCastMapper>);
  scene.SetCamera({ 0.5, 0.5, 1e40 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 1e39, 1e41);
  const MessageObserver errors(scene.Subject);
  scene.Window->Render();
  EXPECT_NE(errors.Text.find("the camera is too far"), std::string::npos) << errors.Text;
}

} // namespace
