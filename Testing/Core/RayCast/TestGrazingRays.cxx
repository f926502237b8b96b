// SPDX-License-Identifier: BSD-3-Clause

// Rays along the boundary, which single precision meets far from where they do, are cast in double
// precision.

#include "RayScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace tetralux;

constexpr int ImageSize = 64;

/// The upper side of a cube, seen from 1e-4 above it: rays meet it at a slope of some 50,000.
RayScene MakeScene()
{
  RayScene scene;
  scene.Mesh = MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(2);
  scene.Grid = MakePerspectiveGrid(
    { 5, 1.0001, 0.4 }, { 0.5, 1, 0.45 }, { 0, 1, 0 }, 0.001, ImageSize, ImageSize);
  return scene;
}

double FindLargestDifference(const RayPicture& a, const RayPicture& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.Colors.size(); ++i)
  {
    largest = std::max<double>(largest, std::abs(a.Colors[i] - b.Colors[i]));
  }
  return largest;
}

void ExpectDoublePrecisionWhereItIsNeeded(const RayScene& scene)
{
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.Arithmetic = Precision::Double;
  const RayPicture exact = Cast(volume, scene, options);
  EXPECT_EQ(exact.Statistics.DoubleRays, exact.Statistics.Rays);

  options.Arithmetic = Precision::Single;
  const RayPicture single = Cast(volume, scene, options);
  EXPECT_EQ(single.Statistics.DoubleRays, 0);
  const double singleError = FindLargestDifference(single, exact);
  EXPECT_GT(singleError, options.MaximumError);
  EXPECT_GE(single.Statistics.GeometryError, singleError);

  options.Arithmetic = Precision::Automatic;
  const RayPicture mixed = Cast(volume, scene, options);
  EXPECT_FALSE(mixed.Statistics.DoublePrecision);
  EXPECT_GT(mixed.Statistics.DoubleRays, 0);
  EXPECT_LT(mixed.Statistics.DoubleRays, mixed.Statistics.Rays);
  EXPECT_LE(FindLargestDifference(mixed, exact), mixed.Statistics.GeometryError);
  EXPECT_LE(mixed.Statistics.GeometryError, mixed.Statistics.Budget.Geometry);
  EXPECT_LE(mixed.Statistics.ErrorEstimate, options.MaximumError);

  // Whatever finds the boundary, and however many threads and lanes cast.
  for (const BoundarySearch search : { BoundarySearch::Hierarchy, BoundarySearch::Tiles })
  {
    options.Boundary = search;
    options.NumberOfThreads = search == BoundarySearch::Tiles ? 3 : 1;
    const RayPicture other = Cast(volume, scene, options);
    EXPECT_EQ(other.Colors, mixed.Colors);
    EXPECT_EQ(other.Depths, mixed.Depths);
    EXPECT_EQ(other.Statistics.DoubleRays, mixed.Statistics.DoubleRays);
    options.WideKernels = !options.WideKernels;
  }
}

} // namespace

TEST(GrazingRays, AreCastInDoublePrecision) { ExpectDoublePrecisionWhereItIsNeeded(MakeScene()); }

TEST(GrazingRays, AreCastInDoublePrecisionThroughScalarsAtCells)
{
  RayScene scene = MakeScene();
  std::vector<double> scalars;
  for (std::size_t cell = 0; cell < scene.Mesh.GetNumberOfCells(); ++cell)
  {
    scalars.push_back(scene.Scalars[scene.Mesh.Cells[4 * cell]]);
  }
  scene.Scalars = scalars;
  scene.CellScalars = true;
  ExpectDoublePrecisionWhereItIsNeeded(scene);
}

/// Nothing begins there.
TEST(GrazingRays, StayInSinglePrecisionAlongATransparentBoundary)
{
  RayScene scene = MakeScene();
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    const double* x = &scene.Mesh.Points[3 * p];
    scene.Scalars[p] = 16 * x[1] * (1 - x[1]) * x[0] * (1 - x[0]);
  }
  scene.Function = TransferFunction();
  const TransferFunction::Value clear = { { 1, 0, 0 }, 0 };
  const TransferFunction::Value dense = { { 0, 1, 0 }, 2 };
  scene.Function.Nodes = { { 0, clear, clear }, { 1, dense, dense } };
  VolumeScene volume = scene.MakeVolumeScene();
  const RayPicture picture = Cast(volume, scene);
  EXPECT_FALSE(picture.Statistics.DoublePrecision);
  EXPECT_EQ(picture.Statistics.DoubleRays, 0);
  EXPECT_GT(picture.Statistics.Paths, 0);
}
