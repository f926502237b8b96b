// SPDX-License-Identifier: BSD-3-Clause
// What the mapper of traced isosurfaces does to a window: depths for others, tiles, viewports.
#include "IsosurfaceScene.h"
#include "Observer.h"
#include "OpenGLSnapshot.h"
#include "Statistics.h"

#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{

/// Of a distance, in world units: a depth buffer of 24 bits, from 1 to 6.
constexpr double DepthRounding = 1e-5;

TEST(IsosurfaceMapperWindow, WindowHoldsDepthsOfOpaqueSurfaces)
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

/// The largest difference between what the window shows and the picture over a black background.
int FindLargestDifference(IsosurfaceScene& scene)
{
  scene.Window->Render();
  const int* size = scene.Window->GetSize();
  vtkNew<vtkUnsignedCharArray> shown;
  scene.Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, shown, 0);
  vtkDataArray* colors = scene.Tracer->GetOutputImage()->GetPointData()->GetArray("RGBA");
  EXPECT_EQ(colors->GetNumberOfTuples(), shown->GetNumberOfTuples());
  int largest = 0;
  for (vtkIdType pixel = 0; pixel < colors->GetNumberOfTuples(); ++pixel)
  {
    for (int c = 0; c < 3; ++c)
    {
      const int expected = static_cast<int>(std::lround(255 * colors->GetComponent(pixel, c)));
      largest =
        std::max(largest, std::abs(expected - static_cast<int>(shown->GetComponent(pixel, c))));
    }
  }
  return largest;
}

// Opaque pictures go another way into the window than translucent ones.
TEST(IsosurfaceMapperWindow, ShowsThePicture)
{
  IsosurfaceScene scene;
  scene.Renderer->SetBackground(0, 0, 0);
  scene.Renderer->GradientBackgroundOff();
  constexpr int Rounding = 1; // of 255 steps
  for (const double opacity : { 1., 0.5, 1., 0.7 })
  {
    scene.SetSurfaces({ { -0.4, opacity }, { 0.3, 1 } });
    EXPECT_LE(FindLargestDifference(scene), Rounding) << opacity;
    EXPECT_GT(Sum(scene.Render()), 300) << opacity;
  }
}

TEST(IsosurfaceMapperWindow, WindowHoldsNoOtherDepths)
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

// Where surfaces are coloured by an array, each point is opaque or not.
TEST(IsosurfaceMapperWindow, HoldsDepthsOfOpaqueColors)
{
  IsosurfaceScene scene;
  scene.SetSurfaces({ { 0.3, 1 } });
  const std::int64_t all = [&scene]
  {
    scene.Window->Render();
    return scene.CountWindowDepths();
  }();
  vtkNew<vtkDoubleArray> array;
  array->SetName("X");
  for (vtkIdType p = 0; p < scene.Grid->GetNumberOfPoints(); ++p)
  {
    array->InsertNextValue(scene.Grid->GetPoint(p)[0]);
  }
  scene.Grid->GetPointData()->AddArray(array);
  scene.Tracer->SetColorArrayName("X");
  scene.Opacity->RemoveAllPoints();
  // Translucent at the surface's own value.
  scene.Opacity->AddPoint(0.49, 0.4);
  scene.Opacity->AddPoint(0.5, 1);
  scene.Window->Render();
  const std::int64_t some = scene.CountWindowDepths();
  EXPECT_GT(some, 50);
  EXPECT_LT(some, all);
  for (int j = 0; j < 72; ++j)
  {
    for (int i = 0; i < 96; ++i)
    {
      double x[3];
      EXPECT_TRUE(!scene.FindWindowPoint(i, j, x) || x[0] > 0.5 - DepthRounding) << x[0];
    }
  }
}

// A sphere in front keeps its depths, however coarse the rays are that end at it.
TEST(IsosurfaceMapperWindow, KeepsDepthsInFront)
{
  for (const float distance : { 0.5F, 1.F, 2.F, 5.F })
  {
    IsosurfaceScene scene;
    scene.SetSurfaces({ { 0.3, 1 } });
    scene.AddSphere({ 1, 0.8, 1.3 }, 0.25);
    scene.Volume->VisibilityOff();
    scene.Window->Render();
    std::vector<double> sphere;
    for (int j = 0; j < 72; ++j)
    {
      for (int i = 0; i < 96; ++i)
      {
        sphere.push_back(scene.Renderer->GetZ(i, j));
      }
    }
    scene.Volume->VisibilityOn();
    scene.Tracer->SetImageSampleDistance(distance);
    scene.Window->Render();
    int farther = 0;
    int nearer = 0;
    for (int j = 0; j < 72; ++j)
    {
      for (int i = 0; i < 96; ++i)
      {
        const double depth = scene.Renderer->GetZ(i, j);
        farther += depth > sphere[96 * j + i];
        nearer += depth < sphere[96 * j + i];
      }
    }
    EXPECT_EQ(farther, 0) << distance;
    EXPECT_GT(nearer, 200) << distance;
  }
}

// With several samples a pixel, as windows have by default.
TEST(IsosurfaceMapperWindow, HoldsDepthsOfSeveralSamples)
{
  IsosurfaceScene scene;
  scene.SetSurfaces({ { 0.3, 1 } });
  scene.Window->Render();
  const std::int64_t depths = scene.CountWindowDepths();
  IsosurfaceScene sampled;
  sampled.Window->SetMultiSamples(4);
  sampled.SetSurfaces({ { 0.3, 1 } });
  sampled.Window->Render();
  // The window has the depth of one sample, less than half a pixel from the middle: that moves the
  // outline, which hides about as much on one side as it shows on the other.
  constexpr double MovedShare = 0.02;
  EXPECT_NEAR(static_cast<double>(sampled.CountWindowDepths()), static_cast<double>(depths),
    MovedShare * static_cast<double>(depths));
  EXPECT_GT(std::stoi(GetStatistic(sampled.GetMapper(), "pixels_at_edges")), 100);
}

TEST(IsosurfaceMapperWindow, VolumesBehindOpaqueSurfacesAreHidden)
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

TEST(IsosurfaceMapperWindow, AbortedFramesAreNotDrawn)
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

TEST(IsosurfaceMapperWindow, LeavesOpenGLAsItWas)
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
TEST(IsosurfaceMapperWindow, TilesMakeOnePicture)
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

// Two rays a pixel in both directions, of which the window shows the mean.
TEST(IsosurfaceMapperWindow, SeveralRaysAPixel)
{
  IsosurfaceScene scene(40, 30);
  scene.Tracer->SetImageSampleDistance(0.5);
  const std::vector<float> fine = scene.Render();
  EXPECT_EQ(scene.Tracer->GetOutputImage()->GetDimensions()[0], 80);
  scene.Tracer->SetImageSampleDistance(1);
  scene.Window->SetSize(80, 60);
  ExpectSamePicture(scene.Render(), fine, Rounding, "as the picture of a larger window");
}

// One mapper in two viewports: each has the picture and the depths of a window of its own.
TEST(IsosurfaceMapperWindow, Viewports)
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

TEST(IsosurfaceMapperWindow, SampleDistance)
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

TEST(IsosurfaceMapperWindow, SeveralWindows)
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

} // namespace
