// SPDX-License-Identifier: BSD-3-Clause
#include "Generate/GeneratedMeshes.h"

#include "Geometry/TetrahedronFaces.h"
#include "Mesh/CellVolumes.h"
#include "Mesh/FaceNeighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using tetralux::FaceNeighbors;
using tetralux::GeneratedMesh;
using tetralux::GenerateMesh;
using tetralux::TetrahedralMesh;
using Parameters = std::map<std::string, double>;
using Point = std::array<double, 3>;

const double Pi = std::acos(-1.0);

Point GetPoint(const TetrahedralMesh& mesh, std::int64_t id)
{
  return { mesh.Points[3 * id], mesh.Points[3 * id + 1], mesh.Points[3 * id + 2] };
}

double GetDeterminant(const Point& a, const Point& b, const Point& c)
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Face of a positively oriented tetrahedron, counterclockwise from outside.
std::array<std::int32_t, 3> GetFace(const TetrahedralMesh& mesh, std::int64_t face)
{
  const std::int32_t* cell = &mesh.Cells[face / 4 * 4];
  const int(&local)[3] = tetralux::OutwardFaces[face % 4];
  return { cell[local[0]], cell[local[1]], cell[local[2]] };
}

/// What a mesh is known to have.
struct Expectation
{
  std::string Name;
  Parameters Values;
  std::int64_t NumberOfComponents;
  /// Points minus edges plus faces of the boundary; AnyEuler where it meets itself.
  std::int64_t Euler;
  double Volume; ///< negative: unknown
};

constexpr std::int64_t AnyEuler = std::numeric_limits<std::int64_t>::min();
constexpr double AnyVolume = -1;

double GetPipeVolume(double radius, double hole, double height, int around)
{
  return 0.5 * around * std::sin(2 * Pi / around) * (1 - hole * hole) * radius * radius * height;
}

/// See SchoenhardtNotch.h.
double GetSchoenhardtVolume(double degrees)
{
  Point bottom[3];
  Point top[3];
  for (int i = 0; i < 3; ++i)
  {
    const double angle = 2 * Pi / 3 * i;
    const double twist = degrees * Pi / 180;
    bottom[i] = { 0.6 * std::cos(angle), 0.6 * std::sin(angle), 0 };
    top[i] = { 0.6 * std::cos(angle + twist), 0.6 * std::sin(angle + twist), 1 };
  }
  // The bottom is in the plane of the origin.
  double sixfold = GetDeterminant(top[0], top[1], top[2]);
  for (int i = 0; i < 3; ++i)
  {
    const int next = (i + 1) % 3;
    sixfold += GetDeterminant(bottom[i], bottom[next], top[next]);
    sixfold += GetDeterminant(bottom[i], top[next], top[i]);
  }
  return sixfold / 6;
}

double GetBoundaryLayerVolume(double ratio, int cells, int layers)
{
  const double thinnest = std::sqrt(2.0) / cells / ratio;
  const double growth = std::pow(1.0 / cells / thinnest, 1.0 / (layers - 1));
  return thinnest * (std::pow(growth, layers) - 1) / (growth - 1);
}

std::vector<Expectation> GetExpectations()
{
  return {
    { "ring", {}, 1, 0, AnyVolume },
    { "ring", { { "around", 31 }, { "across", 5 } }, 1, 0, AnyVolume },
    { "ball", {}, 1, 2, AnyVolume },
    { "ball", { { "cells", 3 } }, 1, 2, AnyVolume },
    { "ball", { { "cells", 17 }, { "radius", 1e-20 } }, 1, 2, AnyVolume },
    { "swinging-ball", { { "time", 0.25 } }, 1, 2, AnyVolume },
    { "swinging-ball", { { "cells", 6 }, { "time", 0.75 } }, 1, 2, AnyVolume },
    { "cylinder-with-hole", {}, 1, 0, GetPipeVolume(1, 0.5, 2, 96) },
    { "cylinder-with-hole",
      { { "radius", 5 }, { "hole", 0.9 }, { "height", 3 }, { "around", 7 }, { "across", 1 } }, 1, 0,
      GetPipeVolume(5, 0.9, 3, 7) },
    { "boundary-layer", {}, 1, 2, GetBoundaryLayerVolume(1e6, 32, 48) },
    { "boundary-layer", { { "ratio", 1e12 }, { "cells", 4 }, { "layers", 60 } }, 1, 2,
      GetBoundaryLayerVolume(1e12, 4, 60) },
    { "gear", {}, 1, 0, AnyVolume },
    { "gear", { { "teeth", 3 }, { "around", 9 }, { "bore", 0.05 } }, 1, 0, AnyVolume },
    { "gear", { { "teeth", 200 }, { "bore", 0.9 } }, 1, 0, AnyVolume },
    { "helical-gear", {}, 1, 0, AnyVolume },
    { "helical-gear", { { "twist", -30 }, { "along", 8 }, { "teeth", 17 } }, 1, 0, AnyVolume },
    { "heat-sink", {}, 1, 2, 12 * (17 + 9 * 6) },
    { "heat-sink", { { "fins", 1 }, { "cells", 2 }, { "length", 1 }, { "height", 3 } }, 1, 2, 4 },
    { "schoenhardt", {}, 1, 2, 6 - GetSchoenhardtVolume(30) },
    { "schoenhardt", { { "cells", 1 } }, 1, 2, 6 - GetSchoenhardtVolume(30) },
    { "schoenhardt", { { "twist", 5 }, { "cells", 3 } }, 1, 2, 6 - GetSchoenhardtVolume(5) },
    { "schoenhardt", { { "twist", 45 }, { "cells", 3 } }, 1, 2, 6 - GetSchoenhardtVolume(45) },
    { "schoenhardt", { { "twist", 50 }, { "cells", 3 } }, 1, 2, 6 - GetSchoenhardtVolume(50) },
    { "cubes", {}, 27, 2 * 27, 27 },
    { "cavity", {}, 1, 4, 1 - 0.125 },
    { "cavity", { { "cells", 3 }, { "cavity", 0 } }, 1, 4, 1 - 1.0 / 27 },
    { "shared-edge", {}, 2, AnyEuler, 2 },
    { "shared-edge", { { "cells", 1 } }, 2, AnyEuler, 2 },
    { "checkerboard", {}, 32, AnyEuler, 0.5 },
    { "checkerboard", { { "blocks", 3 }, { "cells", 1 } }, 14, AnyEuler, 14.0 / 27 },
    { "cycle", {}, 3, 2 * 3, 3 * 2.6 * 0.2 * 0.1 },
    { "cycle", { { "bars", 12 }, { "cells", 1 } }, 12, 2 * 12, 12 * 2.6 * 0.2 * 0.1 },
    { "random", { { "removed", 0 } }, 1, 2, 1 },
  };
}

/// The edges of the boundary faces, ascending; an edge occurs once for each face that has it.
std::vector<std::pair<std::int32_t, std::int32_t>> GetBoundaryEdges(
  const TetrahedralMesh& mesh, const FaceNeighbors& neighbors)
{
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  for (const std::int32_t face : neighbors.BoundaryFaces)
  {
    const auto ids = GetFace(mesh, face);
    for (int i = 0; i < 3; ++i)
    {
      edges.push_back(std::minmax(ids[i], ids[(i + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// What holds for every mesh.
void CheckMesh(const GeneratedMesh& generated, const FaceNeighbors& neighbors)
{
  const TetrahedralMesh& mesh = generated.Mesh;
  const auto volumes = tetralux::MeasureCells(mesh);
  EXPECT_EQ(volumes.NumberOfZero, 0);
  EXPECT_EQ(volumes.NumberOfInverted, 0);
  EXPECT_EQ(neighbors.NumberOfNonManifoldFaces, 0);

  // Cells that share a face lie on different sides of it.
  std::int64_t sameSide = 0;
  for (std::size_t face = 0; face < mesh.Cells.size(); ++face)
  {
    if (neighbors.Neighbors[face] >= 0)
    {
      const auto mine = GetFace(mesh, static_cast<std::int64_t>(face));
      auto other = GetFace(
        mesh, std::int64_t{ 4 } * neighbors.Neighbors[face] + neighbors.NeighborFaces[face]);
      std::reverse(other.begin(), other.end());
      std::rotate(other.begin(), std::find(other.begin(), other.end(), mine[0]), other.end());
      sameSide += other != mine;
    }
  }
  EXPECT_EQ(sameSide, 0);

  // The boundary is closed, and encloses the volume of the cells. Relative to one of its points, so
  // that nothing cancels.
  double enclosed = 0;
  for (const std::int32_t face : neighbors.BoundaryFaces)
  {
    const auto ids = GetFace(mesh, face);
    Point corners[3];
    for (int i = 0; i < 3; ++i)
    {
      corners[i] = GetPoint(mesh, ids[i]);
    }
    enclosed += GetDeterminant(corners[0], corners[1], corners[2]) / 6;
  }
  const auto edges = GetBoundaryEdges(mesh, neighbors);
  std::int64_t oddEdges = 0;
  for (auto edge = edges.begin(); edge != edges.end();)
  {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    oddEdges += (next - edge) % 2;
    edge = next;
  }
  EXPECT_EQ(oddEdges, 0);
  EXPECT_NEAR(enclosed, volumes.Total, 1e-9 * volumes.Total);

  // A field of which there is something to see.
  ASSERT_EQ(generated.Scalars.size(), mesh.GetNumberOfPoints());
  EXPECT_TRUE(std::all_of(generated.Scalars.begin(), generated.Scalars.end(),
    [](double scalar) { return std::isfinite(scalar); }));
  const auto [minimum, maximum] =
    std::minmax_element(generated.Scalars.begin(), generated.Scalars.end());
  EXPECT_GT(*maximum - *minimum, 0.05);
}

std::int64_t GetEuler(const TetrahedralMesh& mesh, const FaceNeighbors& neighbors)
{
  std::vector<bool> isUsed(mesh.GetNumberOfPoints(), false);
  for (const std::int32_t face : neighbors.BoundaryFaces)
  {
    for (const std::int32_t point : GetFace(mesh, face))
    {
      isUsed[point] = true;
    }
  }
  auto edges = GetBoundaryEdges(mesh, neighbors);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return std::count(isUsed.begin(), isUsed.end(), true) - static_cast<std::int64_t>(edges.size()) +
    static_cast<std::int64_t>(neighbors.BoundaryFaces.size());
}

/// z where the vertical line through (x, y) enters and leaves the cells, brute force.
std::pair<double, double> GetHeights(
  const TetrahedralMesh& mesh, std::size_t beginCell, std::size_t endCell, double x, double y)
{
  std::pair<double, double> heights = { std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  for (std::size_t face = 4 * beginCell; face < 4 * endCell; ++face)
  {
    const auto ids = GetFace(mesh, static_cast<std::int64_t>(face));
    double areas[3];
    double z[3];
    for (int i = 0; i < 3; ++i)
    {
      const Point a = GetPoint(mesh, ids[(i + 1) % 3]);
      const Point b = GetPoint(mesh, ids[(i + 2) % 3]);
      areas[i] = (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
      z[i] = GetPoint(mesh, ids[i])[2];
    }
    if ((areas[0] > 0 && areas[1] > 0 && areas[2] > 0) ||
      (areas[0] < 0 && areas[1] < 0 && areas[2] < 0))
    {
      const double height =
        (areas[0] * z[0] + areas[1] * z[1] + areas[2] * z[2]) / (areas[0] + areas[1] + areas[2]);
      heights.first = std::min(heights.first, height);
      heights.second = std::max(heights.second, height);
    }
  }
  return heights;
}

std::string GetError(const std::string& name, const Parameters& parameters)
{
  try
  {
    GenerateMesh(name, parameters);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "none";
}

} // namespace

TEST(GeneratedMeshes, ExpectedShapes)
{
  std::set<std::string> untested;
  for (const auto& generator : tetralux::GetGenerators())
  {
    untested.insert(generator.Name);
  }
  for (const Expectation& expected : GetExpectations())
  {
    std::string text = expected.Name;
    for (const auto& [parameter, value] : expected.Values)
    {
      text += " " + parameter + "=" + std::to_string(value);
    }
    SCOPED_TRACE(text);
    untested.erase(expected.Name);

    const GeneratedMesh generated = GenerateMesh(expected.Name, expected.Values);
    const TetrahedralMesh& mesh = generated.Mesh;
    const FaceNeighbors neighbors =
      tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints());
    CheckMesh(generated, neighbors);
    EXPECT_EQ(neighbors.NumberOfComponents, expected.NumberOfComponents);
    if (expected.Euler != AnyEuler)
    {
      EXPECT_EQ(GetEuler(mesh, neighbors), expected.Euler);
    }
    if (expected.Volume != AnyVolume)
    {
      EXPECT_NEAR(tetralux::MeasureCells(mesh).Total, expected.Volume, 1e-9 * expected.Volume);
    }
    std::vector<bool> isUsed(mesh.GetNumberOfPoints(), false);
    for (const std::int32_t point : mesh.Cells)
    {
      isUsed.at(point) = true;
    }
    EXPECT_EQ(std::count(isUsed.begin(), isUsed.end(), false), 0);
  }
  EXPECT_TRUE(untested.empty()) << *untested.begin();
}

TEST(GeneratedMeshes, RingIsOfTheSizeOfADemonstration)
{
  const std::size_t size = GenerateMesh("ring").Mesh.GetNumberOfCells();
  EXPECT_GT(size, 200000u);
  EXPECT_LT(size, 500000u);
}

// Steps of time: the strands of the ring move through its points, those of the ball take its field
// along. Cells stay, and the period closes.
TEST(GeneratedMeshes, MoveByScalarsOrByPoints)
{
  for (const bool points : { false, true })
  {
    const std::string name = points ? "swinging-ball" : "ring";
    const auto make = [&](double time)
    {
      return GenerateMesh(name,
        points
          ? std::map<std::string, double>{ { "cells", 8 }, { "time", time } }
          : std::map<std::string, double>{ { "around", 20 }, { "across", 3 }, { "time", time } });
    };
    const auto first = make(0);
    const auto second = make(0.2);
    const auto last = make(1);
    EXPECT_EQ(first.Mesh.Cells, second.Mesh.Cells);
    EXPECT_EQ(first.Mesh.Points == second.Mesh.Points, !points);
    EXPECT_EQ(first.Scalars == second.Scalars, points);
    for (std::size_t i = 0; i < first.Scalars.size(); ++i)
    {
      EXPECT_NEAR(last.Scalars[i], first.Scalars[i], 1e-12);
    }
    for (std::size_t i = 0; i < first.Mesh.Points.size(); ++i)
    {
      EXPECT_NEAR(last.Mesh.Points[i], first.Mesh.Points[i], 1e-12);
    }
  }
}

TEST(GeneratedMeshes, BallIsRound)
{
  // The volume approaches the ball's from below, with the square of the cells' size.
  const double ball = 4 * Pi / 3 * 8;
  double previous = 0;
  for (const int cells : { 20, 40, 80 })
  {
    const GeneratedMesh generated =
      GenerateMesh("ball", { { "radius", 2 }, { "cells", static_cast<double>(cells) } });
    const double missing = ball - tetralux::MeasureCells(generated.Mesh).Total;
    EXPECT_GT(missing, 0);
    if (previous != 0)
    {
      EXPECT_NEAR(previous / missing, 4, 0.1);
    }
    previous = missing;
    for (std::size_t i = 0; i < generated.Mesh.GetNumberOfPoints(); ++i)
    {
      const Point point = GetPoint(generated.Mesh, static_cast<std::int64_t>(i));
      ASSERT_LE(std::hypot(point[0], point[1], point[2]), 2 * (1 + 1e-15));
    }
  }
  EXPECT_LT(previous, 0.01 * ball);
}

TEST(GeneratedMeshes, BoundaryLayerHasItsEdgeRatio)
{
  for (const double ratio : { 100.0, 1e6, 1e12 })
  {
    const auto volumes =
      tetralux::MeasureCells(GenerateMesh("boundary-layer", { { "ratio", ratio } }).Mesh);
    EXPECT_NEAR(volumes.LongestEdge / volumes.ShortestEdge, ratio, 1e-9 * ratio);
  }
}

TEST(GeneratedMeshes, EachBarOfTheCycleHidesTheNext)
{
  for (const int bars : { 3, 12 })
  {
    const TetrahedralMesh mesh =
      GenerateMesh("cycle", { { "bars", static_cast<double>(bars) }, { "cells", 1 } }).Mesh;
    const std::size_t perBar = mesh.GetNumberOfCells() / bars;
    double size = 0;
    for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
    {
      size = std::max({ size, std::abs(mesh.Points[i]), std::abs(mesh.Points[i + 1]) });
    }
    // how often bar i is above bar j
    std::vector<std::vector<int>> above(bars, std::vector<int>(bars, 0));
    constexpr int steps = 61;
    for (int line = 0; line < steps * steps; ++line)
    {
      const double x = size * (2.0 * (line % steps) / steps - 0.987);
      const double y = size * (2.0 * (line / steps) / steps - 0.993);
      std::vector<std::pair<double, double>> heights;
      for (int bar = 0; bar < bars; ++bar)
      {
        heights.push_back(GetHeights(mesh, bar * perBar, (bar + 1) * perBar, x, y));
      }
      for (int i = 0; i < bars; ++i)
      {
        for (int j = 0; j < i; ++j)
        {
          if (heights[i].first <= heights[i].second && heights[j].first <= heights[j].second)
          {
            above[i][j] += heights[i].first > heights[j].second;
            above[j][i] += heights[j].first > heights[i].second;
            // They do not cut into each other.
            ASSERT_TRUE(
              heights[i].first > heights[j].second || heights[j].first > heights[i].second);
          }
        }
      }
    }
    for (int bar = 0; bar < bars; ++bar)
    {
      const int next = (bar + 1) % bars;
      EXPECT_GT(above[bar][next], 0);
      EXPECT_EQ(above[next][bar], 0);
    }
  }
}

TEST(GeneratedMeshes, RandomMeshFollowsItsSeed)
{
  const Parameters parameters = { { "cells", 12 }, { "removed", 0.3 } };
  const GeneratedMesh first = GenerateMesh("random", parameters);
  const GeneratedMesh again = GenerateMesh("random", parameters);
  EXPECT_EQ(first.Mesh.Points, again.Mesh.Points);
  EXPECT_EQ(first.Mesh.Cells, again.Mesh.Cells);
  EXPECT_EQ(first.Scalars, again.Scalars);
  EXPECT_NEAR(static_cast<double>(first.Mesh.GetNumberOfCells()), 0.7 * 5 * 12 * 12 * 12, 200);

  Parameters other = parameters;
  other["seed"] = 2;
  EXPECT_NE(GenerateMesh("random", other).Mesh.Points, first.Mesh.Points);

  for (int seed = 0; seed < 10; ++seed)
  {
    other["seed"] = seed;
    const GeneratedMesh generated = GenerateMesh("random", other);
    CheckMesh(generated,
      tetralux::FindFaceNeighbors(generated.Mesh.Cells, generated.Mesh.GetNumberOfPoints()));
  }

  other["removed"] = 1;
  EXPECT_EQ(GenerateMesh("random", other).Mesh.GetNumberOfCells(), 0u);
}

TEST(GeneratedMeshes, EveryParameterIsDescribed)
{
  for (const auto& generator : tetralux::GetGenerators())
  {
    SCOPED_TRACE(generator.Name);
    EXPECT_FALSE(generator.Description.empty());
    for (const auto& parameter : generator.Parameters)
    {
      SCOPED_TRACE(parameter.Name);
      EXPECT_FALSE(parameter.Description.empty());
      EXPECT_LE(parameter.Minimum, parameter.Default);
      EXPECT_LE(parameter.Default, parameter.Maximum);
      EXPECT_NE(GetError(generator.Name,
                  { { parameter.Name, parameter.Minimum - std::abs(parameter.Maximum) } }),
        "none");
      EXPECT_NE(
        GetError(generator.Name, { { parameter.Name, 2 * parameter.Maximum + 1 } }), "none");
      EXPECT_NE(
        GetError(generator.Name, { { parameter.Name, std::numeric_limits<double>::quiet_NaN() } }),
        "none");
    }
  }
}

TEST(GeneratedMeshes, ErrorsSayWhatWouldBeRight)
{
  EXPECT_EQ(GetError("sphere", {}).substr(0, 46), "unknown mesh 'sphere': there are ring, ball, s");
  EXPECT_EQ(GetError("ball", { { "size", 3 } }),
    "mesh 'ball' has no parameter 'size': it has radius, cells");
  EXPECT_EQ(GetError("ball", { { "cells", 2 } }),
    "mesh 'ball': cells is 2, but must be a whole number from 3 to 600");
  EXPECT_EQ(GetError("ball", { { "cells", 4.5 } }),
    "mesh 'ball': cells is 4.5, but must be a whole number from 3 to 600");
  EXPECT_EQ(GetError("boundary-layer", { { "ratio", 1 } }),
    "mesh 'boundary-layer': ratio is 1, but must be a number from 2 to 1e+12");
  EXPECT_EQ(GetError("checkerboard", { { "blocks", 200 }, { "cells", 300 } }),
    "this asks for up to 1080000000000000 tetrahedra, but a mesh has at most 536870911: take fewer "
    "cells");
}
