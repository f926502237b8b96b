// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/IntervalTable.h"
#include "RayCast/RayCaster.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"
#include "Scene/VisibleCells.h"
#include "Walk/WalkMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace tetralux
{
namespace
{

/// Random nodes at multiples of 1/8, many of them without attenuation, some with a step.
TransferFunction MakeRandomFunction(std::mt19937_64& random)
{
  std::uniform_int_distribution<int> position(0, 8);
  std::uniform_int_distribution<int> level(0, 2);
  std::vector<int> positions;
  const int count = 1 + position(random) / 2;
  while (static_cast<int>(positions.size()) < count)
  {
    const int p = position(random);
    if (std::find(positions.begin(), positions.end(), p) == positions.end())
    {
      positions.push_back(p);
    }
  }
  std::sort(positions.begin(), positions.end());
  TransferFunction function;
  for (int p : positions)
  {
    const double left = std::max(0, level(random) - 1);
    const double right = level(random) == 0 ? 1 - left : left;
    function.Nodes.push_back({ p / 8., { { 1, 1, 1 }, left }, { { 1, 1, 1 }, right } });
  }
  return function;
}

TEST(VisibleCells, AgreeWithSamplesOfEveryCell)
{
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> sixteenth(-2, 18);
  // Nodes lie at eighths and scalars at sixteenths: samples at 64ths, off the nodes, see every
  // interval that a cell meets in more than a point.
  for (int round = 0; round < 200; ++round)
  {
    const TransferFunction function = MakeRandomFunction(random);
    std::vector<double> scalars(40);
    for (double& s : scalars)
    {
      s = sixteenth(random) / 16.;
    }
    std::vector<std::int32_t> cells;
    for (int t = 0; t < 10; ++t)
    {
      cells.insert(cells.end(), { 4 * t, 4 * t + 1, 4 * t + 2, 4 * t + 3 });
    }
    const std::vector<std::uint8_t> visible = FindVisibleCells(function, cells, scalars, false);
    for (int t = 0; t < 10; ++t)
    {
      const auto range = std::minmax_element(&scalars[4 * t], &scalars[4 * t] + 4);
      const double lo = *range.first;
      const double hi = *range.second;
      bool seen = lo == hi && Evaluate(function, lo).Attenuation > 0;
      for (double s = lo + 1 / 64.; s < hi; s += 1 / 32.)
      {
        seen = seen || Evaluate(function, s).Attenuation > 0;
      }
      EXPECT_EQ(visible[t] != 0, seen) << "round " << round << ", cell " << t;
    }
  }
}

TEST(VisibleCells, ScalarsOfCellsAndScalarsThatAreNotFinite)
{
  const TransferFunction function =
    MakeLinearFunction({ { 0, 1, 1, 1, 0 }, { 1, 1, 1, 1, 1 }, { 2, 1, 1, 1, 0 } });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<std::int32_t> cells = { 0, 1, 2, 3, 1, 2, 3, 4, 1, 2, 3, 5 };
  EXPECT_EQ(FindVisibleCells(function, cells, std::vector<double>{ 0, 0.5, nan }, true),
    (std::vector<std::uint8_t>{ 0, 1, 0 }));
  EXPECT_EQ(FindVisibleCells(function, cells, std::vector<double>{ 1, 0, 0, 0, inf, 0 }, false),
    (std::vector<std::uint8_t>{ 1, 0, 0 }));
}

TEST(VisibleCells, CellsThatSurfacesGoThroughOrTouch)
{
  const std::vector<std::int32_t> cells = { 0, 1, 2, 3, 1, 2, 3, 4, 0, 0, 0, 0 };
  const std::vector<double> scalars = { 0, 1, 1.5, 2, 2.5 };
  const auto find = [&](double value, float opacity, double rounding)
  {
    return FindCrossedCells(
      std::vector<Isosurface>{ { value, { 1, 1, 1 }, opacity } }, cells, scalars, rounding);
  };
  using Flags = std::vector<std::uint8_t>;
  EXPECT_EQ(find(0.5, 1, 0), (Flags{ 1, 0, 0 }));
  EXPECT_EQ(find(0.5, 0, 0), (Flags{ 0, 0, 0 }));
  EXPECT_EQ(find(0, 1, 0), (Flags{ 1, 0, 1 }));
  EXPECT_EQ(find(2.5, 1, 0), (Flags{ 0, 1, 0 }));
  // Beside all scalars of a cell, but within the rounding.
  EXPECT_EQ(find(2.6, 1, 0.2), (Flags{ 0, 1, 0 }));
  EXPECT_EQ(find(-0.1, 1, 0.2), (Flags{ 1, 0, 1 }));
  EXPECT_EQ(find(-0.1, 1, 0), (Flags{ 0, 0, 0 }));
}

TEST(VisibleCells, LeavingTransparentCellsOutChangesNoPixel)
{
  // A shell of small radius in a box: most cells are empty, and rays enter the shell twice.
  const TetrahedralMesh box = MakeBox(14, 14, 14, { -1, -1, -1 }, { 1, 1, 1 }, 0.1);
  std::vector<double> radii;
  for (std::size_t p = 0; p < box.GetNumberOfPoints(); ++p)
  {
    radii.push_back(std::hypot(box.Points[3 * p], box.Points[3 * p + 1], box.Points[3 * p + 2]));
  }
  const TransferFunction function = MakeLinearFunction({ { 0, 0, 0, 1, 0 }, { 0.4, 0, 0, 1, 0 },
    { 0.5, 0, 1, 0, 5 }, { 0.6, 1, 0, 0, 0 }, { 2, 1, 0, 0, 0 } });
  const RayGrid grid = MakePerspectiveGrid({ 3, 2, 2.5 }, { 0, 0, 0 }, { 0, 1, 0 }, 30, 64, 64);

  auto mesh = std::make_shared<WalkMesh>(box);
  std::vector<double> scalars;
  for (std::int64_t p : mesh->GetMesh().OriginalPoints)
  {
    scalars.push_back(radii[p]);
  }
  VolumeScene volume;
  volume.Mesh.SetMesh(mesh);
  volume.Mesh.SetPointScalars(scalars);
  volume.Optics.SetTransferFunction(function);
  std::vector<float> colors(4 * 64 * 64), depths(64 * 64);
  const RayCastStatistics statistics =
    CastRays(volume, grid, RayLimits(), RayCastOptions(), colors, depths);
  EXPECT_GT(statistics.TransparentCells, mesh->GetNumberOfCells() / 2);

  const ReferenceImage reference =
    RenderReference({ box.Points, box.Cells, radii, false }, function, grid);
  EXPECT_LT(statistics.Segments, reference.NumberOfSegments / 2);
  double largest = 0;
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    largest = std::max(largest, std::abs(colors[i] - reference.Rgba[i]));
  }
  // MaximumError of the options.
  EXPECT_LT(largest, 1e-4);
}

} // namespace
} // namespace tetralux
