// SPDX-License-Identifier: BSD-3-Clause
// The mapper of traced isosurfaces: its picture is the ray caster's, and what it has beyond it:
// colours of other arrays, shadows, ambient occlusion, depths for others, and time steps.
#include "Observer.h"
#include "OpenGLSnapshot.h"
#include "RayCastScene.h"
#include "Statistics.h"

#include "Generate/GeneratedMeshes.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{

/// Of a channel: what no screen shows.
constexpr double Invisible = 1. / 255;

/// Of a channel: what is composited and shaded in single precision.
constexpr double Rounding = 1e-5;

/// Of a distance, in world units: a depth buffer of 24 bits, from 1 to 6.
constexpr double DepthRounding = 1e-5;

class IsosurfaceScene : public RayCastScene
{
public:
  explicit IsosurfaceScene(int width = 96, int height = 72)
    : RayCastScene(width, height)
  {
    this->Tracer->AutoAdjustSampleDistancesOff();
    this->Use(this->Tracer);
    this->SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 }, 1, 6);
    this->SetSurfaces({ { -0.4, 0.5 }, { 0.3, 1 } });
  }

  /// Values and opacities, in ascending order.
  void SetSurfaces(const std::map<double, double>& surfaces)
  {
    this->Opacity->RemoveAllPoints();
    vtkContourValues* values = this->Volume->GetProperty()->GetIsoSurfaceValues();
    values->SetNumberOfContours(static_cast<int>(surfaces.size()));
    int index = 0;
    for (const auto& [value, opacity] : surfaces)
    {
      this->Opacity->AddPoint(value, opacity);
      values->SetValue(index++, value);
    }
  }

  /// Shows another mesh, with surfaces at quarters of its range.
  void Show(const tetralux::GeneratedMesh& mesh)
  {
    const auto [least, largest] = std::minmax_element(mesh.Scalars.begin(), mesh.Scalars.end());
    const auto at = [lo = *least, hi = *largest](double share) { return lo + share * (hi - lo); };
    this->Grid = MakeGrid(mesh.Mesh, mesh.Scalars);
    this->Use(this->Tracer);
    this->SetSurfaces({ { at(0.25), 0.3 }, { at(0.5), 0.6 }, { at(0.75), 1 } });
    this->Color->RemoveAllPoints();
    this->Color->AddRGBPoint(at(0), 0.1, 0.3, 1);
    this->Color->AddRGBPoint(at(1), 1, 0.8, 0.1);
    this->Renderer->ResetCamera();
  }

  /// Copies, which the next frame leaves alone.
  std::vector<float> Render()
  {
    this->Window->Render();
    const vtkIdType size = 4 * this->GetMapper()->GetOutputImage()->GetNumberOfPoints();
    return size == 0 ? std::vector<float>()
                     : std::vector<float>(this->GetColors(), this->GetColors() + size);
  }

  /// The ray caster's picture of the same.
  std::vector<float> RenderByRays()
  {
    this->Use(this->Mapper);
    this->Mapper->SetBlendModeToIsoSurface();
    this->Mapper->SetSmoothShading(this->Tracer->GetSmoothShading());
    this->Mapper->SetClippingPlanes(this->Tracer->GetClippingPlanes());
    this->Mapper->SetCropping(this->Tracer->GetCropping());
    this->Mapper->SetCroppingRegionPlanes(this->Tracer->GetCroppingRegionPlanes());
    this->Mapper->SetCroppingRegionFlags(this->Tracer->GetCroppingRegionFlags());
    std::vector<float> colors = this->Render();
    this->Use(this->Tracer);
    return colors;
  }

  void ExpectPictureOfRays(const std::string& name)
  {
    ExpectSamePicture(this->Render(), this->RenderByRays(), Invisible, name.c_str());
  }

  void AddSphere(const Vector& center, double radius)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(center[0], center[1], center[2]);
    sphere->SetRadius(radius);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
  }

  /// One light alone, in the scene.
  void SetLight(const Vector& position)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(position[0], position[1], position[2]);
    light->SetFocalPoint(0.5, 0.5, 0.5);
    this->Renderer->RemoveAllLights();
    this->Renderer->AddLight(light);
    this->Volume->GetProperty()->ShadeOn();
  }

  /// Where the depth buffer of the window says that a pixel's point is, in world coordinates;
  /// false where it is empty. i, j: of the viewport.
  bool FindPoint(int i, int j, double depth, double (&x)[3])
  {
    const int* origin = this->Renderer->GetOrigin();
    double point[4];
    this->Renderer->SetDisplayPoint(origin[0] + i + 0.5, origin[1] + j + 0.5, depth);
    this->Renderer->DisplayToWorld();
    this->Renderer->GetWorldPoint(point);
    for (int c = 0; c < 3; ++c)
    {
      x[c] = point[c] / point[3];
    }
    return depth < 1;
  }

  bool FindWindowPoint(int i, int j, double (&x)[3])
  {
    const int* origin = this->Renderer->GetOrigin();
    return this->FindPoint(i, j, this->Renderer->GetZ(origin[0] + i, origin[1] + j), x);
  }

  /// Where the mapper's picture says that it is.
  bool FindPicturePoint(int i, int j, double (&x)[3])
  {
    const int width = this->Tracer->GetOutputImage()->GetDimensions()[0];
    const double distance = this->GetDepths()[width * j + i];
    double nearer[3], farther[3], direction[3];
    this->FindPoint(i, j, 0, nearer);
    this->FindPoint(i, j, 1, farther);
    vtkMath::Subtract(farther, nearer, direction);
    vtkMath::Normalize(direction);
    double start[3];
    this->Renderer->GetActiveCamera()->GetPosition(start);
    if (this->Parallel)
    {
      // From the plane through the camera.
      double offset[3];
      vtkMath::Subtract(nearer, start, offset);
      const double along = vtkMath::Dot(offset, direction);
      for (int c = 0; c < 3; ++c)
      {
        start[c] = nearer[c] - along * direction[c];
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      x[c] = start[c] + distance * direction[c];
    }
    return distance >= 0;
  }

  std::int64_t CountWindowDepths()
  {
    const int* size = this->Tracer->GetOutputImage()->GetDimensions();
    std::int64_t count = 0;
    double x[3];
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        count += this->FindWindowPoint(i, j, x);
      }
    }
    return count;
  }

  /// A member of a section of the statistics of the last frame, as JSON in one line.
  std::string Get(const char* section, const char* name)
  {
    return tetralux::Json::parse(this->Tracer->GetStatistics()).at(section).at(name).dump();
  }

  /// Renders, and says what was rebuilt of the hierarchy.
  std::string RenderAndGetRebuilt()
  {
    this->Window->Render();
    return this->Get("hierarchy", "rebuilt");
  }

  vtkNew<vtkTetrahedraIsosurfaceMapper> Tracer;
};

/// The error that frames give, once.
void ExpectErrorOnce(IsosurfaceScene& scene, const std::vector<std::string>& words)
{
  std::vector<std::string> errors;
  const Observer observer(scene.Tracer, vtkCommand::ErrorEvent,
    [&errors](const char* text) { errors.emplace_back(text); });
  scene.Window->Render();
  scene.Window->Render();
  ASSERT_EQ(errors.size(), 1u);
  for (const std::string& word : words)
  {
    EXPECT_NE(errors[0].find(word), std::string::npos) << errors[0];
  }
  EXPECT_EQ(scene.Tracer->GetOutputImage()->GetNumberOfPoints(), 0);
  EXPECT_EQ(scene.Tracer->GetStatistics(), "{}");
}

/// The largest amount by which a channel of one picture is above that of another.
double FindLargestExcess(const std::vector<float>& a, const std::vector<float>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    largest = std::max(largest, static_cast<double>(a[i]) - b[i]);
  }
  return largest;
}

double Sum(const std::vector<float>& values)
{
  double sum = 0;
  for (const float value : values)
  {
    sum += value;
  }
  return sum;
}

TEST(IsosurfaceMapper, PictureIsThatOfTheRayCaster)
{
  const std::vector<std::pair<std::string, std::map<std::string, double>>> meshes = {
    { "ball", { { "cells", 10 } } },
    { "cylinder-with-hole", { { "across", 3 }, { "around", 24 }, { "along", 8 } } },
    { "gear", { { "teeth", 5 }, { "across", 3 }, { "along", 3 } } },
    { "boundary-layer", { { "cells", 6 }, { "layers", 8 } } },
    { "cavity", { { "cells", 8 } } },
    { "checkerboard", { { "blocks", 3 }, { "cells", 3 } } },
    { "shared-edge", { { "cells", 5 } } },
  };
  for (const auto& [name, parameters] : meshes)
  {
    IsosurfaceScene scene;
    scene.Show(tetralux::GenerateMesh(name, parameters));
    scene.ExpectPictureOfRays(name + " flat colours");
    scene.Volume->GetProperty()->ShadeOn();
    for (const bool parallel : { false, true })
    {
      scene.Renderer->GetActiveCamera()->SetParallelProjection(parallel);
      scene.Renderer->ResetCamera();
      for (const bool smooth : { false, true })
      {
        scene.Tracer->SetSmoothShading(smooth);
        scene.ExpectPictureOfRays(
          name + (parallel ? " parallel" : " perspective") + (smooth ? " smooth" : " faceted"));
      }
    }
  }
}

TEST(IsosurfaceMapper, ClippingAndCropping)
{
  IsosurfaceScene scene;
  scene.Volume->GetProperty()->ShadeOn();
  const std::vector<float> whole = scene.Render();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.5, 0.5, 0.5);
  plane->SetNormal(1, 2, -3);
  scene.Tracer->AddClippingPlane(plane);
  const std::vector<float> clipped = scene.Render();
  EXPECT_NE(clipped, whole);
  scene.ExpectPictureOfRays("clipped");
  scene.Tracer->CroppingOn();
  scene.Tracer->SetCroppingRegionPlanes(0.2, 0.7, 0.35, 0.8, 0.3, 0.6);
  scene.Tracer->SetCroppingRegionFlagsToFence();
  EXPECT_NE(scene.Render(), clipped);
  scene.ExpectPictureOfRays("clipped and cropped");
  scene.Tracer->RemoveAllClippingPlanes();
  scene.ExpectPictureOfRays("cropped");
}

TEST(IsosurfaceMapper, OpaqueGeometry)
{
  const std::vector<std::pair<std::string, Vector>> places = { { "in front", { 1.3, 1, 1.7 } },
    { "inside", { 0.5, 0.5, 0.6 } }, { "behind", { -0.4, 0, -0.7 } } };
  for (const auto& [name, center] : places)
  {
    IsosurfaceScene scene;
    const std::vector<float> alone = scene.Render();
    scene.AddSphere(center, 0.25);
    const std::vector<float> picture = scene.Render();
    EXPECT_EQ(picture == alone, name == "behind");
    EXPECT_LE(FindLargestExcess(picture, alone), 0) << name << " only takes away";
    scene.ExpectPictureOfRays(name);
    scene.Tracer->IntermixIntersectingGeometryOff();
    EXPECT_EQ(scene.Render(), alone) << name;
  }
}

TEST(IsosurfaceMapper, PictureDoesNotDependOnThreads)
{
  IsosurfaceScene scene;
  scene.SetLight({ 3, 3, 0 });
  scene.Tracer->ShadowsOn();
  scene.Tracer->AmbientOcclusionOn();
  scene.Tracer->SetMaximumSamples(4);
  scene.Tracer->SetNumberOfThreads(1);
  const std::vector<float> one = scene.Render();
  for (const int threads : { 2, 5 })
  {
    scene.Tracer->SetNumberOfThreads(threads);
    EXPECT_EQ(scene.Render(), one) << threads;
    EXPECT_EQ(scene.Get("rays", "threads"), std::to_string(threads));
  }
}

TEST(IsosurfaceMapper, OtherBlendModesAreRefused)
{
  vtkNew<vtkTetrahedraIsosurfaceMapper> mapper;
  int errors = 0;
  std::string last;
  const Observer observer(mapper, vtkCommand::ErrorEvent,
    [&](const char* text)
    {
      ++errors;
      last = text;
    });
  const vtkMTimeType time = mapper->GetMTime();
  mapper->SetBlendModeToIsoSurface();
  EXPECT_EQ(errors, 0);
  mapper->SetBlendModeToComposite();
  EXPECT_EQ(errors, 1);
  EXPECT_NE(last.find("isosurface (5)"), std::string::npos) << last;
  for (const int mode : { -1, 1, 2, 3, 4, 6, 16 })
  {
    errors = 0;
    mapper->SetBlendMode(mode);
    EXPECT_EQ(errors, 1) << mode;
  }
  EXPECT_EQ(mapper->GetBlendMode(), vtkTetrahedraVolumeMapper::ISOSURFACE_BLEND);
  EXPECT_STREQ(mapper->GetBlendModeAsString(), "isosurface");
  EXPECT_EQ(mapper->GetMTime(), time);
}

TEST(IsosurfaceMapper, ScalarsAtCellsAreAnError)
{
  IsosurfaceScene scene;
  const std::vector<float> before = scene.Render();
  vtkNew<vtkDoubleArray> array;
  array->SetName("OfCells");
  for (vtkIdType cell = 0; cell < scene.Grid->GetNumberOfCells(); ++cell)
  {
    array->InsertNextValue(static_cast<double>(cell));
  }
  scene.Grid->GetCellData()->AddArray(array);
  scene.Tracer->SetScalarModeToUseCellFieldData();
  scene.Tracer->SelectScalarArray("OfCells");
  ExpectErrorOnce(scene, { "points" });
  // Nothing of it is left.
  scene.Tracer->SetScalarModeToUsePointFieldData();
  scene.Tracer->SelectScalarArray("Field");
  EXPECT_EQ(scene.Render(), before);
}

TEST(IsosurfaceMapper, NoIsosurfaceValuesAreAnError)
{
  IsosurfaceScene scene;
  const std::vector<float> before = scene.Render();
  scene.SetSurfaces({});
  scene.Opacity->AddPoint(0, 1);
  ExpectErrorOnce(scene, { "IsoSurfaceValues" });
  scene.SetSurfaces({ { -0.4, 0.5 }, { 0.3, 1 } });
  EXPECT_EQ(scene.Render(), before);
}

/// An array of the points themselves, and colours of which red is half of the scalar.
void AddPlaces(IsosurfaceScene& scene)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Place");
  array->SetNumberOfComponents(3);
  for (vtkIdType p = 0; p < scene.Grid->GetNumberOfPoints(); ++p)
  {
    array->InsertNextTuple(scene.Grid->GetPoint(p));
  }
  scene.Grid->GetPointData()->AddArray(array);
  scene.SetSurfaces({ { 0.1, 1 } });
  scene.Color->RemoveAllPoints();
  scene.Color->AddRGBPoint(0, 0, 0.5, 1);
  scene.Color->AddRGBPoint(2, 1, 0.5, 0);
}

TEST(IsosurfaceMapper, ColorsOfAnotherArray)
{
  IsosurfaceScene scene;
  AddPlaces(scene);
  scene.Tracer->SetColorArrayName("Place");
  // Components are linear in cells, the magnitude is not: cells are up to a third in size.
  constexpr double Linear = 1e-4;
  constexpr double Bent = 0.05;
  for (const int component : { 0, 1, 2, -1 })
  {
    scene.Tracer->SetColorArrayComponent(component);
    const std::vector<float> colors = scene.Render();
    double largest = 0;
    int hits = 0;
    for (int j = 0; j < 72; ++j)
    {
      for (int i = 0; i < 96; ++i)
      {
        double x[3];
        if (scene.FindPicturePoint(i, j, x))
        {
          ++hits;
          const double value = component < 0 ? vtkMath::Norm(x) : x[component];
          const float* rgba = &colors[4 * (96 * j + i)];
          EXPECT_EQ(rgba[3], 1);
          largest = std::max({ largest, std::abs(rgba[0] - value / 2), std::abs(rgba[1] - 0.5),
            std::abs(rgba[2] - (1 - value / 2)) });
        }
      }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LT(largest, component < 0 ? Bent : Linear) << component;
  }

  // Opacity is that of the array, too: nothing is left below 0.5.
  scene.Tracer->SetColorArrayComponent(0);
  scene.Opacity->RemoveAllPoints();
  scene.Opacity->AddPoint(0.5, 0);
  scene.Opacity->AddPoint(0.5 + Linear, 1);
  const std::vector<float> colors = scene.Render();
  int hits = 0;
  for (std::size_t i = 0; i < colors.size(); i += 4)
  {
    hits += colors[i + 3] > 0;
    EXPECT_TRUE(colors[i + 3] == 0 || colors[i] > 0.25 - Linear) << colors[i];
  }
  EXPECT_GT(hits, 500);
}

TEST(IsosurfaceMapper, ColorsOfTheSurfacesAgain)
{
  IsosurfaceScene scene;
  AddPlaces(scene);
  const std::vector<float> own = scene.Render();
  scene.Tracer->SetColorArrayName("Place");
  EXPECT_NE(scene.Render(), own);
  EXPECT_EQ(GetStatistic(scene.Tracer, "rebuilt"), "[\"colours\"]");
  scene.Tracer->SetColorArrayName(nullptr);
  EXPECT_EQ(scene.Render(), own);
  // Of the surface's own array: the same colours.
  scene.Tracer->SetColorArrayName("Field");
  ExpectSamePicture(scene.Render(), own, Rounding, "own array");
}

TEST(IsosurfaceMapper, ColorsThatAreNotThereAreAnError)
{
  IsosurfaceScene scene;
  AddPlaces(scene);
  const std::vector<float> own = scene.Render();
  scene.Tracer->SetColorArrayName("Temperature");
  ExpectErrorOnce(scene, { "colour", "Temperature", "Field", "Place" });
  scene.Tracer->SetColorArrayName("Place");
  scene.Tracer->SetColorArrayComponent(3);
  ExpectErrorOnce(scene, { "colour", "Place", "3" });
  scene.Tracer->SetColorArrayName(nullptr);
  EXPECT_EQ(scene.Render(), own);
}

TEST(IsosurfaceMapper, ShadowsDarken)
{
  IsosurfaceScene scene;
  scene.SetLight({ -3, 4, 1 });
  const std::vector<float> lit = scene.Render();
  EXPECT_NE(scene.Tracer->GetStatistics().find("\"shadows\": \"they are off\""), std::string::npos);
  scene.Tracer->ShadowsOn();
  const std::vector<float> dark = scene.Render();
  EXPECT_EQ(scene.Tracer->GetStatistics().find("they are off"), std::string::npos);
  EXPECT_LE(FindLargestExcess(dark, lit), 0);
  EXPECT_GT(FindLargestExcess(lit, dark), 0.2);
  // A light that is off casts none, and VTK makes no other one.
  scene.Renderer->AutomaticLightCreationOff();
  scene.Renderer->GetLights()->InitTraversal();
  scene.Renderer->GetLights()->GetNextItem()->SwitchOff();
  const std::vector<float> unlit = scene.Render();
  scene.Tracer->ShadowsOff();
  EXPECT_EQ(scene.Render(), unlit);
  // Without Shade there is no light to block.
  scene.Volume->GetProperty()->ShadeOff();
  const std::vector<float> flat = scene.Render();
  scene.Tracer->ShadowsOn();
  EXPECT_EQ(scene.Render(), flat);
}

TEST(IsosurfaceMapper, LightAtTheCameraCastsNoShadows)
{
  for (const bool parallel : { false, true })
  {
    IsosurfaceScene scene;
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    light->SetPositional(!parallel);
    light->SetConeAngle(90);
    scene.Renderer->AddLight(light);
    scene.Volume->GetProperty()->ShadeOn();
    scene.SetSurfaces({ { -0.4, 1 }, { 0.3, 1 } });
    scene.Renderer->GetActiveCamera()->SetParallelProjection(parallel);
    const std::vector<float> lit = scene.Render();
    scene.Tracer->ShadowsOn();
    EXPECT_EQ(scene.Render(), lit) << parallel;
    EXPECT_GT(Sum(lit), 1000) << parallel;
  }
}

TEST(IsosurfaceMapper, RestingPicturesAreRefined)
{
  const auto turnOn = [](IsosurfaceScene& scene, bool occlusion)
  {
    scene.SetLight({ -3, 4, 1 });
    scene.Tracer->SetMaximumSamples(16);
    scene.Tracer->SetAmbientOcclusion(occlusion);
    scene.Tracer->SetAmbientOcclusionRadius(0.5);
    scene.Tracer->SetShadows(!occlusion);
    scene.Tracer->SetShadowSoftness(occlusion ? 0 : 30);
  };
  for (const bool occlusion : { true, false })
  {
    SCOPED_TRACE(occlusion ? "ambient occlusion" : "soft shadows");
    IsosurfaceScene scene;
    scene.SetLight({ -3, 4, 1 });
    const std::vector<float> lit = scene.Render();
    EXPECT_EQ(scene.Get("rays", "light_samples"), "0");
    turnOn(scene, occlusion);
    std::vector<std::vector<float>> pictures;
    for (const int samples : { 4, 8, 12, 16, 16, 16 })
    {
      pictures.push_back(scene.Render());
      EXPECT_EQ(scene.Get("rays", "light_samples"), std::to_string(samples));
      EXPECT_LE(FindLargestExcess(pictures.back(), lit), Rounding);
    }
    EXPECT_GT(FindLargestExcess(lit, pictures[0]), 0.1);
    EXPECT_NE(pictures[0], pictures[1]);
    EXPECT_NE(pictures[2], pictures[3]);
    EXPECT_EQ(pictures[3], pictures[4]);
    EXPECT_EQ(pictures[3], pictures[5]);

    // The same again, by another mapper.
    IsosurfaceScene other;
    turnOn(other, occlusion);
    for (int frame = 0; frame < 4; ++frame)
    {
      EXPECT_EQ(other.Render(), pictures[frame]) << frame;
    }

    // The first samples of a view that is new, and of the old one.
    vtkCamera* camera = scene.Renderer->GetActiveCamera();
    const Vector position = { camera->GetPosition()[0], camera->GetPosition()[1],
      camera->GetPosition()[2] };
    camera->SetPosition(position[0] + 0.1, position[1], position[2]);
    EXPECT_NE(scene.Render(), pictures[0]);
    EXPECT_EQ(scene.Get("rays", "light_samples"), "4");
    camera->SetPosition(position.data());
    EXPECT_EQ(scene.Render(), pictures[0]);
    EXPECT_EQ(scene.Render(), pictures[1]);
    // Whatever the picture follows from starts anew.
    scene.Volume->GetProperty()->SetAmbient(0.3);
    scene.Render();
    EXPECT_EQ(scene.Get("rays", "light_samples"), "4");
    scene.Tracer->SetSamplesPerFrame(16);
    scene.Render();
    EXPECT_EQ(scene.Get("rays", "light_samples"), "16");
  }
}

TEST(IsosurfaceMapper, FartherSurfacesOccludeMore)
{
  IsosurfaceScene scene;
  scene.SetLight({ 2, 3, 4 });
  scene.Tracer->AmbientOcclusionOn();
  scene.Tracer->SetSamplesPerFrame(32);
  double before = 0;
  for (const double radius : { 2., 0.5, 0.1, 1e-6 })
  {
    scene.Tracer->SetAmbientOcclusionRadius(radius);
    const double sum = Sum(scene.Render());
    EXPECT_GT(sum, before) << radius;
    before = sum;
  }
  scene.Tracer->AmbientOcclusionOff();
  EXPECT_NEAR(Sum(scene.Render()), before, 1e-3 * before);
}

TEST(IsosurfaceMapper, WindowHoldsDepthsOfOpaqueSurfaces)
{
  for (const bool parallel : { false, true })
  {
    for (const bool viewport : { false, true })
    {
      SCOPED_TRACE(std::string(parallel ? "parallel" : "perspective") +
        (viewport ? ", part of the window" : ""));
      IsosurfaceScene scene;
      scene.Parallel = parallel;
      scene.SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 }, 1, 6);
      scene.SetSurfaces({ { 0.3, 1 } });
      if (viewport)
      {
        scene.Renderer->SetViewport(0.25, 0.125, 1, 0.75);
      }
      scene.Window->Render();
      const int* size = scene.Tracer->GetOutputImage()->GetDimensions();
      ASSERT_EQ(size[0], viewport ? 72 : 96);
      double largest = 0;
      int hits = 0;
      for (int j = 0; j < size[1]; ++j)
      {
        for (int i = 0; i < size[0]; ++i)
        {
          double shown[3], expected[3];
          const bool found = scene.FindWindowPoint(i, j, shown);
          ASSERT_EQ(found, scene.FindPicturePoint(i, j, expected)) << i << " " << j;
          if (found)
          {
            ++hits;
            largest =
              std::max(largest, std::sqrt(vtkMath::Distance2BetweenPoints(shown, expected)));
          }
        }
      }
      EXPECT_GT(hits, 300);
      EXPECT_LT(largest, DepthRounding);
    }
  }
}

TEST(IsosurfaceMapper, WindowHoldsNoOtherDepths)
{
  IsosurfaceScene scene;
  scene.SetSurfaces({ { 0.3, 1 } });
  scene.Window->Render();
  const std::int64_t opaque = scene.CountWindowDepths();
  EXPECT_GT(opaque, 300);
  // A translucent surface in front changes nothing; alone, it has none.
  scene.SetSurfaces({ { -0.4, 0.5 }, { 0.3, 1 } });
  scene.Window->Render();
  EXPECT_EQ(scene.CountWindowDepths(), opaque);
  scene.SetSurfaces({ { -0.4, 0.5 }, { 0.3, 0.99 } });
  scene.Window->Render();
  EXPECT_EQ(scene.CountWindowDepths(), 0);
  scene.SetSurfaces({ { 0.3, 1 } });
  scene.Tracer->IntermixIntersectingGeometryOff();
  EXPECT_GT(Sum(scene.Render()), 300);
  EXPECT_EQ(scene.CountWindowDepths(), 0);
}

TEST(IsosurfaceMapper, VolumesBehindOpaqueSurfacesAreHidden)
{
  for (const bool opaque : { true, false })
  {
    IsosurfaceScene scene;
    scene.SetSurfaces({ { 0.3, opaque ? 1 : 0.5 } });
    const std::vector<float> front = scene.Render();

    // Another box behind, drawn after it.
    vtkNew<vtkTetrahedraRayCastMapper> mapper;
    mapper->AutoAdjustSampleDistancesOff();
    vtkNew<vtkUnstructuredGrid> moved;
    moved->DeepCopy(scene.Grid);
    for (vtkIdType p = 0; p < moved->GetNumberOfPoints(); ++p)
    {
      const double* x = scene.Grid->GetPoint(p);
      moved->GetPoints()->SetPoint(p, x[0] - 0.7, x[1] - 0.5, x[2] - 1.2);
    }
    mapper->SetInputData(moved);
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(-1, 0.5);
    opacity->AddPoint(1, 0.5);
    vtkNew<vtkVolume> volume;
    volume->SetMapper(mapper);
    volume->GetProperty()->SetColor(scene.Color);
    volume->GetProperty()->SetScalarOpacity(opacity);
    scene.Renderer->AddVolume(volume);
    EXPECT_EQ(scene.Render(), front) << "what is in front does not change";
    const auto* behind = static_cast<const float*>(
      mapper->GetOutputImage()->GetPointData()->GetArray("RGBA")->GetVoidPointer(0));
    int hidden = 0;
    int seen = 0;
    int throughTheFront = 0;
    for (std::size_t i = 3; i < front.size(); i += 4)
    {
      hidden += front[i] == 1 && behind[i] == 0;
      throughTheFront += front[i] > 0 && behind[i] > 0;
      seen += behind[i] > 0;
    }
    EXPECT_GT(seen, 500);
    EXPECT_EQ(hidden > 300, opaque);
    EXPECT_EQ(throughTheFront > 0, !opaque) << throughTheFront;
  }
}

TEST(IsosurfaceMapper, MaximumNumberOfPeels)
{
  IsosurfaceScene scene;
  scene.SetSurfaces({ { -0.4, 0.5 }, { 0, 0.5 }, { 0.3, 0.5 } });
  const std::vector<float> all = scene.Render();
  EXPECT_EQ(scene.Get("rays", "rays_ended_at_last_layer"), "0");
  EXPECT_TRUE(scene.Tracer->IsMaximumErrorKept());
  scene.Tracer->SetMaximumNumberOfPeels(1000);
  EXPECT_EQ(scene.Render(), all);

  // Less than what was asked for is said to be.
  const MessageObserver warnings(scene.Tracer, { vtkCommand::WarningEvent });
  const auto findLargest = [](const std::vector<float>& colors)
  {
    float largest = 0;
    for (std::size_t i = 3; i < colors.size(); i += 4)
    {
      largest = std::max(largest, colors[i]);
    }
    return largest;
  };
  EXPECT_GT(findLargest(all), 0.8);
  double opacity = 0;
  for (const int peels : { 1, 2 })
  {
    opacity += 0.5 * (1 - opacity);
    scene.Tracer->SetMaximumNumberOfPeels(peels);
    const std::vector<float> some = scene.Render();
    EXPECT_NEAR(findLargest(some), opacity, Rounding);
    EXPECT_NE(scene.Get("rays", "rays_ended_at_last_layer"), "0");
    EXPECT_FALSE(scene.Tracer->IsMaximumErrorKept());
    EXPECT_GE(scene.Tracer->GetErrorEstimate(), FindLargestExcess(all, some));
  }
  EXPECT_NE(warnings.Text.find("early_termination"), std::string::npos) << warnings.Text;
}

const char* const Nothing = "[]";

TEST(IsosurfaceMapper, RebuildsWhatTimeStepsChange)
{
  for (const bool keep : { true, false })
  {
    SCOPED_TRACE(keep);
    IsosurfaceScene scene;
    scene.Tracer->SetTimeStepCacheBytes(keep ? 1 << 20 : 0);
    EXPECT_EQ(scene.RenderAndGetRebuilt(), "[\"tree\",\"ranges\",\"isopolygons\"]");
    const std::vector<float> first = scene.Render();
    EXPECT_EQ(scene.RenderAndGetRebuilt(), Nothing);
    scene.Renderer->GetActiveCamera()->Azimuth(5);
    EXPECT_EQ(scene.RenderAndGetRebuilt(), Nothing);
    scene.Renderer->GetActiveCamera()->Azimuth(-5);

    auto* field = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetScalars());
    const auto negate = [field]
    {
      for (vtkIdType i = 0; i < field->GetNumberOfValues(); ++i)
      {
        field->SetValue(i, -field->GetValue(i));
      }
      field->Modified();
    };
    negate();
    EXPECT_EQ(scene.RenderAndGetRebuilt(), "[\"ranges\",\"isopolygons\"]");
    scene.ExpectPictureOfRays("other scalars");
    EXPECT_NE(scene.Render(), first);
    negate();
    EXPECT_EQ(scene.RenderAndGetRebuilt(), keep ? Nothing : "[\"ranges\",\"isopolygons\"]");
    EXPECT_EQ(scene.Render(), first);

    // A point in a corner.
    const auto move = [&scene](double x)
    {
      scene.Grid->GetPoints()->SetPoint(0, x, x, x);
      scene.Grid->GetPoints()->Modified();
    };
    move(-0.1);
    const std::string rebuilt = scene.RenderAndGetRebuilt();
    EXPECT_NE(rebuilt.find("boxes"), std::string::npos) << rebuilt;
    EXPECT_EQ(rebuilt.find("tree"), std::string::npos) << rebuilt;
    EXPECT_EQ(scene.Get("hierarchy", "time_steps"), keep ? "3" : "1");
    scene.ExpectPictureOfRays("other points");
    move(0);
    EXPECT_EQ(scene.RenderAndGetRebuilt() == Nothing, keep);
    EXPECT_EQ(scene.Render(), first);

    // Values are as camera and colours to what time steps keep, but for their polygons.
    scene.SetSurfaces({ { -0.3, 0.5 }, { 0.3, 1 } });
    EXPECT_EQ(scene.RenderAndGetRebuilt(), "[\"isopolygons\"]");
    scene.Color->AddRGBPoint(0, 1, 1, 1);
    EXPECT_EQ(scene.RenderAndGetRebuilt(), Nothing);
  }
}

TEST(IsosurfaceMapper, SeveralBlocks)
{
  IsosurfaceScene scene;
  vtkNew<vtkUnstructuredGrid> moved;
  moved->DeepCopy(scene.Grid);
  for (vtkIdType p = 0; p < moved->GetNumberOfPoints(); ++p)
  {
    double x[3];
    moved->GetPoint(p, x);
    moved->GetPoints()->SetPoint(p, x[0] - 1.2, x[1], x[2]);
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, scene.Grid);
  blocks->SetBlock(2, moved);
  scene.SetCamera({ 1.9, 1.4, 3.6 }, { 0, 0.5, 0.5 }, { 0.1, 1, 0 }, 1, 8);
  const std::vector<float> one = scene.Render();
  scene.Tracer->SetInputData(blocks);
  const std::vector<float> both = scene.Render();
  EXPECT_GT(Sum(both), 1.3 * Sum(one));
  scene.Mapper->SetBlendModeToIsoSurface();
  scene.Mapper->SetInputData(blocks);
  scene.Volume->SetMapper(scene.Mapper);
  scene.Window->Render();
  const auto* rays = static_cast<const float*>(
    scene.Mapper->GetOutputImage()->GetPointData()->GetArray("RGBA")->GetVoidPointer(0));
  ExpectSamePicture(both, { rays, rays + both.size() }, Invisible, "blocks");
}

TEST(IsosurfaceMapper, AbortedFramesAreNotDrawn)
{
  IsosurfaceScene scene;
  scene.SetSurfaces({ { 0.3, 1 } });
  scene.Renderer->SetBackground(0, 0, 1);
  scene.SetLight({ -3, 4, 1 });
  scene.Tracer->AmbientOcclusionOn();
  scene.Tracer->SetNumberOfThreads(1); // which reports every tile
  bool abort = true;
  const Observer progress(scene.Tracer, vtkCommand::VolumeMapperRenderProgressEvent,
    [&](const char*) { scene.Window->SetAbortRender(abort); });
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Tracer, "aborted"), "true");
  EXPECT_EQ(scene.Get("rays", "light_samples"), "0");
  EXPECT_EQ(scene.CountWindowDepths(), 0);
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(scene.Window);
  grab->ShouldRerenderOff();
  grab->ReadFrontBufferOff();
  grab->Update();
  for (int c = 0; c < 3; ++c)
  {
    double range[2];
    grab->GetOutput()->GetPointData()->GetScalars()->GetRange(range, c);
    EXPECT_EQ(range[0], c == 2 ? 255 : 0);
    EXPECT_EQ(range[1], c == 2 ? 255 : 0);
  }
  // The next one is complete, and the first one of its mean.
  abort = false;
  const std::vector<float> picture = scene.Render();
  EXPECT_EQ(GetStatistic(scene.Tracer, "aborted"), "false");
  EXPECT_EQ(scene.Get("rays", "light_samples"), "4");
  EXPECT_GT(scene.CountWindowDepths(), 300);
  IsosurfaceScene other;
  other.SetSurfaces({ { 0.3, 1 } });
  other.SetLight({ -3, 4, 1 });
  other.Tracer->AmbientOcclusionOn();
  EXPECT_EQ(other.Render(), picture);
}

TEST(IsosurfaceMapper, LeavesOpenGLAsItWas)
{
  IsosurfaceScene scene;
  scene.SetSurfaces({ { 0.3, 1 } });
  scene.Window->Render(); // makes the context
  OpenGLSnapshot before;
  OpenGLSnapshot after;
  const Observer start(scene.Tracer, vtkCommand::VolumeMapperRenderStartEvent,
    [&](const char*) { before = TakeOpenGLSnapshot(scene.Window); });
  const Observer end(scene.Tracer, vtkCommand::VolumeMapperRenderEndEvent,
    [&](const char*) { after = TakeOpenGLSnapshot(scene.Window); });
  scene.Renderer->PreserveDepthBufferOn(); // so that depths are read
  scene.Window->Render();
  EXPECT_EQ(FindDifferences(before, after), "");
  EXPECT_GT(scene.CountWindowDepths(), 300);
}

// Pictures made of tiles, as vtkWindowToImageFilter does for prints.
TEST(IsosurfaceMapper, TilesMakeOnePicture)
{
  IsosurfaceScene scene(60, 50);
  scene.Renderer->SetBackground(0.2, 0.3, 0.4);
  scene.Volume->GetProperty()->ShadeOn();
  vtkNew<vtkWindowToImageFilter> tiles;
  tiles->SetInput(scene.Window);
  tiles->SetScale(2);
  tiles->Update();
  scene.Window->SetSize(120, 100);
  vtkNew<vtkWindowToImageFilter> whole;
  whole->SetInput(scene.Window);
  whole->Update();
  ASSERT_EQ(tiles->GetOutput()->GetNumberOfPoints(), whole->GetOutput()->GetNumberOfPoints());
  const auto* a = static_cast<const unsigned char*>(tiles->GetOutput()->GetScalarPointer());
  const auto* b = static_cast<const unsigned char*>(whole->GetOutput()->GetScalarPointer());
  int largest = 0;
  int brightest = 0;
  for (vtkIdType i = 0; i < 3 * whole->GetOutput()->GetNumberOfPoints(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
    brightest = std::max<int>(brightest, b[i]);
  }
  EXPECT_LE(largest, 1);
  EXPECT_GT(brightest, 150);
}

// One mapper in two viewports: each has the picture and the depths of a window of its own.
TEST(IsosurfaceMapper, Viewports)
{
  IsosurfaceScene alone(48, 72);
  alone.SetSurfaces({ { 0.3, 1 } });
  const std::vector<float> expected = alone.Render();
  const std::int64_t depths = alone.CountWindowDepths();
  IsosurfaceScene scene(96, 72);
  scene.SetSurfaces({ { 0.3, 1 } });
  scene.Renderer->SetViewport(0.5, 0, 1, 1);
  vtkNew<vtkRenderer> left;
  left->SetViewport(0, 0, 0.5, 1);
  left->AddVolume(scene.Volume);
  left->SetActiveCamera(scene.Renderer->GetActiveCamera());
  scene.Window->AddRenderer(left);
  ExpectSamePicture(scene.Render(), expected, Rounding, "the last viewport");
  EXPECT_EQ(scene.CountWindowDepths(), depths);
  std::int64_t found = 0;
  for (int j = 0; j < 72; ++j)
  {
    for (int i = 0; i < 48; ++i)
    {
      found += left->GetZ(i, j) < 1;
    }
  }
  EXPECT_EQ(found, depths);
}

TEST(IsosurfaceMapper, SampleDistance)
{
  IsosurfaceScene scene(80, 60);
  scene.SetSurfaces({ { 0.3, 1 } });
  scene.Tracer->SetImageSampleDistance(2);
  const std::vector<float> coarse = scene.Render();
  const int* size = scene.Tracer->GetOutputImage()->GetDimensions();
  EXPECT_EQ(size[0], 40);
  EXPECT_EQ(size[1], 30);
  int found = 0;
  for (int j = 0; j < 60; ++j)
  {
    for (int i = 0; i < 80; ++i)
    {
      found += scene.Renderer->GetZ(i, j) < 1;
    }
  }
  // As the picture of a window of that size, of which each depth is that of four pixels.
  scene.Tracer->SetImageSampleDistance(1);
  scene.Window->SetSize(40, 30);
  ExpectSamePicture(scene.Render(), coarse, Rounding, "coarse");
  EXPECT_EQ(found, 4 * scene.CountWindowDepths());
  EXPECT_GT(found, 200);
}

TEST(IsosurfaceMapper, SeveralWindows)
{
  vtkNew<vtkTetrahedraIsosurfaceMapper> mapper;
  IsosurfaceScene first;
  const std::vector<float> expected = first.Render();
  {
    IsosurfaceScene second;
    for (IsosurfaceScene* scene : { &first, &second, &first, &second })
    {
      scene->Use(mapper);
      EXPECT_EQ(scene->Render(), expected);
    }
    second.Window->Finalize();
  }
  EXPECT_EQ(first.Render(), expected);
  mapper->ReleaseGraphicsResources(first.Window);
  EXPECT_EQ(first.Render(), expected);
}

TEST(IsosurfaceMapper, PrintsEveryPropertyAndTheLastFrame)
{
  IsosurfaceScene scene;
  scene.Tracer->SetColorArrayName("Field");
  scene.Window->Render();
  std::ostringstream stream;
  scene.Tracer->Print(stream);
  const std::string text = stream.str();
  for (const char* line :
    { "ColorArrayName: Field", "ColorArrayComponent: magnitude", "Shadows: Off",
      "ShadowSoftness: 0", "AmbientOcclusion: Off", "AmbientOcclusionRadius: automatic",
      "SamplesPerFrame: 4", "MaximumSamples: 256", "TimeStepCacheBytes: 268435456",
      "MaximumNumberOfPeels: automatic", "NumberOfThreads: automatic", "MaximumError: 0.0001",
      "SmoothShading: On", "MergePoints: automatic", "VectorMode: disabled", "VectorComponent: 0",
      "IntermixIntersectingGeometry: On", "Cropping: Off", "CroppingRegionPlanes: 0, 1",
      "CroppingRegionFlags: sub-volume", "AutoAdjustSampleDistances: Off", "ImageSampleDistance: 1",
      "MinimumImageSampleDistance: 1", "MaximumImageSampleDistance: 10",
      "Statistics:\n    {\n      \"method\": \"isosurface\"" })
  {
    EXPECT_NE(text.find("\n  " + std::string(line)), std::string::npos) << line << "\n" << text;
  }
}

} // namespace
