// SPDX-License-Identifier: BSD-3-Clause
// The mapper of traced isosurfaces: its picture is the ray caster's; colours of other arrays, time
// steps, and what it refuses.
#include "IsosurfaceScene.h"
#include "Observer.h"
#include "Statistics.h"

#include "Generate/GeneratedMeshes.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlane.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{

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
  // Each by its own mapper: one that has all samples shows their mean and traces no light.
  const auto render = [](int threads)
  {
    IsosurfaceScene scene;
    scene.SetLight({ 3, 3, 0 });
    scene.Tracer->ShadowsOn();
    scene.Tracer->AmbientOcclusionOn();
    scene.Tracer->SetMaximumSamples(4);
    scene.Tracer->SetNumberOfThreads(threads);
    std::vector<float> picture = scene.Render();
    EXPECT_EQ(scene.Get("rays", "threads"), std::to_string(threads));
    return picture;
  };
  const std::vector<float> one = render(1);
  EXPECT_EQ(render(2), one);
  EXPECT_EQ(render(5), one);
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
  // Of the surfaces' own array: the same colours, below 0 too.
  scene.SetSurfaces({ { -0.4, 0.5 }, { 0.1, 1 } });
  scene.Color->AddRGBPoint(-1, 1, 0, 0);
  const std::vector<float> both = scene.Render();
  scene.Tracer->SetColorArrayName("Field");
  ExpectSamePicture(scene.Render(), both, Rounding, "own array");
}

TEST(IsosurfaceMapper, ColorsThatAreNoNumbersAreTransparent)
{
  IsosurfaceScene scene;
  AddPlaces(scene);
  scene.Tracer->SetColorArrayName("Place");
  scene.Tracer->SetColorArrayComponent(0);
  const std::vector<float> before = scene.Render();
  auto* place = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetArray("Place"));
  for (vtkIdType p = 0; p < place->GetNumberOfTuples(); ++p)
  {
    if (place->GetComponent(p, 0) > 0.5)
    {
      place->SetComponent(p, 0, std::numeric_limits<double>::quiet_NaN());
    }
  }
  place->Modified();
  const std::vector<float> after = scene.Render();
  int gone = 0;
  int left = 0;
  for (std::size_t i = 0; i < after.size(); i += 4)
  {
    ASSERT_TRUE(std::isfinite(after[i]));
    gone += before[i + 3] > 0 && after[i + 3] == 0;
    left += after[i + 3] > 0;
  }
  EXPECT_GT(gone, 100);
  EXPECT_GT(left, 100);
}

// Colours are kept with the steps whose values they are of.
TEST(IsosurfaceMapper, ColorsFollowTimeSteps)
{
  IsosurfaceScene scene;
  AddPlaces(scene);
  scene.Tracer->SetColorArrayName("Place");
  auto* place = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetArray("Place"));
  auto* field = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetScalars());
  const auto change = [](vtkDoubleArray* array, double factor)
  {
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      array->SetValue(i, array->GetValue(i) * factor);
    }
    array->Modified();
  };
  const auto expectFresh = [&scene](const char* what)
  {
    vtkNew<vtkTetrahedraIsosurfaceMapper> fresh;
    fresh->AutoAdjustSampleDistancesOff();
    fresh->SetColorArrayName("Place");
    const std::vector<float> picture = scene.Render();
    scene.Use(fresh);
    EXPECT_EQ(scene.Render(), picture) << what;
    scene.Use(scene.Tracer);
    return picture;
  };
  const std::vector<float> first = expectFresh("first");
  change(place, 0.5);
  EXPECT_NE(expectFresh("other colours"), first);
  change(field, -1);
  expectFresh("other scalars");
  change(place, 2);
  expectFresh("first colours on other scalars");
  change(field, -1);
  EXPECT_EQ(expectFresh("as the first"), first);
  scene.Grid->GetPoints()->SetPoint(0, -0.2, -0.2, -0.2);
  scene.Grid->GetPoints()->Modified();
  expectFresh("other points");
}

TEST(IsosurfaceMapper, PlacedInTheWorld)
{
  IsosurfaceScene scene;
  scene.Volume->GetProperty()->ShadeOn();
  scene.Volume->SetOrigin(0.5, 0.5, 0.5);
  scene.Volume->SetOrientation(40, 20, 70);
  scene.Volume->SetScale(1.1, 0.6, 0.8);
  scene.ExpectPictureOfRays("placed");
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.5, 0.5, 0.5);
  plane->SetNormal(1, 2, -3);
  scene.Tracer->AddClippingPlane(plane);
  scene.ExpectPictureOfRays("placed and clipped");
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

/// Renders, and says what was rebuilt of the hierarchy.
std::string RenderAndGetRebuilt(IsosurfaceScene& scene)
{
  scene.Window->Render();
  return scene.Get("hierarchy", "rebuilt");
}

TEST(IsosurfaceMapper, RebuildsWhatTimeStepsChange)
{
  for (const bool keep : { true, false })
  {
    SCOPED_TRACE(keep);
    IsosurfaceScene scene;
    scene.Tracer->SetTimeStepCacheBytes(keep ? 1 << 20 : 0);
    EXPECT_EQ(RenderAndGetRebuilt(scene), "[\"tree\",\"ranges\",\"isopolygons\"]");
    const std::vector<float> first = scene.Render();
    EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
    scene.Renderer->GetActiveCamera()->Azimuth(5);
    EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
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
    EXPECT_EQ(RenderAndGetRebuilt(scene), "[\"ranges\",\"isopolygons\"]");
    scene.ExpectPictureOfRays("other scalars");
    EXPECT_NE(scene.Render(), first);
    negate();
    EXPECT_EQ(RenderAndGetRebuilt(scene), keep ? Nothing : "[\"ranges\",\"isopolygons\"]");
    EXPECT_EQ(scene.Render(), first);

    // A point in a corner.
    const auto move = [&scene](double x)
    {
      scene.Grid->GetPoints()->SetPoint(0, x, x, x);
      scene.Grid->GetPoints()->Modified();
    };
    move(-0.1);
    const std::string rebuilt = RenderAndGetRebuilt(scene);
    EXPECT_NE(rebuilt.find("boxes"), std::string::npos) << rebuilt;
    EXPECT_EQ(rebuilt.find("tree"), std::string::npos) << rebuilt;
    EXPECT_EQ(scene.Get("hierarchy", "time_steps"), keep ? "3" : "1");
    scene.ExpectPictureOfRays("other points");
    move(0);
    EXPECT_EQ(RenderAndGetRebuilt(scene) == Nothing, keep);
    EXPECT_EQ(scene.Render(), first);

    // Values are as camera and colours to what time steps keep, but for their polygons.
    scene.SetSurfaces({ { -0.3, 0.5 }, { 0.3, 1 } });
    EXPECT_EQ(RenderAndGetRebuilt(scene), "[\"isopolygons\"]");
    scene.Color->AddRGBPoint(0, 1, 1, 1);
    EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  }
}

TEST(IsosurfaceMapper, ValuesInAnyOrder)
{
  IsosurfaceScene scene;
  scene.SetSurfaces({ { -0.4, 0.5 }, { 0, 0.3 }, { 0.3, 1 } });
  const std::vector<float> sorted = scene.Render();
  vtkContourValues* values = scene.Volume->GetProperty()->GetIsoSurfaceValues();
  values->SetValue(0, 0.3);
  values->SetValue(1, -0.4);
  values->SetValue(2, 0);
  EXPECT_EQ(scene.Render(), sorted);
  // One that no point reaches, and one that is there twice.
  values->SetValue(3, 7);
  EXPECT_EQ(scene.Render(), sorted);
  values->SetValue(3, -0.4);
  scene.ExpectPictureOfRays("twice");
}

TEST(IsosurfaceMapper, OtherMeshes)
{
  IsosurfaceScene scene;
  scene.Window->Render();
  scene.Show(tetralux::GenerateMesh("ball", { { "cells", 6 } }));
  EXPECT_EQ(RenderAndGetRebuilt(scene), "[\"tree\",\"ranges\",\"isopolygons\"]");
  EXPECT_EQ(scene.Get("hierarchy", "time_steps"), "1");
  scene.ExpectPictureOfRays("another mesh");

  // Cells of which a scalar is no number are empty.
  auto* field = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetScalars());
  const std::vector<float> before = scene.Render();
  field->SetValue(scene.Grid->FindPoint(0.2, 0.2, 0.2), std::numeric_limits<double>::quiet_NaN());
  field->Modified();
  EXPECT_NE(scene.Render(), before);
  EXPECT_GT(scene.Tracer->GetNumberOfBlankCells(), 0);
  scene.ExpectPictureOfRays("blank cells");

  // Nothing to draw is no error.
  vtkNew<vtkUnstructuredGrid> empty;
  scene.Tracer->SetInputData(empty);
  const MessageObserver warnings(scene.Tracer, { vtkCommand::WarningEvent });
  const MessageObserver errors(scene.Tracer);
  // VTK itself does not draw a volume without bounds.
  scene.Tracer->Render(scene.Renderer, scene.Volume);
  EXPECT_NE(warnings.Text.find("nothing is drawn"), std::string::npos) << warnings.Text;
  EXPECT_EQ(errors.Text, "");
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
  ExpectSamePicture(both, { rays, rays + both.size() }, Rounding, "blocks");
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
