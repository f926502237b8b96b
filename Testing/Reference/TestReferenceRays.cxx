// SPDX-License-Identifier: BSD-3-Clause
// Which cells the oracle's rays go through, and how far, against what is known without
// it.
#include "ReferenceIntegral.h"
#include "ReferencePictures.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace
{

using namespace tetralux;
using namespace tetralux::reference_pictures;
using Precise = boost::multiprecision::cpp_bin_float_50;

TEST(Reference, SingleTetrahedron)
{
  const Scene scene = MakeUnitTetrahedron();
  const RayGrid grid = MakeParallelGrid({ 0.5, 0.5, 3 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.6, 33, 21);
  const ReferenceImage image = scene.Render(Grey, grid);
  int covered = 0;
  for (int pixel = 0; pixel < 33 * 21; ++pixel)
  {
    const WorldRay ray = GetRay(grid, pixel % 33, pixel / 33);
    const double x = static_cast<double>(ray.Origin[0]);
    const double y = static_cast<double>(ray.Origin[1]);
    const double length = x > 0 && y > 0 && x + y < 1 ? 1 - x - y : 0;
    const double alpha = 1 - std::exp(-1.5 * length);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], alpha, 1e-15);
    EXPECT_NEAR(image.Rgba[4 * pixel + 0], 0.2 * alpha, 1e-15);
    EXPECT_NEAR(image.Rgba[4 * pixel + 2], 0.8 * alpha, 1e-15);
    EXPECT_NEAR(image.Depth[pixel], length > 0 ? 2 + x + y : -1, 1e-14);
    covered += length > 0;
  }
  EXPECT_GT(covered, 100);
}

TEST(Reference, ViewsAreThoseOfACamera)
{
  const int width = 40;
  const int height = 20;
  const RayGrid perspective =
    MakePerspectiveGrid({ 1, 2, 3 }, { 1, 2, -5 }, { 0, 3, 1 }, 90, width, height);
  const RayGrid parallel =
    MakeParallelGrid({ 1, 2, 3 }, { 1, 2, -5 }, { 0, 3, 1 }, 7, width, height);
  for (const int corner : { 0, 1 })
  {
    const double x = (corner ? width - 0.5 : 0.5) / width * 4 - 2;
    const double y = (corner ? height - 0.5 : 0.5) / height * 2 - 1;
    const int i = corner ? width - 1 : 0;
    const int j = corner ? height - 1 : 0;
    const WorldRay ray = GetRay(perspective, i, j);
    EXPECT_NEAR(ray.Direction[0] / -ray.Direction[2], x, 1e-14);
    EXPECT_NEAR(ray.Direction[1] / -ray.Direction[2], y, 1e-14);
    EXPECT_EQ(ray.Origin[0], 1);
    EXPECT_LT(ray.Direction[2], 0);
    const WorldRay parallelRay = GetRay(parallel, i, j);
    EXPECT_NEAR(parallelRay.Origin[0], 1 + 7 * x, 1e-14);
    EXPECT_NEAR(parallelRay.Origin[1], 2 + 7 * y, 1e-14);
    EXPECT_NEAR(parallelRay.Origin[2], 3, 1e-14);
    EXPECT_NEAR(parallelRay.Direction[2], -1, 1e-15);
  }
}

TEST(Reference, RaysThroughVerticesEdgesAndFacesCountOnce)
{
  // A cube of five tetrahedra, and a grid whose lines all rays below run along or cut.
  for (const int n : { 1, 4 })
  {
    const Scene scene = MakeConstantScene(MakeBox(n, n, n, { 0, 0, 0 }, { 1, 1, 1 }));
    const Vector targets[] = { { 0, 0, 0 }, { 1, 1, 1 }, { 1, 0, 0 }, { 0, 1, 1 }, { 0.5, 0.5, 0 },
      { 0.5, 0.5, 1 }, { 0.5, 0, 0.5 }, { 1, 0.5, 0.5 }, { 0.5, 0.5, 0.5 }, { 0.25, 0.5, 0.75 },
      { 0.25, 0.25, 0 } };
    const Vector positions[] = { { -1, -1, -1 }, { 2, 2, 2 }, { 2, -1, -1 }, { 0.5, 0.5, -3 },
      { 0.5, 0.5, 3 }, { -2, 0.5, 0.5 }, { 0.25, 3, 0.5 }, { 3, 3, 0.5 }, { -1, 2, 0.25 },
      { 0.25, 0.5, 2 } };
    for (const Vector& position : positions)
    {
      for (const Vector& target : targets)
      {
        const RayGrid grid = MakeSingleRay(position, target);
        const Chord chord = ClipByBox(GetRay(grid, 0, 0), { 0, 0, 0 }, { 1, 1, 1 });
        const ReferenceImage image = scene.Render(Grey, grid);
        EXPECT_NEAR(image.Length[0], chord.Length(), 1e-15)
          << n << ": " << position[0] << ' ' << position[1] << ' ' << position[2] << " to "
          << target[0] << ' ' << target[1] << ' ' << target[2];
        if (chord.Length() > 0)
        {
          EXPECT_NEAR(image.Depth[0], static_cast<double>(chord.Begin), 1e-15);
        }
      }
    }
  }
}

TEST(Reference, RaysInTheHullAreInsideOrOutside)
{
  const Scene scene = MakeConstantScene(MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }));
  int inside = 0;
  for (const double x : { 0.0, 1.0 })
  {
    for (const double y : { 0.0, 0.2, 1.0 / 3, 1.0 })
    {
      const ReferenceImage image = scene.Render(Grey, MakeSingleRay({ x, y, -1 }, { x, y, 0 }));
      if (image.Length[0] != 0)
      {
        EXPECT_NEAR(image.Length[0], 1, 1e-15);
        ++inside;
      }
    }
  }
  EXPECT_EQ(inside, 3); // one of the two sides, and of that one corner line not
}

TEST(Reference, ParallelPictureAlongTheGridLinesLosesNothing)
{
  // Pixel centres are the grid's vertices and the middles of its edges.
  const int n = 8;
  const Scene scene = MakeLinearScene(MakeBox(n, n, n, { 0, 0, 0 }, { 1, 1, 1 }), { 0, 0, 1 }, 0);
  const TransferFunction ramp = MakeLinearFunction({ { 0, 1, 0, 0, 0.5 }, { 1, 0, 1, 0, 3.0 } });
  const int size = 2 * n - 1;
  const RayGrid grid =
    MakeParallelGrid({ 0.5, 0.5, 2 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, size / (4.0 * n), size, size);
  const ReferenceImage image = scene.Render(ramp, grid);
  const ReferenceSegment expected = IntegrateReference(ramp, 1, 0, 1);
  for (int pixel = 0; pixel < size * size; ++pixel)
  {
    EXPECT_NEAR(image.Length[pixel], 1, 1e-15);
    EXPECT_NEAR(image.Rgba[4 * pixel + 0], expected.Color[0], 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 1], expected.Color[1], 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], expected.Alpha, 1e-14);
    EXPECT_NEAR(image.Depth[pixel], 1, 1e-15);
  }
}

/// Where a line enters and leaves a tetrahedron, by its four planes in fifty digits.
Precise ClipByPlanes(const WorldRay& ray, const std::vector<double>& points)
{
  Precise begin = -1e30;
  Precise end = 1e30;
  for (int opposite = 0; opposite < 4; ++opposite)
  {
    const double* corner[4]; // the one opposite to the plane comes first
    for (int i = 0; i < 4; ++i)
    {
      corner[i] = points.data() + 3 * ((opposite + i) % 4);
    }
    Precise normal[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      normal[axis] =
        (Precise(corner[2][u]) - corner[1][u]) * (Precise(corner[3][v]) - corner[1][v]) -
        (Precise(corner[2][v]) - corner[1][v]) * (Precise(corner[3][u]) - corner[1][u]);
    }
    Precise inside = 0;
    Precise distance = 0;
    Precise slope = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      inside += normal[axis] * (Precise(corner[0][axis]) - corner[1][axis]);
      distance += normal[axis] * (Precise(ray.Origin[axis]) - corner[1][axis]);
      slope += normal[axis] * Precise(ray.Direction[axis]);
    }
    if (slope != 0)
    {
      const Precise t = -distance / slope;
      if ((slope > 0) == (inside > 0))
      {
        begin = std::max(begin, t);
      }
      else
      {
        end = std::min(end, t);
      }
    }
    else if ((distance > 0) != (inside > 0))
    {
      return 0;
    }
  }
  return begin < end ? Precise(end - begin) : Precise(0);
}

TEST(Reference, ClipsAsByPlanes)
{
  // Random tetrahedra, and the same flattened: one corner moved close to the opposite face.
  const struct
  {
    double Thickness;
    double Tolerance;
  } examples[] = { { 1, 1e-14 }, { 1e-6, 1e-11 } };
  for (const auto& example : examples)
  {
    std::mt19937_64 generator(12);
    std::uniform_real_distribution<double> unit(0, 1);
    int hits = 0;
    for (int trial = 0; trial < 1000; ++trial)
    {
      TetrahedralMesh mesh;
      for (int i = 0; i < 12; ++i)
      {
        mesh.Points.push_back(unit(generator));
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        const double mean = (mesh.Points[axis] + mesh.Points[3 + axis] + mesh.Points[6 + axis]) / 3;
        mesh.Points[9 + axis] = mean + example.Thickness * (mesh.Points[9 + axis] - mean);
      }
      mesh.Cells = { 0, 1, 2, 3 };
      const Vector target{ unit(generator), unit(generator), unit(generator) };
      const RayGrid grid =
        MakeSingleRay({ 5 * unit(generator), 4, 6 * unit(generator) - 3 }, target);
      const std::vector<double> points = mesh.Points;
      const Precise expected = ClipByPlanes(GetRay(grid, 0, 0), points);
      const double length = MakeConstantScene(std::move(mesh)).Render(Grey, grid).Length[0];
      EXPECT_NEAR(length, static_cast<double>(expected), example.Tolerance) << "trial " << trial;
      hits += expected > 0;
    }
    EXPECT_GT(hits, 50);
  }
}

TEST(Reference, LeavesOutOnlyPixelsThatSeeNothing)
{
  // Random overlapping cells, large, small and flat, around the camera. Steps of the begin that are
  // too small to move it make a grid that is no camera, of which every pixel tries every cell.
  std::mt19937_64 generator(31);
  std::uniform_real_distribution<double> unit(-1, 1);
  Scene scene;
  for (int cell = 0; cell < 500; ++cell)
  {
    const double size = std::pow(10, 2 * unit(generator) - 1.5);
    const double thickness = std::pow(10, 3 * unit(generator) - 3);
    const double center[3] = { 3 * unit(generator), 3 * unit(generator), 3 * unit(generator) };
    const double normal[3] = { unit(generator), unit(generator), unit(generator) };
    for (int i = 0; i < 4; ++i)
    {
      double p[3] = { unit(generator), unit(generator), unit(generator) };
      const double height = p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2];
      const double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
      for (int axis = 0; axis < 3; ++axis)
      {
        p[axis] += (thickness - 1) * height / square * normal[axis];
        scene.Mesh.Points.push_back(center[axis] + size * p[axis]);
      }
      scene.Mesh.Cells.push_back(4 * cell + i);
      scene.Scalars.push_back(0);
    }
  }
  for (const double viewAngle : { 1.0, 40.0, 150.0 })
  {
    RayGrid grid =
      MakePerspectiveGrid({ 0.1, 0.2, 0.3 }, { 1, -0.5, 2 }, { 0, 1, 0 }, viewAngle, 53, 41);
    const ReferenceImage image = scene.Render(Grey, grid);
    grid.OriginStepX[0] = 1e-200;
    const ReferenceImage expected = scene.Render(Grey, grid);
    EXPECT_GT(image.NumberOfSegments, 1000);
    EXPECT_EQ(image.NumberOfSegments, expected.NumberOfSegments) << viewAngle;
    EXPECT_EQ(image.Rgba, expected.Rgba);
  }
  RayGrid grid = MakeParallelGrid({ 5, 6, 7 }, { 0, 0, 0 }, { 0, 1, 0 }, 4, 53, 41);
  const ReferenceImage image = scene.Render(Grey, grid);
  grid.DirectionStepX[0] = 1e-200;
  const ReferenceImage expected = scene.Render(Grey, grid);
  EXPECT_EQ(image.NumberOfSegments, expected.NumberOfSegments);
  EXPECT_EQ(image.Rgba, expected.Rgba);
}

} // namespace
