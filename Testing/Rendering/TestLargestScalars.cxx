// SPDX-License-Identifier: BSD-3-Clause

// Pictures of the largest scalar on the graphics card, where functions are steep: not worse than
// mappers say, against rays cast in double precision.
#include "RayCastScene.h"

#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <random>
#include <vector>

namespace
{

/// Pixels of those that see the mesh which hit or miss a silhouette or graze an edge of the mesh:
/// no estimate is of them.
constexpr double LargestGrazedShare = 1e-3;

/// An estimate above this many times the largest error warns of what is right.
constexpr double LargestExcess = 30;

void SetRandomFunction(RayCastScene& scene, int nodes)
{
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> unit(0, 1);
  scene.Color->RemoveAllPoints();
  scene.Opacity->RemoveAllPoints();
  for (int k = 0; k < nodes; ++k)
  {
    const double scalar = static_cast<double>(k) / (nodes - 1);
    const double red = unit(generator);
    const double green = unit(generator);
    scene.Color->AddRGBPoint(scalar, red, green, unit(generator));
    scene.Opacity->AddPoint(scalar, 0.1 + 0.9 * unit(generator));
  }
}

void ExpectHonestEstimate(
  RayCastScene& scene, vtkTetrahedraVolumeMapper* mapper, const std::vector<float>& exact)
{
  mapper->SetBlendModeToMaximumIntensity();
  scene.Use(mapper);
  scene.Window->Render();
  const double estimate = mapper->GetErrorEstimate();
  int covered = 0;
  int above = 0;
  double largest = 0;
  for (std::size_t pixel = 0; pixel < exact.size() / 4; ++pixel)
  {
    double error = 0;
    for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
    {
      error = std::max<double>(error, std::abs(scene.GetColors()[k] - exact[k]));
    }
    covered += exact[4 * pixel + 3] > 0 ? 1 : 0;
    above += error > estimate ? 1 : 0;
    largest = error > estimate ? largest : std::max(largest, error);
  }
  std::cout << mapper->GetClassName() << ": error " << largest << ", estimate " << estimate << ", "
            << above << " of " << covered << " pixels above it\n";
  EXPECT_GT(covered, 0);
  EXPECT_LE(above, LargestGrazedShare * covered);
  EXPECT_LE(estimate, LargestExcess * largest);
}

TEST(LargestScalars, AreNotWorseThanEstimated)
{
  constexpr int Width = 192;
  constexpr int Height = 144;
  for (const int nodes : { 2, 8, 70 })
  {
    SCOPED_TRACE(nodes);
    RayCastScene scene(Width, Height);
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::generate(scene.Scalars.begin(), scene.Scalars.end(), [&] { return unit(generator); });
    scene.Grid = MakeGrid(scene.Mesh, scene.Scalars);
    SetRandomFunction(scene, nodes);
    scene.Mapper->SetBlendModeToMaximumIntensity();
    scene.Mapper->SetPrecisionToDouble();
    scene.Use(scene.Mapper);
    scene.Window->Render();
    const std::size_t values = 4 * static_cast<std::size_t>(Width) * Height;
    const std::vector<float> exact(scene.GetColors(), scene.GetColors() + values);
    vtkNew<vtkTetrahedraGPURayCastMapper> rays;
    ExpectHonestEstimate(scene, rays, exact);
    vtkNew<vtkTetrahedraProjectionMapper> projection;
    ExpectHonestEstimate(scene, projection, exact);
  }
}

} // namespace
