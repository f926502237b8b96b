// SPDX-License-Identifier: BSD-3-Clause
// Frames of an interaction, with rays that are coarser than pixels, beside a still picture.
#include "AnyMapperScene.h"

#include "Frame/RayPace.h"
#include "MapperPropertyAccess.h"
#include "Observer.h"
#include "Properties/PropertyTable.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraVolumeMapper.h"
#include "vtkTriangleCasterMapper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace
{

constexpr int Width = 80;
constexpr int Height = 60;

/// Of a window, steps of 255: what rounding each picture to 8 bits adds.
constexpr double Rounding = 1;

void Set(vtkAbstractVolumeMapper* mapper, const char* property, double value)
{
  tetralux::SetPropertyValues(mapper, tetralux::GetMapperProperty(property), { value });
}

double GetErrorEstimate(vtkAbstractVolumeMapper* mapper)
{
  auto* ofCells = vtkTetrahedraVolumeMapper::SafeDownCast(mapper);
  return ofCells ? ofCells->GetErrorEstimate()
                 : vtkTriangleCasterMapper::SafeDownCast(mapper)->GetErrorEstimate();
}

double FindLargestDifference(const std::vector<int>& a, const std::vector<int>& b)
{
  int largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    largest = std::max(largest, std::abs(a[k] - b[k]));
  }
  return largest;
}

class Interaction : public testing::TestWithParam<std::string>
{
};

} // namespace

INSTANTIATE_TEST_SUITE_P(
  Mappers, Interaction, testing::ValuesIn(GetMapperClasses()), NameAnyMapperTest);

TEST_P(Interaction, CoarseRaysAreWithinTheEstimate)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()), Width, Height);
  int warnings = 0;
  const Observer observer(
    scene.GetMapper(), vtkCommand::WarningEvent, [&](const char*) { ++warnings; });
  scene.Render();
  const std::vector<int> plain = scene.Grab();
  const double fine = GetErrorEstimate(scene.GetMapper());
  Set(scene.GetMapper(), "AutoAdjustSampleDistances", 0);
  for (const double distance : { 1.5, 3. })
  {
    SCOPED_TRACE(distance);
    Set(scene.GetMapper(), "ImageSampleDistance", distance);
    scene.Render();
    EXPECT_EQ(GetOutputImage(scene.GetMapper())->GetDimensions()[0], std::lround(Width / distance));
    const double estimate = GetErrorEstimate(scene.GetMapper());
    const double error = FindLargestDifference(scene.Grab(), plain);
    EXPECT_LE(error, 255 * estimate + Rounding);
    EXPECT_GT(error, 10);
    const double coarse = std::stod(scene.Get("coarse_rays"));
    EXPECT_GE(estimate, coarse);
    EXPECT_LE(estimate, coarse + 2 * fine); // the rest is for other rays
  }
  EXPECT_EQ(warnings, 0);
}

// Rays through the middles of larger pixels.
TEST_P(Interaction, CoarseRaysAreThoseOfASmallWindow)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()), Width, Height);
  AnyMapperScene small(MakeMapper(this->GetParam()), Width / 2, Height / 2);
  Set(scene.GetMapper(), "AutoAdjustSampleDistances", 0);
  Set(scene.GetMapper(), "ImageSampleDistance", 2);
  const std::vector<float> coarse = scene.Render();
  const std::vector<float> expected = small.Render();
  ASSERT_EQ(coarse.size(), expected.size());
  // Slices go by the length of a ray, which is that of another pixel.
  constexpr float Tolerance = 1e-5F;
  for (std::size_t k = 0; k < coarse.size(); ++k)
  {
    ASSERT_NEAR(coarse[k], expected[k], Tolerance * std::max(1.F, std::abs(expected[k]))) << k;
  }
}

TEST_P(Interaction, KeepsTheRateAndTheStillPicture)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()), Width, Height);
  Set(scene.GetMapper(), "MaximumImageSampleDistance", 5);
  const std::vector<float> still = scene.Render();
  const std::vector<int> window = scene.Grab();
  EXPECT_EQ(GetOutputImage(scene.GetMapper())->GetDimensions()[0], Width);

  scene.Window->SetDesiredUpdateRate(1e9);
  for (int frame = 0; frame < 3; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(1);
    scene.Render();
    EXPECT_EQ(scene.Get("kept"), "false");
    const double distance = std::stod(scene.Get("sample_distance"));
    EXPECT_EQ(GetOutputImage(scene.GetMapper())->GetDimensions()[0], std::lround(Width / distance));
    if (this->GetParam() != "vtkTetrahedraProjectionMapper") // which also has to project cells
    {
      EXPECT_EQ(distance, 5);
    }
  }
  scene.Renderer->GetActiveCamera()->Azimuth(-3);
  scene.Renderer->ResetCamera();
  scene.Window->SetDesiredUpdateRate(1e-4);
  scene.Render();
  EXPECT_EQ(scene.Get("sample_distance"), "1.0");
  EXPECT_LE(FindLargestDifference(scene.Grab(), window), Rounding);
}

TEST_P(Interaction, FineRaysAreAveraged)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()), Width, Height);
  Set(scene.GetMapper(), "AutoAdjustSampleDistances", 0);
  scene.Render();
  const std::vector<int> whole = scene.Grab();
  Set(scene.GetMapper(), "ImageSampleDistance", 0.5);
  scene.Render();
  EXPECT_EQ(GetOutputImage(scene.GetMapper())->GetDimensions()[0], 2 * Width);
  EXPECT_EQ(scene.Get("coarse_rays"), "0.0");
  EXPECT_GT(FindLargestDifference(scene.Grab(), whole), Rounding); // its edges are smooth
}

// By whatever means the picture is made, rays end at the depths of the pixels that they go through.
TEST(CoarseRays, EndAtOpaqueGeometry)
{
  std::vector<float> expected;
  for (const char* mapperClass : { "vtkTetrahedraRayCastMapper", "vtkTetrahedraGPURayCastMapper",
         "vtkTetrahedraProjectionMapper" })
  {
    SCOPED_TRACE(mapperClass);
    AnyMapperScene scene(MakeMapper(mapperClass), Width, Height);
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(2.5, 2, 1.5);
    sphere->SetRadius(1.8);
    vtkNew<vtkPolyDataMapper> surface;
    surface->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(surface);
    scene.Renderer->AddActor(actor);
    Set(scene.GetMapper(), "AutoAdjustSampleDistances", 0);
    Set(scene.GetMapper(), "ImageSampleDistance", 1.7);
    const std::vector<float> picture = scene.Render();
    EXPECT_EQ(scene.Get("opaque geometry"), "no statistic opaque geometry"); // not left out
    expected = expected.empty() ? picture : expected;
    ASSERT_EQ(picture.size(), expected.size());
    constexpr float Tolerance = 1e-4F; // MaximumError
    const std::size_t colors = picture.size() / 5 * 4;
    for (std::size_t k = 0; k < colors; ++k)
    {
      ASSERT_NEAR(picture[k], expected[k], Tolerance) << k;
    }
  }
}

TEST(RayPace, FollowsTheTimeOfARay)
{
  tetralux::RayPace pace;
  const tetralux::RayDistances distances;
  tetralux::FrameDemand demand;
  demand.Pixels = 1e6;
  demand.Seconds = 0.1;
  demand.Interactive = true;
  EXPECT_EQ(pace.ChooseDistance(distances, demand), 1); // nothing is known yet
  pace.Record(1e6, 0.9, 0);
  EXPECT_GE(pace.ChooseDistance(distances, demand), 3);
  EXPECT_LT(pace.ChooseDistance(distances, demand), 3.6);
  demand.Interactive = false;
  EXPECT_NEAR(pace.ChooseDistance(distances, demand), 3, 1e-12);
  demand.Seconds = 1e4;
  EXPECT_EQ(pace.ChooseDistance(distances, demand), 1);
}

// Times of frames vary from one to the next.
TEST(RayPace, StaysWhereItIsInAnInteraction)
{
  tetralux::RayPace pace;
  const tetralux::RayDistances distances;
  const tetralux::FrameDemand demand{ 1e6, 0.1, true };
  const auto choose = [&](double seconds)
  {
    pace.Record(1e6, seconds, 0);
    return pace.ChooseDistance(distances, demand);
  };
  choose(0.9);
  const double first = choose(1);
  EXPECT_GT(first, std::sqrt(10));
  for (const double seconds : { 0.8, 1.1, 0.9, 1.2, 9., 1., 0.01, 0.9 })
  {
    EXPECT_EQ(choose(seconds), first) << seconds;
  }
  choose(1.6);
  EXPECT_GT(choose(1.6), first);
  choose(0.2);
  EXPECT_LT(choose(0.2), first);
}

// What every frame takes leaves less for rays; more of it than the time is not made up for by rays.
TEST(RayPace, LeavesTimeForTheRest)
{
  const tetralux::RayDistances distances;
  const tetralux::FrameDemand demand{ 1e6, 0.1, true };
  const auto choose = [&](double raySeconds, double fixedSeconds)
  {
    tetralux::RayPace pace;
    pace.Record(1e6, raySeconds, fixedSeconds);
    return pace.ChooseDistance(distances, demand);
  };
  EXPECT_NEAR(choose(0.2, 0.05), 2, 1e-12);
  EXPECT_NEAR(choose(0.1, 0.4), 1, 1e-12);
  EXPECT_NEAR(choose(0.4, 0.4), 2, 1e-12);
}

TEST(RayPace, LeavesEdgesOutWhereThereIsNoTime)
{
  tetralux::RayPace pace;
  tetralux::FrameDemand demand{ 1e6, 0.1, true };
  pace.Record(1e6, 0.05, 0);
  EXPECT_TRUE(pace.HasTimeForEdges(demand));
  pace.RecordEdges(0.06);
  EXPECT_FALSE(pace.HasTimeForEdges(demand));
  pace.RecordEdges(0.045); // not back at once
  EXPECT_FALSE(pace.HasTimeForEdges(demand));
  pace.RecordEdges(0.02);
  EXPECT_TRUE(pace.HasTimeForEdges(demand));
  pace.RecordEdges(1);
  demand.Interactive = false;
  EXPECT_TRUE(pace.HasTimeForEdges(demand));
}
