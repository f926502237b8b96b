// SPDX-License-Identifier: BSD-3-Clause
#include "Generate/GeneratedShape.h"

#include "Generate/LatticeMesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tetralux
{
namespace
{

using Point = std::array<double, 3>;

/// Unit cubes of cells^3 hexahedra side by side: count(s) along the axes, gap between them.
void AddCubes(const std::array<int, 3>& counts, int cells, double gap, TetrahedralMesh& mesh)
{
  CheckNumberOfTetrahedra(5.0 * counts[0] * counts[1] * counts[2] * std::pow(cells, 3));
  for (int cube = 0; cube < counts[0] * counts[1] * counts[2]; ++cube)
  {
    const int indices[3] = { cube % counts[0], cube / counts[0] % counts[1],
      cube / (counts[0] * counts[1]) };
    Lattice lattice;
    lattice.Cells = { cells, cells, cells };
    lattice.Place = [&](int i, int j, int k) -> Point
    {
      return { indices[0] * (1 + gap) + static_cast<double>(i) / cells,
        indices[1] * (1 + gap) + static_cast<double>(j) / cells,
        indices[2] * (1 + gap) + static_cast<double>(k) / cells };
    };
    AddLattice(lattice, mesh);
  }
}

/// Hexahedra of the same size in a box from the origin on, those that isKept wants.
template <class IsKept>
void AddBlocks(
  const std::array<int, 3>& cells, double cellSize, const IsKept& isKept, TetrahedralMesh& mesh)
{
  Lattice lattice;
  lattice.Cells = cells;
  lattice.IsKept = isKept;
  lattice.Place = [cellSize](int i, int j, int k) -> Point {
    return { i * cellSize, j * cellSize, k * cellSize };
  };
  AddLattice(lattice, mesh);
}

} // namespace

//----------------------------------------------------------------------------
void MakeCubes(const Values& values, GeneratedMesh& result)
{
  const int count = values.GetCount("count");
  const double gap = values.Get("gap");
  AddCubes({ count, count, count }, values.GetCount("cells"), gap, result.Mesh);
  const double size = count + (count - 1) * gap;
  SetScalars(
    result, [size](double x, double y, double z) { return GetGyroid(x, y, z, size / 1.5); });
}

//----------------------------------------------------------------------------
void MakeCavity(const Values& values, GeneratedMesh& result)
{
  const int cells = values.GetCount("cells");
  // As many layers on all sides, and at least one.
  const int layers = std::clamp(
    static_cast<int>(std::lround(0.5 * (1 - values.Get("cavity")) * cells)), 1, (cells - 1) / 2);
  const auto isInside = [=](int i) { return i >= layers && i < cells - layers; };
  AddBlocks(
    { cells, cells, cells }, 1.0 / cells,
    [isInside](int i, int j, int k) { return !(isInside(i) && isInside(j) && isInside(k)); },
    result.Mesh);
  SetScalars(result,
    [](double x, double y, double z)
    {
      const double distance = std::hypot(x - 0.5, y - 0.5, z - 0.5);
      return 0.5 + 0.5 * std::cos(20 * distance) * std::cos(2 * std::atan2(y - 0.5, x - 0.5));
    });
}

//----------------------------------------------------------------------------
void MakeSharedEdge(const Values& values, GeneratedMesh& result)
{
  const int cells = values.GetCount("cells");
  AddBlocks(
    { 2 * cells, 2 * cells, cells }, 1.0 / cells,
    [cells](int i, int j, int) { return (i < cells) == (j < cells); }, result.Mesh);
  SetScalars(result, [](double x, double y, double z) { return GetGyroid(x, y, z, 1.2); });
}

//----------------------------------------------------------------------------
void MakeCheckerboard(const Values& values, GeneratedMesh& result)
{
  const int blocks = values.GetCount("blocks");
  const int cells = values.GetCount("cells");
  const int all = blocks * cells;
  AddBlocks(
    { all, all, all }, 1.0 / all,
    [cells](int i, int j, int k) { return (i / cells + j / cells + k / cells) % 2 == 0; },
    result.Mesh);
  SetScalars(result, [](double x, double y, double z) { return GetGyroid(x, y, z, 0.7); });
}

//----------------------------------------------------------------------------
void MakeHeatSink(const Values& values, GeneratedMesh& result)
{
  const int fins = values.GetCount("fins");
  const int cells = values.GetCount("cells"); // across a fin, a gap, and the base
  const double length = values.Get("length");
  const double height = values.Get("height");
  const auto toCells = [cells](double size)
  { return std::max(1, static_cast<int>(std::lround(size * cells))); };
  AddBlocks(
    { (2 * fins - 1) * cells, toCells(length), cells + toCells(height) }, 1.0 / cells,
    [cells](int i, int, int k) { return k < cells || i / cells % 2 == 0; }, result.Mesh);

  // Warm above a chip in the middle, and cooler up the fins.
  const double middle = 0.5 * (2 * fins - 1);
  SetScalars(result,
    [=](double x, double y, double z)
    {
      const double distance = Square((x - middle) / middle) + Square(2 * y / length - 1);
      return std::exp(-1.5 * z / (1 + height)) * (0.35 + 0.65 * std::exp(-3 * distance));
    });
}

} // namespace tetralux
