// SPDX-License-Identifier: BSD-3-Clause
// The oracle's pictures, against scenes whose radiance is known in closed form.
#include "ReferenceIntegral.h"
#include "ReferencePictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace
{

using namespace tetralux;
using namespace tetralux::reference_pictures;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// A linear field is linear across every cell, so the picture of a box has a closed form for any
/// mesh inside of it.
void ExpectLinearBox(const Scene& scene, const Vector& lower, const Vector& upper,
  const Vector& gradient, double constant, const RayGrid& grid, double tolerance)
{
  const TransferFunction function = MakeLinearFunction({ { -2, 0.1, 0.9, 0.4, 0 },
    { 0.1, 1, 0, 0, 0.2 }, { 0.3, 0, 0.5, 1, 4 }, { 0.9, 1, 1, 0, 0.1 }, { 2, 0, 0, 1, 1 } });
  const ReferenceImage image = scene.Render(function, grid);
  double largest = 0;
  int covered = 0;
  for (int pixel = 0; pixel < grid.Width * grid.Height; ++pixel)
  {
    const WorldRay ray = GetRay(grid, pixel % grid.Width, pixel / grid.Width);
    const Chord chord = ClipByBox(ray, lower, upper);
    const auto scalar = [&](long double t)
    {
      long double s = constant;
      for (int axis = 0; axis < 3; ++axis)
      {
        s += gradient[axis] * (ray.Origin[axis] + t * ray.Direction[axis]);
      }
      return static_cast<double>(s);
    };
    ReferenceSegment expected;
    if (chord.Length() > 0)
    {
      ++covered;
      expected =
        IntegrateReference(function, scalar(chord.Begin), scalar(chord.End), chord.Length());
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      largest =
        std::max(largest, std::abs(image.Rgba[4 * pixel + channel] - expected.Color[channel]));
    }
    largest = std::max(largest, std::abs(image.Rgba[4 * pixel + 3] - expected.Alpha));
    largest = std::max(largest, std::abs(image.Length[pixel] - chord.Length()));
  }
  EXPECT_LT(largest, tolerance);
  EXPECT_GT(covered, 150);
}

TEST(Reference, LinearFieldInAJitteredBox)
{
  const Vector gradient{ 0.4, -0.7, 0.6 };
  const Scene scene =
    MakeLinearScene(MakeBox(7, 6, 5, { 0, 0, 0 }, { 1, 1.2, 0.9 }, 0.15, 3), gradient, 0.3);
  const Vector upper{ 1, 1.2, 0.9 };
  const Vector center{ 0.5, 0.6, 0.45 };
  const Vector up{ 0, 1, 0.1 };
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int view = 0; view < 4; ++view)
  {
    const Vector position{ 0.5 + 3 * unit(generator), 0.6 + 3 * unit(generator),
      0.45 + 3 * unit(generator) };
    ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
      MakePerspectiveGrid(position, center, up, 40, 37, 29), 1e-13);
    ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
      MakeParallelGrid(position, center, up, 0.7, 37, 29), 1e-13);
  }
  // From inside, also what lies behind the camera; and a view of 170 degrees.
  ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
    MakePerspectiveGrid({ 0.31, 0.52, 0.23 }, center, up, 100, 37, 29), 1e-13);
  ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
    MakePerspectiveGrid({ 0.5, 0.6, 1.0 }, center, up, 170, 37, 29), 1e-13);
  // At a vertex of the mesh.
  ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
    MakePerspectiveGrid({ scene.Mesh.Points[300], scene.Mesh.Points[301], scene.Mesh.Points[302] },
      { 0.5, 0.6, 2 }, up, 100, 37, 29),
    1e-13);
}

TEST(Reference, GridsThatAreNoCamera)
{
  // Both the begin and the direction vary: no image plane to project to.
  const Vector gradient{ 0.4, -0.7, 0.6 };
  const Scene scene =
    MakeLinearScene(MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3), gradient, 0.3);
  RayGrid grid = MakeParallelGrid({ 0.5, 0.5, 3 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.7, 25, 25);
  grid.DirectionStepX[0] = 0.01;
  grid.DirectionStepY[1] = -0.02;
  ExpectLinearBox(scene, { 0, 0, 0 }, { 1, 1, 1 }, gradient, 0.3, grid, 1e-13);
}

TEST(Reference, FlatCellsKeepTheirShare)
{
  // A boundary layer: cells with edges of 1 by 1e-6.
  const Vector upper{ 1, 1, 8e-6 };
  const Vector gradient{ 0.4, 0.2, 3e4 };
  const Scene scene = MakeLinearScene(MakeBox(8, 8, 8, { 0, 0, 0 }, upper, 0.15, 9), gradient, 0.1);
  ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.1,
    MakePerspectiveGrid({ 0.4, 0.3, 2 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 30, 33, 33), 1e-11);
}

TEST(Reference, LengthsAreMeasuredInTheWorld)
{
  // Scaling, shear, rotation and a mirror, applied by the renderer or to the points beforehand.
  const double matrix[3][4] = { { 2, 0.7, -0.3, 5 }, { 0.2, -0.5, 1.1, -3 },
    { -0.4, 0.6, 0.8, 1 } };
  const Scene scene =
    MakeLinearScene(MakeBox(4, 5, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3), { 0.3, 0.4, 0.2 }, 0);
  Scene moved = scene;
  for (std::size_t i = 0; i < moved.Mesh.Points.size(); i += 3)
  {
    const double* p = scene.Mesh.Points.data() + i;
    for (int row = 0; row < 3; ++row)
    {
      moved.Mesh.Points[i + row] =
        matrix[row][0] * p[0] + matrix[row][1] * p[1] + matrix[row][2] * p[2] + matrix[row][3];
    }
  }
  const TransferFunction ramp =
    MakeLinearFunction({ { 0, 1, 0, 0.2, 0.1 }, { 0.5, 0, 1, 0, 3.0 }, { 1, 1, 1, 0, 0 } });
  for (const bool parallel : { false, true })
  {
    const Vector center{ 6.2, -2.6, 1.5 };
    RayGrid grid = parallel ? MakeParallelGrid({ 9, 1, 6 }, center, { 0, 0, 1 }, 1.4, 41, 33)
                            : MakePerspectiveGrid({ 9, 1, 6 }, center, { 0, 0, 1 }, 25, 41, 33);
    RayLimits limits;
    limits.Planes.push_back({ 0.3, 0.5, -0.7, 0.6 });
    const ReferenceImage expected = moved.Render(ramp, grid, limits);
    PlaceMesh(grid, matrix);
    const ReferenceImage image = scene.Render(ramp, grid, limits);
    EXPECT_GT(*std::max_element(expected.Length.begin(), expected.Length.end()), 0.5);
    for (std::size_t k = 0; k < image.Rgba.size(); ++k)
    {
      EXPECT_NEAR(image.Rgba[k], expected.Rgba[k], 1e-13);
    }
    for (std::size_t pixel = 0; pixel < image.Depth.size(); ++pixel)
    {
      EXPECT_NEAR(image.Depth[pixel], expected.Depth[pixel], 1e-13);
    }
  }
}

TEST(Reference, FarFromTheOrigin)
{
  // Coordinates are rounded by the offset; taking it away again is exact.
  const struct
  {
    double Offset;
    double Size;
  } examples[] = { { 1e4, 1e-3 }, { 1e7, 1e-2 } };
  for (const auto& example : examples)
  {
    const double offset = example.Offset;
    const double size = example.Size;
    Scene far = MakeLinearScene(MakeBox(6, 6, 6, { offset, offset, offset },
                                  { offset + size, offset + size, offset + size }, 0.15, 3),
      { 0, 0, 0 }, 0);
    Scene near = far;
    for (std::size_t i = 0; i < near.Mesh.Points.size(); ++i)
    {
      near.Mesh.Points[i] -= offset;
      far.Scalars[i / 3] = near.Scalars[i / 3] = near.Mesh.Points[i / 3 * 3] / size;
    }
    const TransferFunction ramp = MakeLinearFunction(
      { { 0, 1, 0, 0.2, 0.1 / size }, { 0.5, 0, 1, 0, 3 / size }, { 1, 1, 1, 0, 0 } });
    RayGrid grid = MakePerspectiveGrid({ 2 * size, 3 * size, 4 * size },
      { 0.5 * size, 0.5 * size, 0.5 * size }, { 0, 1, 0 }, 20, 31, 31);
    double rounded[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      rounded[axis] = grid.Origin[axis] + offset;
      grid.Origin[axis] = rounded[axis] - offset;
    }
    const ReferenceImage expected = near.Render(ramp, grid);
    std::copy(rounded, rounded + 3, grid.Origin);
    const ReferenceImage image = far.Render(ramp, grid);
    double largest = 0;
    for (std::size_t k = 0; k < image.Rgba.size(); ++k)
    {
      largest = std::max(largest, std::abs(image.Rgba[k] - expected.Rgba[k]));
    }
    EXPECT_LT(largest, 1e-13) << offset;
    EXPECT_GT(*std::max_element(expected.Rgba.begin(), expected.Rgba.end()), 0.3);
  }
}

TEST(Reference, OpticalDepthOfAMillionInACell)
{
  const Scene scene = MakeLinearScene(MakeBox(1, 1, 1, { 0, 0, 0 }, { 1, 1, 1 }), { 0, 0, 1 }, 0);
  const TransferFunction function =
    MakeLinearFunction({ { 0, 1, 0, 0.5, 1e6 }, { 1, 0.25, 1, 0.5, 1e6 } });
  const ReferenceImage image =
    scene.Render(function, MakeSingleRay({ 0.4, 0.3, 2 }, { 0.4, 0.3, 0 }));
  EXPECT_EQ(image.Rgba[3], 1);
  EXPECT_NEAR(image.Rgba[0], 0.25 + 0.75e-6, 1e-15); // the mean depth of what is seen is 1e-6
  EXPECT_NEAR(image.Rgba[1], 1 - 1e-6, 1e-15);
  EXPECT_NEAR(image.Rgba[2], 0.5, 1e-15);
}

TEST(Reference, CellScalars)
{
  Scene scene;
  scene.Mesh = MakeBox(1, 1, 2, { 0, 0, 0 }, { 1, 1, 2 });
  scene.CellScalars = true;
  scene.Scalars.assign(10, 0.0);
  std::fill(scene.Scalars.begin() + 5, scene.Scalars.end(), 1.0);
  const TransferFunction function = MakeLinearFunction({ { 0, 1, 0, 0, 0.5 }, { 1, 0, 1, 0, 2 } });
  const RayGrid grid = MakeParallelGrid({ 0.5, 0.5, 4 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.5, 9, 9);
  const ReferenceImage image = scene.Render(function, grid);
  for (int pixel = 0; pixel < 81; ++pixel)
  {
    EXPECT_NEAR(image.Rgba[4 * pixel + 1], 1 - std::exp(-2.0), 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 0], std::exp(-2.0) * (1 - std::exp(-0.5)), 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], 1 - std::exp(-2.5), 1e-14);
  }
}

TEST(Reference, UnusableCellsAddNothing)
{
  // A good cell, then one for each thing that can be wrong.
  const Scene good = MakeUnitTetrahedron();
  Scene scene = good;
  const double infinity = std::numeric_limits<double>::infinity();
  scene.Mesh.Points.insert(
    scene.Mesh.Points.end(), { NaN, 0, 0, 0, infinity, 0, 1, 1, 1, -1, 0.5, 0.5 });
  scene.Scalars.insert(scene.Scalars.end(), { 0, 0, NaN, infinity });
  const std::int32_t unusable[][4] = { { 0, 1, 2, 4 }, { 0, 1, 2, 5 }, { 1, 2, 3, 6 },
    { 0, 2, 3, 7 }, { 0, 1, 2, 8 }, { 0, 1, 2, -1 }, { 0, 1, 2, 2 } };
  for (const auto& cell : unusable)
  {
    scene.Mesh.Cells.insert(scene.Mesh.Cells.end(), cell, cell + 4);
  }
  const RayGrid grid = MakePerspectiveGrid({ 2, 3, 4 }, { 0.4, 0.4, 0.4 }, { 0, 1, 0 }, 40, 25, 25);
  const ReferenceImage image = scene.Render(Grey, grid);
  const ReferenceImage expected = good.Render(Grey, grid);
  EXPECT_EQ(image.Rgba, expected.Rgba);
  EXPECT_GT(*std::max_element(image.Rgba.begin(), image.Rgba.end()), 0.1);
}

TEST(Reference, RendersOnlyThePixelsAskedFor)
{
  const Scene scene = MakeConstantScene(MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3));
  const RayGrid grid =
    MakePerspectiveGrid({ 1.5, 1.9, 2.3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 30, 24, 24);
  std::vector<std::uint8_t> pixels(24 * 24, 0);
  pixels[24 * 11 + 12] = 1;
  const ReferenceImage whole = scene.Render(Grey, grid);
  const ReferenceImage image = scene.Render(Grey, grid, {}, pixels);
  for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel)
  {
    EXPECT_EQ(image.Rgba[4 * pixel + 3], pixels[pixel] ? whole.Rgba[4 * pixel + 3] : 0);
    EXPECT_EQ(image.Depth[pixel], pixels[pixel] ? whole.Depth[pixel] : -1);
  }
  EXPECT_GT(image.Rgba[4 * (24 * 11 + 12) + 3], 0.5);

  const ReferenceImage tile = scene.Render(Grey, MakeTile(grid, 5, 7, 10, 6));
  for (int pixel = 0; pixel < 60; ++pixel)
  {
    const int other = 5 + pixel % 10 + 24 * (7 + pixel / 10);
    EXPECT_NEAR(tile.Rgba[4 * pixel + 3], whole.Rgba[4 * other + 3], 1e-14);
  }
}

TEST(Reference, RefusesSizesThatDoNotFit)
{
  Scene scene = MakeUnitTetrahedron();
  const RayGrid grid = MakeSingleRay({ 0, 0, 2 }, { 0, 0, 0 });
  EXPECT_THROW(scene.Render(TransferFunction(), grid), std::invalid_argument);
  EXPECT_THROW(scene.Render(Grey, RayGrid()), std::invalid_argument);
  scene.Scalars.pop_back();
  EXPECT_THROW(scene.Render(Grey, grid), std::invalid_argument);
}

} // namespace
