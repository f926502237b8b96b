// SPDX-License-Identifier: BSD-3-Clause
// Distances along the rays of a camera, of what the depth buffer holds.

#include "Frame/CameraRays.h"

#include "vtkCamera.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace
{

using tetralux::CameraRays;
using tetralux::RayGrid;

constexpr int Width = 40;
constexpr int Height = 30;
constexpr double Near = 0.5;
constexpr double Far = 80;

/// Of a distance, to that of the far plane. A depth is rounded to 2^-53, which a perspective makes
/// Far / Near times as large; the matrices add some roundings.
constexpr double DistanceRounding = 1e-12;

/// How the camera sees.
struct View
{
  bool Parallel;
  double Center;         ///< SetWindowCenter, across and up
  double SampleDistance; ///< pixels from ray to ray
};

class CameraDistances : public testing::TestWithParam<View>
{
};

/// The point of a ray in the world.
std::array<double, 4> FindPoint(const RayGrid& grid, double i, double j, double distance)
{
  std::array<double, 4> point = { 0, 0, 0, 1 };
  double direction[3];
  for (int c = 0; c < 3; ++c)
  {
    direction[c] = grid.Direction[c] + i * grid.DirectionStepX[c] + j * grid.DirectionStepY[c];
  }
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  for (int c = 0; c < 3; ++c)
  {
    point[c] = grid.Origin[c] + i * grid.OriginStepX[c] + j * grid.OriginStepY[c] +
      distance * direction[c] / length;
  }
  return point;
}

} // namespace

TEST_P(CameraDistances, LeadToTheDepthsThatTheCameraGivesPoints)
{
  const View& view = GetParam();
  vtkNew<vtkHeadlessRenderWindow> window;
  window->SetSize(Width, Height);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(3, -20, 7);
  camera->SetFocalPoint(1, 2, 0.5);
  camera->SetViewUp(0.1, 0.2, 1);
  camera->SetParallelProjection(view.Parallel);
  camera->SetParallelScale(9);
  camera->SetWindowCenter(view.Center, -view.Center);
  camera->SetClippingRange(Near, Far);

  const CameraRays rays(renderer, view.SampleDistance);
  vtkMatrix4x4* depthOfWorld =
    camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), 0, 1);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int sample = 0; sample < 1000; ++sample)
  {
    // Rays between those of the grid, too.
    const double i = share(random) * Width / view.SampleDistance - 0.5;
    const double j = share(random) * Height / view.SampleDistance - 0.5;
    const double distance = Near + share(random) * (Far - Near);
    double point[4];
    depthOfWorld->MultiplyPoint(FindPoint(rays.GetGrid(), i, j, distance).data(), point);
    EXPECT_NEAR(rays.GetDistance(i, j, point[2] / point[3]), distance, DistanceRounding * Far)
      << i << " " << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Views, CameraDistances,
  testing::Values(
    View{ false, 0, 1 }, View{ true, 0, 1 }, View{ false, 0.3, 2.5 }, View{ true, 0.3, 2.5 }));
