// SPDX-License-Identifier: BSD-3-Clause
// The projection mapper's settings, orders, buffers and optical models; what it leaves behind.
#include "AnyMapperScene.h"
#include "Observer.h"
#include "OpenGLSnapshot.h"
#include "RayCastScene.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPlane.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

class ProjectionMapperScene : public RayCastScene
{
public:
  explicit ProjectionMapperScene(int width = 96, int height = 72)
    : RayCastScene(width, height)
  {
    this->Use(this->Projection);
  }

  std::vector<float> Render()
  {
    this->Window->Render();
    const vtkIdType size = 4 * this->Projection->GetOutputImage()->GetNumberOfPoints();
    return { this->GetColors(), this->GetColors() + size };
  }

  /// The ray caster's picture of the same.
  std::vector<float> RenderByRays()
  {
    this->Use(this->Mapper);
    this->Mapper->SetBlendMode(this->Projection->GetBlendMode());
    this->Mapper->SetMaximumError(1e-6);
    std::vector<float> colors = this->Render(this->Mapper);
    this->Use(this->Projection);
    return colors;
  }

  bool Says(const std::string& text)
  {
    return this->Projection->GetStatistics().find(text) != std::string::npos;
  }

  vtkNew<vtkTetrahedraProjectionMapper> Projection;

private:
  std::vector<float> Render(vtkTetrahedraVolumeMapper* mapper)
  {
    this->Window->Render();
    const vtkIdType size = 4 * mapper->GetOutputImage()->GetNumberOfPoints();
    return { this->GetColors(), this->GetColors() + size };
  }
};

double FindLargestDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - b[i]));
  }
  return largest;
}

/// As for every scene of the tests: nothing but rounding.
constexpr double Exact = 1e-4;

TEST(ProjectionMapper, EmptyGridsAreSaidToBe)
{
  ProjectionMapperScene scene;
  vtkNew<vtkUnstructuredGrid> empty;
  scene.Projection->SetInputData(empty);
  const MessageObserver warnings(scene.Projection, { vtkCommand::WarningEvent });
  const MessageObserver errors(scene.Projection);
  // VTK itself does not draw a volume without bounds.
  scene.Projection->Render(scene.Renderer, scene.Volume);
  EXPECT_NE(warnings.Text.find("nothing is drawn"), std::string::npos);
  EXPECT_EQ(errors.Text, "");
  const std::vector<float> picture = GetPicture(scene.Projection);
  ASSERT_FALSE(picture.empty());
  EXPECT_EQ(*std::max_element(picture.begin(), picture.end()), 0);
}

TEST(ProjectionMapper, OrderIndependentModelsAreNotSorted)
{
  ProjectionMapperScene scene;
  using Mapper = vtkTetrahedraProjectionMapper;
  for (const int mode : { static_cast<int>(Mapper::MAXIMUM_INTENSITY_BLEND),
         static_cast<int>(Mapper::ADDITIVE_BLEND), static_cast<int>(Mapper::ABSORPTION_BLEND) })
  {
    scene.Projection->SetBlendMode(mode);
    EXPECT_LT(FindLargestDifference(scene.Render(), scene.RenderByRays()), Exact) << mode;
    scene.Render();
    EXPECT_TRUE(scene.Says("\"order\": \"none\"")) << mode;
    EXPECT_TRUE(scene.Says("what cells add commutes"));
  }
  scene.Projection->SetBlendModeToComposite();
  scene.Render();
  EXPECT_TRUE(scene.Says("\"order\": \"meshed polyhedra, across gaps\""));
  EXPECT_TRUE(scene.Says("\"cycles\": 0"));
}

TEST(ProjectionMapper, Isosurfaces)
{
  ProjectionMapperScene scene;
  scene.Projection->SetBlendModeToIsoSurface();
  scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, -0.4);
  scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(1, 0.3);
  EXPECT_LT(FindLargestDifference(scene.Render(), scene.RenderByRays()), Exact);
}

TEST(ProjectionMapper, CellDataOfAllModels)
{
  ProjectionMapperScene scene;
  vtkNew<vtkDoubleArray> array;
  array->SetName("OfCells");
  for (vtkIdType cell = 0; cell < scene.Grid->GetNumberOfCells(); ++cell)
  {
    array->InsertNextValue(std::sin(1.7 * static_cast<double>(cell)));
  }
  scene.Grid->GetCellData()->AddArray(array);
  for (vtkTetrahedraVolumeMapper* mapper :
    { static_cast<vtkTetrahedraVolumeMapper*>(scene.Projection),
      static_cast<vtkTetrahedraVolumeMapper*>(scene.Mapper) })
  {
    mapper->SetScalarModeToUseCellFieldData();
    mapper->SelectScalarArray("OfCells");
  }
  using Mapper = vtkTetrahedraProjectionMapper;
  for (const int mode :
    { static_cast<int>(Mapper::COMPOSITE_BLEND), static_cast<int>(Mapper::MAXIMUM_INTENSITY_BLEND),
      static_cast<int>(Mapper::ADDITIVE_BLEND), static_cast<int>(Mapper::ABSORPTION_BLEND) })
  {
    scene.Projection->SetBlendMode(mode);
    EXPECT_LT(FindLargestDifference(scene.Render(), scene.RenderByRays()), Exact) << mode;
  }
}

TEST(ProjectionMapper, Lit)
{
  ProjectionMapperScene scene;
  scene.Volume->GetProperty()->ShadeOn();
  scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 0.3);
  using Mapper = vtkTetrahedraProjectionMapper;
  for (const int mode :
    { static_cast<int>(Mapper::COMPOSITE_BLEND), static_cast<int>(Mapper::ISOSURFACE_BLEND) })
  {
    for (const bool smooth : { true, false })
    {
      scene.Projection->SetBlendMode(mode);
      scene.Projection->SetSmoothShading(smooth);
      scene.Mapper->SetSmoothShading(smooth);
      const std::vector<float> lit = scene.Render();
      EXPECT_LT(FindLargestDifference(lit, scene.RenderByRays()), 1e-3) << mode << smooth;
      scene.Volume->GetProperty()->ShadeOff();
      EXPECT_GT(FindLargestDifference(lit, scene.Render()), 0.05) << mode << smooth;
      scene.Volume->GetProperty()->ShadeOn();
    }
  }
}

// The same table as on the processor; formats of few bits are interpolated by the graphics card.
TEST(ProjectionMapper, Tables)
{
  ProjectionMapperScene scene;
  const std::vector<float> best = scene.Render();
  using Mapper = vtkTetrahedraProjectionMapper;
  for (const int scale :
    { static_cast<int>(Mapper::LINEAR_SCALE), static_cast<int>(Mapper::LOGARITHMIC_SCALE) })
  {
    for (const int format : { static_cast<int>(Mapper::UNORM8_FORMAT),
           static_cast<int>(Mapper::UNORM16_FORMAT), static_cast<int>(Mapper::FLOAT_FORMAT) })
    {
      for (vtkTetrahedraVolumeMapper* mapper :
        { static_cast<vtkTetrahedraVolumeMapper*>(scene.Projection),
          static_cast<vtkTetrahedraVolumeMapper*>(scene.Mapper) })
      {
        mapper->SetIntegrationToTable();
        mapper->SetTableScalarSize(64);
        mapper->SetTableLengthSize(32);
        mapper->SetTableScalarAxis(Mapper::UNIFORM_AXIS);
        mapper->SetTableLengthScale(scale);
        mapper->SetTableFormat(format);
      }
      const std::vector<float> colors = scene.Render();
      EXPECT_TRUE(scene.Says("\"integration\": \"table\""));
      EXPECT_GT(scene.GetDepths()[96 * 36 + 48], 0); // which tables do not tell
      const double tolerance = format == Mapper::FLOAT_FORMAT ? Exact : 0.02;
      EXPECT_LT(FindLargestDifference(colors, scene.RenderByRays()), tolerance) << scale << format;
      EXPECT_LT(FindLargestDifference(colors, best), 0.1) << scale << format;
    }
  }
}

// Each correction of the paper matters, in the order of its artifact.
TEST(ProjectionMapper, CorrectionsOff)
{
  ProjectionMapperScene scene;
  const std::vector<float> best = scene.Render();
  scene.Projection->PerspectiveInterpolationOff();
  const double linear = FindLargestDifference(scene.Render(), best);
  EXPECT_GT(linear, 1e-3);
  EXPECT_LT(linear, 0.1);
  scene.Projection->PerspectiveInterpolationOn();

  EXPECT_TRUE(scene.Says("\"color_buffer\": \"float\""));
  scene.Projection->SetMaximumError(0.5);
  scene.Render();
  EXPECT_TRUE(scene.Says("\"color_buffer\": \"half\""));
  scene.Projection->SetMaximumError(1e-4);

  scene.Projection->SetColorBufferToHalf();
  const double half = FindLargestDifference(scene.Render(), best);
  EXPECT_GT(half, 1e-5);
  EXPECT_LT(half, scene.Projection->GetErrorEstimate());
  EXPECT_LT(half, 1e-2);

  scene.Projection->SetColorBufferToUNorm8();
  scene.Projection->AlphaDitheringOff();
  const double rounded = FindLargestDifference(scene.Render(), best);
  EXPECT_GT(rounded, half);
  EXPECT_LT(rounded, scene.Projection->GetErrorEstimate());
  // Rounding at random is no better here, so it is not used.
  scene.Projection->AlphaDitheringOn();
  EXPECT_EQ(FindLargestDifference(scene.Render(), best), rounded);
  EXPECT_TRUE(scene.Says("\"alpha_dithering\": false"));
}

// Emission is only added up: random rounding is right on the average, whatever the scene.
// The face's z on the screen, 1 / depth, has no bound there.
TEST(ProjectionMapper, EyeCloseToABoundaryFace)
{
  ProjectionMapperScene scene;
  for (const double distance : { 0., 1e-12, 1e-9, 3e-9, 1e-8, 1e-7, 1e-6, -1e-9, -1e-7 })
  {
    scene.SetCamera({ 0.5, 0.45, 1 + distance }, { 0.5, 0.45, 0.5 }, { 0.01, 1, 0 }, 1e-3);
    EXPECT_LT(FindLargestDifference(scene.Render(), scene.RenderByRays()), Exact) << distance;
  }
}

TEST(ProjectionMapper, EmissionIsDitheredWithoutBias)
{
  ProjectionMapperScene scene;
  scene.Projection->SetBlendModeToAdditive();
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(4);
  const std::vector<float> best = scene.Render();
  scene.Projection->SetColorBufferToUNorm8();
  const std::vector<float> dithered = scene.Render();
  EXPECT_TRUE(scene.Says("\"alpha_dithering\": true"));
  EXPECT_LT(FindLargestDifference(dithered, best), scene.Projection->GetErrorEstimate());
  EXPECT_EQ(dithered, scene.Render()) << "the same in each frame";
  scene.Projection->AlphaDitheringOff();
  const std::vector<float> rounded = scene.Render();
  const auto findBias = [&best](const std::vector<float>& colors)
  {
    double sum = 0;
    for (std::size_t i = 0; i < colors.size(); ++i)
    {
      sum += colors[i] - best[i];
    }
    return std::abs(sum) / static_cast<double>(colors.size());
  };
  EXPECT_LT(findBias(dithered), 0.1 / 255);
  EXPECT_GT(findBias(rounded), 10 * findBias(dithered));
}

// Sums are rounded in proportion to what they have come to: without absorption that may be above 1.
TEST(ProjectionMapper, BrightEmissionInHalfPrecision)
{
  ProjectionMapperScene scene;
  scene.Projection->SetBlendModeToAdditive();
  const double sums = 4 * std::cbrt(static_cast<double>(scene.Grid->GetNumberOfCells()));
  constexpr double HalfRounding = 1. / (1 << 11); // of numbers up to 1
  for (const double unitDistance : { 1., 0.1, 0.01 })
  {
    SCOPED_TRACE(unitDistance);
    scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(unitDistance);
    scene.Projection->SetColorBufferToFloat();
    const std::vector<float> best = scene.Render();
    const double largest = *std::max_element(best.begin(), best.end());
    scene.Projection->SetColorBufferToHalf();
    const double error = FindLargestDifference(scene.Render(), best);
    const double estimate = scene.Projection->GetErrorEstimate();
    EXPECT_LT(error, estimate);
    // Sums of the sample's rays, up to the next power of two, may be four times those of the view.
    EXPECT_LT(estimate, sums * HalfRounding * 4 * std::max(largest, 1.));
    if (largest > 16)
    {
      EXPECT_GT(error, sums * HalfRounding) << "as if no sum came above 1";
    }
  }
}

TEST(ProjectionMapper, WhatHalfPrecisionCannotHoldHasNoEstimate)
{
  ProjectionMapperScene scene;
  const MessageObserver warnings(scene.Projection, { vtkCommand::WarningEvent });
  scene.Projection->SetBlendModeToAdditive();
  scene.Projection->SetColorBufferToHalf();
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(1e-6); // sums of a million
  scene.Render();
  EXPECT_EQ(scene.Projection->GetErrorEstimate(), std::numeric_limits<double>::infinity());
  EXPECT_NE(warnings.Text.find("'summation'"), std::string::npos);
}

// It is written once, whatever the number of cells.
TEST(ProjectionMapper, LargestScalarInHalfPrecision)
{
  ProjectionMapperScene scene;
  scene.Projection->SetBlendModeToMaximumIntensity();
  scene.Projection->SetColorBufferToFloat();
  const std::vector<float> best = scene.Render();
  scene.Projection->SetColorBufferToHalf();
  const double error = FindLargestDifference(scene.Render(), best);
  EXPECT_GT(error, 1e-5);
  EXPECT_LT(error, scene.Projection->GetErrorEstimate());
  EXPECT_LT(scene.Projection->GetErrorEstimate(), 1e-3);
}

// In a view that is nearly parallel there is nothing to correct: what the rasteriser interpolates
// is then as good as what fragments find, with all that a cell may have with it.
TEST(ProjectionMapper, NarrowViewsNeedNoPerspectiveInterpolation)
{
  ProjectionMapperScene scene;
  constexpr double Narrowness = 100;
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetViewAngle(camera->GetViewAngle() / Narrowness);
  camera->Dolly(1 / Narrowness);
  scene.Renderer->ResetCameraClippingRange();
  const auto expectSame = [&](const char* what)
  {
    scene.Projection->PerspectiveInterpolationOn();
    const std::vector<float> best = scene.Render();
    const float* depths = scene.GetDepths();
    const std::vector<float> expected(depths, depths + best.size() / 4);
    EXPECT_GT(*std::max_element(best.begin(), best.end()), 0.1) << what;
    scene.Projection->PerspectiveInterpolationOff();
    // What is left of the perspective, and corners that the rasteriser rounds to 1/256 pixel.
    constexpr double Rounding = 1e-3;
    EXPECT_LT(FindLargestDifference(scene.Render(), best), Rounding) << what;
    depths = scene.GetDepths();
    std::int64_t others = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      others += std::abs(depths[i] / expected[i] - 1) > Rounding / Narrowness;
    }
    EXPECT_LT(others, 20) << what; // along silhouettes
  };
  expectSame("plain");
  scene.Volume->GetProperty()->ShadeOn();
  expectSame("lit");
  scene.Volume->GetProperty()->ShadeOff();
  scene.Projection->CroppingOn();
  scene.Projection->SetCroppingRegionPlanes(0.2, 0.7, 0.35, 0.8, 0.3, 0.6);
  scene.Projection->SetCroppingRegionFlagsToFence();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.5, 0.5, 0.5);
  plane->SetNormal(1, 2, 3);
  scene.Projection->AddClippingPlane(plane);
  expectSame("clipped and cropped");
  scene.Projection->CroppingOff();
  scene.Projection->RemoveAllClippingPlanes();
  vtkNew<vtkDoubleArray> array;
  array->SetName("OfCells");
  for (vtkIdType cell = 0; cell < scene.Grid->GetNumberOfCells(); ++cell)
  {
    array->InsertNextValue(std::sin(1.7 * static_cast<double>(cell)));
  }
  scene.Grid->GetCellData()->AddArray(array);
  scene.Projection->SetScalarModeToUseCellFieldData();
  scene.Projection->SelectScalarArray("OfCells");
  expectSame("cell data");
}

TEST(ProjectionMapper, DitheringKeepsWhatIsTooThinForEightBits)
{
  // Each cell's opacity is far below half of 1/255.
  ProjectionMapperScene scene;
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(100);
  const std::vector<float> best = scene.Render();
  scene.Projection->SetColorBufferToUNorm8();
  const std::vector<float> dithered = scene.Render();
  scene.Projection->AlphaDitheringOff();
  const std::vector<float> rounded = scene.Render();
  const auto sumOpacities = [](const std::vector<float>& colors)
  {
    double sum = 0;
    for (std::size_t i = 3; i < colors.size(); i += 4)
    {
      sum += colors[i];
    }
    return sum;
  };
  EXPECT_LT(sumOpacities(rounded), 0.2 * sumOpacities(best));
  EXPECT_NEAR(sumOpacities(dithered), sumOpacities(best), 0.05 * sumOpacities(best));
}

TEST(ProjectionMapper, Orders)
{
  // In a box of cells all orders by faces are exact.
  ProjectionMapperScene scene;
  const std::vector<float> best = scene.Render();
  EXPECT_STREQ(scene.Projection->GetUsedOrderAsString(), "across-gaps");
  EXPECT_FALSE(scene.Says("convexification"));
  scene.Projection->SetOrderToNonConvex();
  EXPECT_LT(FindLargestDifference(scene.Render(), best), Exact);
  EXPECT_TRUE(scene.Says("\"order\": \"meshed polyhedra, not convex\""));
  EXPECT_STREQ(scene.Projection->GetUsedOrderAsString(), "non-convex");
  scene.Projection->SetOrderToAcrossGaps();
  EXPECT_LT(FindLargestDifference(scene.Render(), best), Exact);
  EXPECT_STREQ(scene.Projection->GetUsedOrderAsString(), "across-gaps");
  scene.Projection->SetOrderToCentroid();
  EXPECT_LT(FindLargestDifference(scene.Render(), best), 0.2);
  EXPECT_TRUE(scene.Says("\"order\": \"distance of centroids\""));
  scene.Projection->SetOrderToExact();
  EXPECT_LT(FindLargestDifference(scene.Render(), best), Exact);
  EXPECT_EQ(scene.Projection->GetUsedOrder(), vtkMeshedPolyhedraVisibilitySort::EXACT_ORDER);
  EXPECT_STREQ(scene.Projection->GetUsedOrderAsString(), "exact");
  scene.Projection->SetBlendModeToAdditive();
  scene.Render();
  EXPECT_EQ(scene.Projection->GetUsedOrder(), vtkMeshedPolyhedraVisibilitySort::AUTOMATIC_ORDER);
  EXPECT_STREQ(scene.Projection->GetUsedOrderAsString(), "none");
}

// After a frame with all that frames may have, and after an aborted one.
TEST(ProjectionMapper, AbortedFramesAreNotDrawn)
{
  // Aborted at the first, second, ... question: while the mesh is made convex, or in the drawing.
  for (int question = 1; question <= 3; ++question)
  {
    ProjectionMapperScene scene;
    int events = 0;
    bool abort = true;
    const Observer progress(scene.Projection, vtkCommand::VolumeMapperRenderProgressEvent,
      [&](const char*) { scene.Window->SetAbortRender(abort && ++events == question); });
    scene.Window->Render();
    if (events < question)
    {
      EXPECT_GT(question, 1) << "nobody was asked";
      break;
    }
    EXPECT_TRUE(scene.Says("\"aborted\": true")) << question;

    // The next frame is complete.
    abort = false;
    const std::vector<float> picture = scene.Render();
    EXPECT_TRUE(scene.Says("\"aborted\": false")) << question;
    EXPECT_LT(FindLargestDifference(picture, scene.RenderByRays()), 1e-4) << question;
  }
}

TEST(ProjectionMapper, LeavesOpenGLAsItWas)
{
  ProjectionMapperScene scene;
  scene.Window->Render(); // makes the context
  OpenGLSnapshot before;
  OpenGLSnapshot after;
  const Observer start(scene.Projection, vtkCommand::VolumeMapperRenderStartEvent,
    [&](const char*) { before = TakeOpenGLSnapshot(scene.Window); });
  const Observer end(scene.Projection, vtkCommand::VolumeMapperRenderEndEvent,
    [&](const char*) { after = TakeOpenGLSnapshot(scene.Window); });
  scene.Renderer->PreserveDepthBufferOn(); // so that depths are read
  scene.Projection->CroppingOn();
  scene.Projection->SetCroppingRegionPlanes(0.2, 0.7, 0.35, 0.8, 0.3, 0.6);
  scene.Projection->SetCroppingRegionFlagsToFence();
  using Mapper = vtkTetrahedraProjectionMapper;
  for (const int mode : { static_cast<int>(Mapper::COMPOSITE_BLEND),
         static_cast<int>(Mapper::MAXIMUM_INTENSITY_BLEND) })
  {
    scene.Projection->SetBlendMode(mode);
    scene.Window->Render();
    EXPECT_EQ(FindDifferences(before, after), "");
    after = TakeOpenGLSnapshot(scene.Window);
    scene.Projection->GetOutputImage();
    EXPECT_EQ(FindDifferences(after, TakeOpenGLSnapshot(scene.Window)), "");
  }
  {
    const Observer progress(scene.Projection, vtkCommand::VolumeMapperRenderProgressEvent,
      [&](const char*) { scene.Window->SetAbortRender(1); });
    scene.Projection->Modified(); // else the picture is kept
    scene.Window->Render();
  }
  EXPECT_TRUE(scene.Says("\"aborted\": true"));
  EXPECT_EQ(FindDifferences(before, after), "");
  scene.Render();
  EXPECT_TRUE(scene.Says("\"aborted\": false"));
}

// One mapper in two windows, by turns; and in a third one where the others are no more.
TEST(ProjectionMapper, SeveralWindows)
{
  vtkNew<vtkTetrahedraProjectionMapper> mapper;
  ProjectionMapperScene first;
  const std::vector<float> expected = first.Render();
  {
    ProjectionMapperScene second;
    int turn = 0;
    for (ProjectionMapperScene* scene : { &first, &second, &first, &second })
    {
      scene->Use(mapper);
      scene->Window->Render();
      const std::vector<float> colors(scene->GetColors(), scene->GetColors() + expected.size());
      EXPECT_TRUE(colors == expected) << "turn " << turn++;
    }
    second.Window->Finalize();
  }
  first.Use(mapper);
  first.Window->Render();
  EXPECT_EQ(std::vector<float>(first.GetColors(), first.GetColors() + expected.size()), expected);
  mapper->ReleaseGraphicsResources(first.Window);
  first.Window->Render();
  EXPECT_EQ(std::vector<float>(first.GetColors(), first.GetColors() + expected.size()), expected);

  // The picture goes with the resources.
  first.Window->Render();
  mapper->ReleaseGraphicsResources(first.Window);
  EXPECT_EQ(mapper->GetOutputImage()->GetNumberOfPoints(), 0);
}

TEST(ProjectionMapper, NothingLeft)
{
  ProjectionMapperScene scene;
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, 5);
  scene.Projection->AddClippingPlane(plane);
  for (const float channel : scene.Render())
  {
    ASSERT_EQ(channel, 0);
  }
  EXPECT_TRUE(scene.Says("\"tetrahedra_drawn\": 0"));
  EXPECT_EQ(scene.GetDepths()[0], -1);
}

} // namespace
