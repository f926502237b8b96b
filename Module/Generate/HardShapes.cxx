// SPDX-License-Identifier: BSD-3-Clause
#include "Generate/GeneratedShape.h"

#include "Generate/LatticeMesh.h"
#include "Generate/SchoenhardtNotch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace tetralux
{
namespace
{

using Point = std::array<double, 3>;

} // namespace

//----------------------------------------------------------------------------
void MakeBoundaryLayer(const Values& values, GeneratedMesh& result)
{
  const double ratio = values.Get("ratio");
  const int cells = values.GetCount("cells");
  const int layers = values.GetCount("layers");

  // Layers that grow by a constant factor, from the shortest edge of the mesh to the width of the
  // other edges, whose diagonals are the longest edges.
  const double width = 1.0 / cells;
  const double thinnest = std::sqrt(2.0) * width / ratio;
  std::vector<double> heights = { 0 };
  for (int layer = 0; layer < layers; ++layer)
  {
    const double thickness =
      thinnest * std::pow(width / thinnest, static_cast<double>(layer) / (layers - 1));
    heights.push_back(heights.back() + thickness);
  }

  Lattice lattice;
  lattice.Cells = { cells, cells, layers };
  lattice.Place = [&heights, cells](int i, int j, int k) -> Point {
    return { static_cast<double>(i) / cells, static_cast<double>(j) / cells, heights[k] };
  };
  AddLattice(lattice, result.Mesh);

  // Speed over a plate that waves of the flow run along.
  const double height = heights.back();
  SetScalars(result,
    [height](double x, double y, double z)
    {
      const double thickness =
        height * (0.2 + 0.05 * std::sin(2 * Pi * (x + 0.2 * std::sin(2 * Pi * y))));
      return 1 - std::exp(-z / thickness);
    });
}

//----------------------------------------------------------------------------
void MakeSchoenhardt(const Values& values, GeneratedMesh& result)
{
  AddSchoenhardtNotch(values.Get("twist") * Pi / 180, values.GetCount("cells"), result.Mesh);
  SetScalars(result, [](double x, double y, double z) { return GetGyroid(x, y, z, 1); });
}

//----------------------------------------------------------------------------
void MakeCycle(const Values& values, GeneratedMesh& result)
{
  const int bars = values.GetCount("bars");
  const int cells = values.GetCount("cells");
  // Tangents of a circle, which cross their neighbors at the distance 1 from where they touch it;
  // each rises, so that its end lies above the next one's start. Its cells lean back over those
  // that follow: seen along z the first one covers the second, and so on to the end of the bar,
  // which covers the next bar.
  const double circleRadius = 1 / std::tan(Pi / bars);
  constexpr double halfLength = 1.3;
  constexpr double width = 0.2;
  constexpr double thickness = 0.1;
  constexpr double rise = 0.15;
  constexpr double lean = 3; // more than the rise
  const double tilt = std::atan(rise);
  for (int bar = 0; bar < bars; ++bar)
  {
    const double angle = 2 * Pi * bar / bars;
    const Point outward = { std::cos(angle), std::sin(angle), 0 };
    const Point along = { -std::sin(angle) * std::cos(tilt), std::cos(angle) * std::cos(tilt),
      std::sin(tilt) };
    const Point up = { outward[1] * along[2] - outward[2] * along[1],
      outward[2] * along[0] - outward[0] * along[2],
      outward[0] * along[1] - outward[1] * along[0] };
    Lattice lattice;
    lattice.Cells = { 2 * cells, 26 * cells, cells }; // cubes
    lattice.Place = [&](int i, int j, int k) -> Point
    {
      const double x = circleRadius + width * (static_cast<double>(i) / lattice.Cells[0] - 0.5);
      const double z = thickness * (static_cast<double>(k) / lattice.Cells[2] - 0.5);
      const double y = halfLength * (2.0 * j / lattice.Cells[1] - 1) + lean * z;
      return { x * outward[0] + y * along[0] + z * up[0], x * outward[1] + y * along[1] + z * up[1],
        x * outward[2] + y * along[2] + z * up[2] };
    };
    AddLattice(lattice, result.Mesh);
  }
  SetScalars(result, [](double x, double y, double z) { return GetGyroid(x, y, z, 1); });
}

//----------------------------------------------------------------------------
void MakeRandom(const Values& values, GeneratedMesh& result)
{
  const int cells = values.GetCount("cells");
  const double removed = values.Get("removed");
  std::mt19937_64 random(static_cast<std::uint64_t>(values.GetCount("seed")));
  // std::uniform_real_distribution may differ from one standard library to the next.
  const auto draw = [&random] { return std::ldexp(static_cast<double>(random() >> 11), -53); };

  // Of the five tetrahedra of a cube, those at the corners are the flattest: as long as no point
  // moves by more than half of their height, 1 / sqrt(12), none is turned over. 0.16 along each
  // axis is a little less.
  const double amplitude = 0.16 * values.Get("jitter");
  const auto place = [=](int i) -> double
  {
    const double shift = amplitude * (2 * draw() - 1);
    return (i == 0 || i == cells ? i : i + shift) / cells;
  };
  Lattice lattice;
  lattice.Cells = { cells, cells, cells };
  lattice.Place = [&place](int i, int j, int k) -> Point {
    return { place(i), place(j), place(k) };
  };
  AddLattice(lattice, result.Mesh);

  std::vector<std::int32_t>& corners = result.Mesh.Cells;
  std::size_t kept = 0;
  for (std::size_t cell = 0; cell < corners.size(); cell += 4)
  {
    if (draw() >= removed)
    {
      std::copy_n(&corners[cell], 4, &corners[kept]);
      kept += 4;
    }
  }
  corners.resize(kept);
  SetScalars(result, [](double x, double y, double z) { return GetGyroid(x, y, z, 0.8); });
}

} // namespace tetralux
