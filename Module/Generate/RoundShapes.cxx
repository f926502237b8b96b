// SPDX-License-Identifier: BSD-3-Clause
#include "Generate/GeneratedShape.h"

#include "Generate/LatticeMesh.h"
#include "Mesh/CellSplit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tetralux
{
namespace
{

using Point = std::array<double, 3>;

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

/// A ball around the origin; cells: hexahedra across it.
void AddBall(double radius, int cells, GeneratedMesh& result)
{
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

} // namespace

//----------------------------------------------------------------------------
void MakeRing(const Values& values, GeneratedMesh& result)
{
  const int around = values.GetCount("around");
  const int across = values.GetCount("across");
  const double waves = values.Get("waves");
  const double turns = values.Get("turns");
  const double time = values.Get("time");
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
    // The square of lattice points of a cross section becomes round, but keeps enough of its
    // corners for cells of good shape.
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
        const double phase = (2 * Pi * (strand + time) + turns * angle) / strands;
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
  AddBall(values.Get("radius"), values.GetCount("cells"), result);
}

//----------------------------------------------------------------------------
void MakeSwingingBall(const Values& values, GeneratedMesh& result)
{
  AddBall(1, values.GetCount("cells"), result);
  const double swing = std::sin(2 * Pi * values.Get("time"));
  constexpr double Stretch = 0.2;
  constexpr double Twist = 0.4; // radians a unit of z
  const double width = 1 + Stretch * swing;
  const double height = 1 / Square(width); // the volume stays
  std::vector<double>& points = result.Mesh.Points;
  const auto size = static_cast<std::int64_t>(points.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t p = 0; p < size; p += 3)
  {
    const double angle = Twist * swing * points[p + 2];
    const double x = width * points[p];
    const double y = width * points[p + 1];
    points[p] = x * std::cos(angle) - y * std::sin(angle);
    points[p + 1] = x * std::sin(angle) + y * std::cos(angle);
    points[p + 2] *= height;
  }
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
void MakeGear(const Values& values, GeneratedMesh& result) { AddGear(values, 0, result); }

//----------------------------------------------------------------------------
void MakeHelicalGear(const Values& values, GeneratedMesh& result)
{
  AddGear(values, values.Get("twist") * Pi / 180, result);
}

} // namespace tetralux
