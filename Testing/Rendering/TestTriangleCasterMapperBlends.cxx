// SPDX-License-Identifier: BSD-3-Clause
// The blend modes of the mapper of image data, beside VTK's. The caster itself has tests of its
// own.
#include "ImageScene.h"
#include "Observer.h"

#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkSphere.h"
#include "vtkTransform.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{

/// Of 255 steps: both pictures are rounded, and tables and textures of VTK's are.
constexpr int Tolerance = 3;

/// Distance of slices at which what VTK's mapper counts for the first and the last sample of a ray
/// is no more than the tolerance.
constexpr double Distance = 0.02;

/// Share of channels that may differ by more, where pixels at an edge show something or nothing:
/// one in 200 of the picture's 6,912 pixels.
constexpr double EdgeShare = 0.005;

vtkSmartPointer<vtkPlane> MakePlane(double x, double y, double z)
{
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetOrigin(6, 5, 4);
  plane->SetNormal(x, y, z);
  return plane;
}

/// A field of the scene's place with points an eighth as far apart. On a slice, the texture
/// coordinates of VTK's mapper are those of cells instead of points, which moves scalars by up to
/// half a spacing.
vtkSmartPointer<vtkImageData> MakeFineImage()
{
  constexpr int Points = 8;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(Points * (ImageSize[0] - 1) + 1, Points * (ImageSize[1] - 1) + 1,
    Points * (ImageSize[2] - 1) + 1);
  image->SetSpacing(1. / Points, 1. / Points, 1. / Points);
  image->AllocateScalars(VTK_FLOAT, 1);
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    const double* x = image->GetPoint(p);
    image->GetPointData()->GetScalars()->SetTuple1(
      p, 50 + 25 * (std::sin(0.3 * x[0]) + std::cos(0.4 * x[1] + 0.2 * x[2])));
  }
  return image;
}

struct BlendCase
{
  const char* Name;
  int Blend;
  std::function<void(ImageScene&)> SetUp;
  double Share; ///< of channels that may differ by more than the tolerance
};

void PrintTo(const BlendCase& blend, std::ostream* os) { *os << blend.Name; }

class Blends : public testing::TestWithParam<BlendCase>
{
};

TEST_P(Blends, PictureIsThatOfVTK)
{
  for (const bool parallel : { false, true })
  {
    ImageScene scene;
    scene.Renderer->SetBackground(0.1, 0.3, 0.2);
    scene.Renderer->GetActiveCamera()->SetParallelProjection(parallel);
    scene.Renderer->GetActiveCamera()->SetParallelScale(10);
    scene.Mapper->SetSampleDistance(Distance);
    scene.Mapper->SetBlendMode(GetParam().Blend);
    GetParam().SetUp(scene);
    const MessageObserver messages(
      scene.Mapper, { vtkCommand::ErrorEvent, vtkCommand::WarningEvent });
    scene.Window->Render();
    EXPECT_EQ(messages.Text, "");
    EXPECT_EQ(
      scene.Get("blend_mode"), "\"" + std::string(scene.Mapper->GetBlendModeAsString()) + "\"");
    const std::vector<int> picture = scene.Grab();
    const std::vector<int> expected = GrabOfVTK(scene);
    EXPECT_LE(FindShareAbove(picture, expected, Tolerance), GetParam().Share) << parallel;
  }
}

const std::function<void(ImageScene&)> Nothing = [](ImageScene&) {};

const std::vector<BlendCase> BlendCases = {
  { "Composite", vtkVolumeMapper::COMPOSITE_BLEND, Nothing, 0 },
  { "Maximum", vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, Nothing, 0 },
  { "Minimum", vtkVolumeMapper::MINIMUM_INTENSITY_BLEND,
    [](ImageScene& scene) { scene.Opacity->AddPoint(0, 0.8); }, 0 },
  { "Average", vtkVolumeMapper::AVERAGE_INTENSITY_BLEND, Nothing, 0 },
  { "AverageOfARange", vtkVolumeMapper::AVERAGE_INTENSITY_BLEND,
    [](ImageScene& scene) { scene.Mapper->SetAverageIPScalarRange(65, 85); }, EdgeShare },
  { "Additive", vtkVolumeMapper::ADDITIVE_BLEND, Nothing, 0 },
  { "Isosurfaces", vtkVolumeMapper::ISOSURFACE_BLEND,
    [](ImageScene& scene)
    {
      scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 75);
      scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(1, 60);
    },
    EdgeShare },
  { "Slice", vtkVolumeMapper::SLICE_BLEND,
    [](ImageScene& scene)
    {
      scene.Mapper->SetInputData(MakeFineImage());
      scene.Volume->GetProperty()->SetSliceFunction(MakePlane(0.3, 0.2, 1));
    },
    EdgeShare },
  // In world coordinates: the plane does not move with the volume.
  { "SliceOfAMovedVolume", vtkVolumeMapper::SLICE_BLEND,
    [](ImageScene& scene)
    {
      scene.Mapper->SetInputData(MakeFineImage());
      scene.Volume->GetProperty()->SetSliceFunction(MakePlane(0.3, 0.2, 1));
      scene.Volume->RotateZ(20);
      scene.Volume->AddPosition(1, 0, 2);
    },
    EdgeShare },
};

INSTANTIATE_TEST_SUITE_P(TriangleCasterMapper, Blends, testing::ValuesIn(BlendCases),
  [](const testing::TestParamInfo<BlendCase>& info) { return std::string(info.param.Name); });

/// What a scene complains of, in one frame.
std::string RenderMessages(ImageScene& scene, unsigned long event)
{
  const MessageObserver messages(scene.Mapper, { event });
  scene.Mapper->Render(scene.Renderer, scene.Volume);
  return messages.Text;
}

TEST(TriangleCasterMapperBlends, SlicesNeedAPlane)
{
  ImageScene scene;
  scene.Window->Render(); // makes the context
  scene.Mapper->SetBlendModeToSlice();
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  const auto expect = [&](const char* text)
  {
    const std::string message = RenderMessages(scene, vtkCommand::ErrorEvent);
    EXPECT_NE(message.find(text), std::string::npos) << text << ": " << message;
    EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 0);
  };
  expect("SliceFunction, which is not set");
  property->SetSliceFunction(vtkSmartPointer<vtkSphere>::New());
  expect("a vtkSphere");
  const vtkSmartPointer<vtkPlane> plane = MakePlane(0, 0, 1);
  plane->SetTransform(vtkSmartPointer<vtkTransform>::New());
  property->SetSliceFunction(plane);
  expect("Transform");
  plane->SetTransform(static_cast<vtkAbstractTransform*>(nullptr));
  EXPECT_EQ(RenderMessages(scene, vtkCommand::ErrorEvent), "");
  // A plane that is moved is another one.
  const std::vector<float> before = scene.Render();
  plane->SetOrigin(6, 5, 6);
  EXPECT_GT(FindDifference(scene.Render(), before), 0.05);
}

TEST(TriangleCasterMapperBlends, IsosurfacesNeedValues)
{
  ImageScene scene;
  scene.Window->Render();
  scene.Mapper->SetBlendModeToIsoSurface();
  scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetNumberOfContours(0); // one, of 0, before
  EXPECT_NE(
    RenderMessages(scene, vtkCommand::ErrorEvent).find("IsoSurfaceValues"), std::string::npos);
  scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 60);
  EXPECT_EQ(RenderMessages(scene, vtkCommand::ErrorEvent), "");
  const std::vector<float> before = scene.Render();
  scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 70);
  EXPECT_GT(FindDifference(scene.Render(), before), 0.05);
}

TEST(TriangleCasterMapperBlends, RangesThatDescendAreRefused)
{
  ImageScene scene;
  scene.Window->Render();
  scene.Mapper->SetBlendModeToAverageIntensity();
  scene.Mapper->SetAverageIPScalarRange(70, 60);
  EXPECT_NE(
    RenderMessages(scene, vtkCommand::ErrorEvent).find("does not ascend"), std::string::npos);
}

// Where all scalars are the same there is no grey between the least and the largest one.
TEST(TriangleCasterMapperBlends, AveragesOfAConstantVolumeAreBlack)
{
  ImageScene scene;
  scene.Mapper->SetInputData(MakeConstantImage(60));
  scene.Mapper->SetBlendModeToAverageIntensity();
  const std::vector<float> picture = scene.Render();
  const std::size_t middle = 4 * (static_cast<std::size_t>(36) * 96 + 48);
  EXPECT_EQ(picture[middle], 0);
  EXPECT_EQ(picture[middle + 3], 1);
}

TEST(TriangleCasterMapperBlends, IsosurfacesAreLit)
{
  ImageScene scene;
  scene.Mapper->SetBlendModeToIsoSurface();
  scene.Mapper->SetSampleDistance(Distance);
  scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 75);
  scene.Opacity->AddPoint(75, 1);
  const std::vector<float> flat = scene.Render();
  scene.Volume->GetProperty()->ShadeOn();
  EXPECT_EQ(RenderMessages(scene, vtkCommand::WarningEvent), "");
  EXPECT_GT(FindDifference(scene.Render(), flat), 0.1);
  EXPECT_EQ(scene.Get("left_out").find("shading"), std::string::npos);
}

TEST(TriangleCasterMapperBlends, WarnOfWhatCompositingHasOnly)
{
  ImageScene scene;
  vtkNew<vtkPiecewiseFunction> gradients;
  gradients->AddPoint(0, 0);
  gradients->AddPoint(10, 1);
  scene.Mapper->SetBlendModeToMaximumIntensity();
  const std::vector<float> expected = scene.Render();
  scene.Volume->GetProperty()->ShadeOn();
  scene.Volume->GetProperty()->SetGradientOpacity(gradients);
  scene.Mapper->PreIntegrationOn();
  const std::string text = RenderMessages(scene, vtkCommand::WarningEvent);
  EXPECT_NE(text.find("Shade is not used"), std::string::npos) << text;
  EXPECT_NE(text.find("gradient opacity is not used"), std::string::npos) << text;
  EXPECT_EQ(scene.Render(), expected);
  EXPECT_EQ(scene.Get("pre_integration"), "false");
}

} // namespace
