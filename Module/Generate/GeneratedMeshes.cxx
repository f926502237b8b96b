// SPDX-License-Identifier: BSD-3-Clause
#include "Generate/GeneratedMeshes.h"

#include "Generate/LatticeMesh.h"
#include "Generate/SchoenhardtNotch.h"
#include "Mesh/CellSplit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>
#include <stdexcept>

namespace tetralux
{
namespace
{

using Point = std::array<double, 3>;

const double Pi = std::acos(-1.0);

/// The values of a generator's parameters, all of them given and in range.
class Values
{
public:
  explicit Values(const std::map<std::string, double>& values)
    : Given(values)
  {
  }
  double Get(const char* name) const { return this->Given.at(name); }
  int GetCount(const char* name) const { return static_cast<int>(this->Given.at(name)); }

private:
  const std::map<std::string, double>& Given;
};

struct Recipe
{
  const char* Name;
  const char* Description;
  std::vector<GeneratorParameter> Parameters;
  std::vector<std::string> WholeNumbers; ///< the parameters that count something
  void (*Make)(const Values& values, GeneratedMesh& result);
};

template <class Field>
void SetScalars(GeneratedMesh& result, const Field& field)
{
  const auto numberOfPoints = static_cast<std::int64_t>(result.Mesh.GetNumberOfPoints());
  result.Scalars.resize(numberOfPoints);
#pragma omp parallel for schedule(static)
  for (std::int64_t point = 0; point < numberOfPoints; ++point)
  {
    const double* position = &result.Mesh.Points[3 * point];
    result.Scalars[point] = field(position[0], position[1], position[2]);
  }
}

/// A field with structure in all directions: the gyroid, shifted and scaled to 0 ... 1.
/// wavelength: in the units of the coordinates.
double GetGyroid(double x, double y, double z, double wavelength)
{
  const double frequency = 2 * Pi / wavelength;
  const double gyroid = std::sin(frequency * x) * std::cos(frequency * y) +
    std::sin(frequency * y) * std::cos(frequency * z) +
    std::sin(frequency * z) * std::cos(frequency * x);
  return 0.5 + gyroid / 3;
}

double Square(double value) { return value * value; }

//----------------------------------------------------------------------------
void MakeRing(const Values& values, GeneratedMesh& result)
{
  const int around = values.GetCount("around");
  const int across = values.GetCount("across");
  const double waves = values.Get("waves");
  const double turns = values.Get("turns");
  constexpr double radius = 1;
  constexpr int strands = 3;

  // The centre line waves up and down, the tube's radius with twice the frequency.
  const auto getHeight = [waves](double angle) { return 0.16 * std::sin(waves * angle); };
  const auto getTubeRadius = [waves](double angle)
  { return 0.4 * (1 + 0.12 * std::cos(2 * waves * angle)); };

  Lattice lattice;
  lattice.Cells = { across, around, across };
  lattice.IsPeriodic = { false, true, false };
  lattice.Place = [=](int i, int j, int k) -> Point
  {
    // The square of lattice points of a cross section becomes round, but keeps enough of its corners
    // for cells of good shape.
    constexpr double roundness = 0.7;
    const double a = 2.0 * i / across - 1;
    const double b = 2.0 * k / across - 1;
    const double length = std::hypot(a, b);
    const double rounding = length > 0 ? std::max(std::abs(a), std::abs(b)) / length : 1;
    const double angle = 2 * Pi * j / around;
    const double scale = getTubeRadius(angle) * (1 - roundness + roundness * rounding);
    const double distance = radius + scale * a;
    return { distance * std::cos(angle), distance * std::sin(angle), getHeight(angle) + scale * b };
  };
  AddLattice(lattice, result.Mesh);

  // Strands that wind around the centre line, each a ridge of the field.
  SetScalars(result,
    [=](double x, double y, double z)
    {
      constexpr double strandDistance = 0.52; // these two in units of the tube's radius
      constexpr double strandWidth = 0.2;
      const double angle = std::atan2(y, x);
      const double tubeRadius = getTubeRadius(angle);
      const double a = (std::hypot(x, y) - radius) / tubeRadius;
      const double b = (z - getHeight(angle)) / tubeRadius;
      double sum = 0;
      for (int strand = 0; strand < strands; ++strand)
      {
        const double phase = (2 * Pi * strand + turns * angle) / strands;
        sum += std::exp(-(Square(a - strandDistance * std::cos(phase)) +
                          Square(b - strandDistance * std::sin(phase))) /
          (2 * Square(strandWidth)));
      }
      return sum * (0.8 + 0.2 * std::cos(angle));
    });
}

//----------------------------------------------------------------------------
void MakeBall(const Values& values, GeneratedMesh& result)
{
  const double radius = values.Get("radius");
  const int cells = values.GetCount("cells");
  // A cube in the middle, and on each of its sides layers that grow round.
  const int layers = std::max(1, cells / 4);
  const int inner = cells - 2 * layers;
  const int points = inner + 1;
  CheckNumberOfTetrahedra(5 * (std::pow(inner, 3) + 6 * std::pow(inner, 2) * layers));

  const auto place = [=](int i, int j, int k, int layer) -> Point
  {
    constexpr double innerSize = 0.5; // of the ball's radius, from the centre to a side
    constexpr double roundness = 0.4; // between a cube and a ball
    const Point cube = { 2.0 * i / inner - 1, 2.0 * j / inner - 1, 2.0 * k / inner - 1 };
    const double length = std::hypot(cube[0], cube[1], cube[2]);
    const double side = std::max({ std::abs(cube[0]), std::abs(cube[1]), std::abs(cube[2]) });
    const double rounding = length > 0 ? side / length : 1;
    const double start = innerSize * (1 - roundness + roundness * rounding);
    const double outward = static_cast<double>(layer) / layers;
    const double scale = radius * ((1 - outward) * start + outward * rounding);
    return { scale * cube[0], scale * cube[1], scale * cube[2] };
  };

  Lattice lattice;
  lattice.Cells = { inner, inner, inner };
  lattice.Place = [&place](int i, int j, int k) { return place(i, j, k, 0); };
  AddLattice(lattice, result.Mesh);

  // ids of the points above the cube's surface: the layers above a surface point lie one behind the
  // other.
  const auto getNumber = [points](const std::array<int, 3>& at)
  { return (std::int64_t{ at[2] } * points + at[1]) * points + at[0]; };
  std::vector<std::int64_t> firstLayer(result.Mesh.GetNumberOfPoints(), -1);
  for (int k = 0; k < points; ++k)
  {
    for (int j = 0; j < points; ++j)
    {
      for (int i = 0; i < points; ++i)
      {
        if (i % inner != 0 && j % inner != 0 && k % inner != 0)
        {
          continue;
        }
        firstLayer[getNumber({ i, j, k })] =
          static_cast<std::int64_t>(result.Mesh.GetNumberOfPoints());
        for (int layer = 1; layer <= layers; ++layer)
        {
          const Point position = place(i, j, k, layer);
          result.Mesh.Points.insert(result.Mesh.Points.end(), position.begin(), position.end());
        }
      }
    }
  }
  const auto getId = [&](const std::array<int, 3>& at, int layer)
  { return layer == 0 ? getNumber(at) : firstLayer[getNumber(at)] + layer - 1; };

  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    const bool isUpper = side % 2 != 0;
    for (int u = 0; u < inner; ++u)
    {
      for (int v = 0; v < inner; ++v)
      {
        // Counterclockwise from outside.
        constexpr int around[2][4][2] = { { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } },
          { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } };
        std::array<std::array<int, 3>, 4> corners;
        for (int corner = 0; corner < 4; ++corner)
        {
          corners[corner][axis] = isUpper ? inner : 0;
          corners[corner][(axis + 1) % 3] = u + around[isUpper][corner][0];
          corners[corner][(axis + 2) % 3] = v + around[isUpper][corner][1];
        }
        for (int layer = 0; layer < layers; ++layer)
        {
          std::int64_t ids[8];
          for (int corner = 0; corner < 4; ++corner)
          {
            ids[corner] = getId(corners[corner], layer);
            ids[corner + 4] = getId(corners[corner], layer + 1);
          }
          // Points whose indices and layer have an even sum only have neighbors with an odd sum.
          const bool isOdd = (corners[0][0] + corners[0][1] + corners[0][2] + layer) % 2 != 0;
          std::int64_t tets[5 * 4];
          SplitStructuredHexahedron(ids, isOdd, tets);
          result.Mesh.Cells.insert(result.Mesh.Cells.end(), tets, tets + 5 * 4);
        }
      }
    }
  }

  SetScalars(result,
    [=](double x, double y, double z)
    {
      const double falloff = 1 - 0.5 * (Square(x) + Square(y) + Square(z)) / Square(radius);
      return falloff * GetGyroid(x, y, z, radius);
    });
}

//----------------------------------------------------------------------------
void MakeCylinderWithHole(const Values& values, GeneratedMesh& result)
{
  const double radius = values.Get("radius");
  const double hole = values.Get("hole");
  const double height = values.Get("height");
  const int across = values.GetCount("across");
  const int around = values.GetCount("around");
  const int along = values.GetCount("along");

  Lattice lattice;
  lattice.Cells = { across, around, along };
  lattice.IsPeriodic = { false, true, false };
  lattice.Place = [=](int i, int j, int k) -> Point
  {
    const double distance = radius * (hole + (1 - hole) * i / across);
    const double angle = 2 * Pi * j / around;
    return { distance * std::cos(angle), distance * std::sin(angle), height * k / along };
  };
  AddLattice(lattice, result.Mesh);

  SetScalars(result,
    [=](double x, double y, double z)
    {
      const double distance = std::hypot(x, y) / radius;
      const double spiral = std::cos(4 * std::atan2(y, x) + 2 * Pi * z / height);
      const double inside = std::sin(Pi * (distance - hole) / (1 - hole));
      return 0.5 + spiral * (0.2 + 0.3 * inside);
    });
}

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
/// How far a gear reaches in the given fraction (0 ... 1) of a tooth: 0 at the root, 1 at the tip.
double GetToothProfile(double fraction)
{
  // Root for a quarter, flank, tip for a quarter, flank.
  const double fromTip = std::abs(2 * fraction - 1);
  return std::clamp((0.75 - fromTip) / 0.5, 0.0, 1.0);
}

/// twist: radians from the lower side of the gear to the upper one.
void AddGear(const Values& values, double twist, GeneratedMesh& result)
{
  const int teeth = values.GetCount("teeth");
  const double bore = values.Get("bore");
  const double thickness = values.Get("thickness");
  const int perTooth = values.GetCount("around");
  const int across = values.GetCount("across");
  const int along = values.GetCount("along");
  // Teeth about as high as they are wide, but of a few teeth not so high that they reach the bore.
  const double toothHeight = std::min(0.5 * (1 - bore), 4.5 / teeth);

  Lattice lattice;
  lattice.Cells = { across, teeth * perTooth, along };
  lattice.IsPeriodic = { false, true, false };
  lattice.Place = [=](int i, int j, int k) -> Point
  {
    const double tooth = GetToothProfile(static_cast<double>(j % perTooth) / perTooth);
    const double rim = 1 - toothHeight * (1 - tooth);
    const double distance = bore + (rim - bore) * i / across;
    const double angle = 2 * Pi * j / (static_cast<double>(teeth) * perTooth) + twist * k / along;
    return { distance * std::cos(angle), distance * std::sin(angle), thickness * k / along };
  };
  AddLattice(lattice, result.Mesh);

  // Something like the stress under a load at one tooth, and waves from the bore.
  SetScalars(result,
    [=](double x, double y, double z)
    {
      const double load = std::exp(-4 * (Square(x - 1) + Square(y) + Square(z - thickness / 2)));
      const double distance = std::hypot(x, y);
      return load + 0.3 * Square(bore / distance) * (1 + std::cos(8 * Pi * distance));
    });
}

void MakeGear(const Values& values, GeneratedMesh& result) { AddGear(values, 0, result); }

void MakeHelicalGear(const Values& values, GeneratedMesh& result)
{
  AddGear(values, values.Get("twist") * Pi / 180, result);
}

//----------------------------------------------------------------------------
void MakeSchoenhardt(const Values& values, GeneratedMesh& result)
{
  AddSchoenhardtNotch(values.Get("twist") * Pi / 180, values.GetCount("cells"), result.Mesh);
  SetScalars(result, [](double x, double y, double z) { return GetGyroid(x, y, z, 1); });
}

//----------------------------------------------------------------------------
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

void MakeSharedEdge(const Values& values, GeneratedMesh& result)
{
  const int cells = values.GetCount("cells");
  AddBlocks(
    { 2 * cells, 2 * cells, cells }, 1.0 / cells,
    [cells](int i, int j, int) { return (i < cells) == (j < cells); }, result.Mesh);
  SetScalars(result, [](double x, double y, double z) { return GetGyroid(x, y, z, 1.2); });
}

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

//----------------------------------------------------------------------------
void MakeCycle(const Values& values, GeneratedMesh& result)
{
  const int bars = values.GetCount("bars");
  const int cells = values.GetCount("cells");
  // Tangents of a circle, which cross their neighbors at the distance 1 from where they touch it;
  // each rises, so that its end lies above the next one's start.
  const double circleRadius = 1 / std::tan(Pi / bars);
  constexpr double halfLength = 1.3;
  constexpr double width = 0.2;
  constexpr double thickness = 0.1;
  constexpr double rise = 0.15;
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
      const double y = halfLength * (2.0 * j / lattice.Cells[1] - 1);
      const double z = thickness * (static_cast<double>(k) / lattice.Cells[2] - 0.5);
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

//----------------------------------------------------------------------------
const std::vector<Recipe>& GetRecipes()
{
  static const std::vector<Recipe> recipes = {
    { "ring", "a wavy ring; in its field, strands wind around each other into a knot",
      {
        { "around", 200, 4, 20000, "hexahedra around the ring" },
        { "across", 18, 1, 2000, "hexahedra across the tube, in both directions" },
        { "waves", 3, 0, 50, "waves of the ring and of its tube, in one round" },
        { "turns", 10, 0, 200, "thirds of a turn that a strand makes in one round" },
      },
      { "around", "across", "waves", "turns" }, MakeRing },
    { "ball", "a ball around the origin",
      {
        { "radius", 1, 1e-30, 1e30, "radius" },
        { "cells", 40, 3, 600, "hexahedra across the ball; makes 2.5 cells^3 tetrahedra" },
      },
      { "cells" }, MakeBall },
    { "cylinder-with-hole", "a thick pipe, on z = 0",
      {
        { "radius", 1, 1e-30, 1e30, "outer radius" },
        { "hole", 0.5, 1e-3, 0.999, "radius of the hole, in outer radii" },
        { "height", 2, 1e-30, 1e30, "height" },
        { "across", 12, 1, 5000, "hexahedra through the wall" },
        { "around", 96, 4, 20000, "hexahedra around" },
        { "along", 48, 1, 20000, "hexahedra along the axis" },
      },
      { "across", "around", "along" }, MakeCylinderWithHole },
    { "boundary-layer", "a box of unit width, with ever thinner cells towards z = 0",
      {
        { "ratio", 1e6, 2, 1e12, "longest edge over shortest edge" },
        { "cells", 32, 1, 2000, "hexahedra along x and y" },
        { "layers", 48, 2, 5000, "layers of hexahedra along z" },
      },
      { "cells", "layers" }, MakeBoundaryLayer },
    { "gear", "a spur gear of outer radius 1, on z = 0",
      {
        { "teeth", 64, 3, 2000, "number of teeth" },
        { "bore", 0.4, 0.05, 0.9, "radius of the bore" },
        { "thickness", 0.3, 1e-3, 100, "thickness along z" },
        { "around", 8, 8, 64, "hexahedra around a tooth" },
        { "across", 10, 1, 1000, "hexahedra from the bore to the rim" },
        { "along", 10, 1, 1000, "hexahedra along z" },
      },
      { "teeth", "around", "across", "along" }, MakeGear },
    { "helical-gear", "a gear whose teeth run slantwise, of outer radius 1, on z = 0",
      {
        { "teeth", 64, 3, 2000, "number of teeth" },
        { "twist", 15, -30, 30, "turn between the lower and the upper side, in degrees" },
        { "bore", 0.4, 0.05, 0.9, "radius of the bore" },
        { "thickness", 0.3, 1e-3, 100, "thickness along z" },
        { "around", 8, 8, 64, "hexahedra around a tooth" },
        { "across", 10, 1, 1000, "hexahedra from the bore to the rim" },
        { "along", 24, 8, 1000, "hexahedra along z" },
      },
      { "teeth", "around", "across", "along" }, MakeHelicalGear },
    { "heat-sink", "a base plate of unit thickness with fins, which are as wide as their gaps",
      {
        { "fins", 9, 1, 500, "number of fins" },
        { "length", 12, 0.1, 1000, "length along y, in widths of a fin" },
        { "height", 6, 0.1, 1000, "height of the fins, in widths of a fin" },
        { "cells", 3, 1, 200, "hexahedra across a fin" },
      },
      { "fins", "cells" }, MakeHeatSink },
    { "schoenhardt", "a box with a notch that no tetrahedra can fill without points of their own",
      {
        { "twist", 30, 5, 50, "turn between the notch's bottom and top, in degrees" },
        { "cells", 8, 1, 150, "parts of each edge of the coarsest mesh" },
      },
      { "cells" }, MakeSchoenhardt },
    { "cubes", "unit cubes apart from each other",
      {
        { "count", 3, 1, 100, "cubes along each axis" },
        { "gap", 0.5, 1e-6, 1000, "gap between cubes" },
        { "cells", 6, 1, 500, "hexahedra along an edge of a cube" },
      },
      { "count", "cells" }, MakeCubes },
    { "cavity", "a unit cube with a closed cubic cavity",
      {
        { "cavity", 0.5, 0, 1, "edge of the cavity; rounded to whole hexahedra, at least one" },
        { "cells", 32, 3, 600, "hexahedra along an edge" },
      },
      { "cells" }, MakeCavity },
    { "shared-edge", "two unit cubes that share one edge and nothing else",
      {
        { "cells", 16, 1, 350, "hexahedra along an edge of a cube" },
      },
      { "cells" }, MakeSharedEdge },
    { "checkerboard", "a unit cube of solid and void blocks in turns",
      {
        { "blocks", 4, 1, 200, "blocks along an edge" },
        { "cells", 6, 1, 300, "hexahedra along an edge of a block" },
      },
      { "blocks", "cells" }, MakeCheckerboard },
    { "cycle", "bars in a circle, each above the next: seen along z, none is the farthest",
      {
        { "bars", 3, 3, 12, "number of bars" },
        { "cells", 6, 1, 100, "hexahedra through the thickness of a bar" },
      },
      { "bars", "cells" }, MakeCycle },
    { "random", "a unit cube with randomly moved points, and without some of its tetrahedra",
      {
        { "cells", 24, 1, 450, "hexahedra along an edge" },
        { "jitter", 1, 0, 1, "motion of the points, 1: as far as cells of the right sign allow" },
        { "removed", 0.1, 0, 1, "part of the tetrahedra that is missing" },
        { "seed", 1, 0, 2147483647, "start of the random numbers" },
      },
      { "cells", "seed" }, MakeRandom },
  };
  return recipes;
}

template <class Items, class GetName>
std::string ListNames(const Items& items, const GetName& getName)
{
  std::string list;
  for (const auto& item : items)
  {
    list += (list.empty() ? "" : ", ") + std::string(getName(item));
  }
  return list;
}

const Recipe& FindRecipe(const std::string& name)
{
  const std::vector<Recipe>& recipes = GetRecipes();
  const auto found = std::find_if(
    recipes.begin(), recipes.end(), [&name](const Recipe& recipe) { return recipe.Name == name; });
  if (found == recipes.end())
  {
    throw std::invalid_argument("unknown mesh '" + name + "': there are " +
      ListNames(recipes, [](const Recipe& recipe) { return recipe.Name; }));
  }
  return *found;
}

void CheckValue(const Recipe& recipe, const GeneratorParameter& parameter, double value)
{
  const bool isWhole =
    std::count(recipe.WholeNumbers.begin(), recipe.WholeNumbers.end(), parameter.Name) != 0;
  if (!(value >= parameter.Minimum && value <= parameter.Maximum) ||
    (isWhole && value != std::floor(value)))
  {
    std::ostringstream message;
    message.precision(10);
    message << "mesh '" << recipe.Name << "': " << parameter.Name << " is " << value
            << ", but must be a " << (isWhole ? "whole " : "") << "number from "
            << parameter.Minimum << " to " << parameter.Maximum;
    throw std::invalid_argument(message.str());
  }
}

} // namespace

//----------------------------------------------------------------------------
const std::vector<Generator>& GetGenerators()
{
  static const std::vector<Generator> generators = []
  {
    std::vector<Generator> list;
    for (const Recipe& recipe : GetRecipes())
    {
      list.push_back({ recipe.Name, recipe.Description, recipe.Parameters });
    }
    return list;
  }();
  return generators;
}

//----------------------------------------------------------------------------
GeneratedMesh GenerateMesh(const std::string& name, const std::map<std::string, double>& parameters)
{
  const Recipe& recipe = FindRecipe(name);
  std::map<std::string, double> values;
  for (const GeneratorParameter& parameter : recipe.Parameters)
  {
    values[parameter.Name] = parameter.Default;
  }
  for (const auto& [parameter, value] : parameters)
  {
    if (values.count(parameter) == 0)
    {
      throw std::invalid_argument("mesh '" + name + "' has no parameter '" + parameter +
        "': it has " +
        ListNames(recipe.Parameters, [](const GeneratorParameter& p) { return p.Name; }));
    }
    values[parameter] = value;
  }
  for (const GeneratorParameter& parameter : recipe.Parameters)
  {
    CheckValue(recipe, parameter, values[parameter.Name]);
  }

  GeneratedMesh result;
  recipe.Make(Values(values), result);
  return result;
}

} // namespace tetralux
