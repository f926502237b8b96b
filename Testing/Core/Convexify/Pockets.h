// SPDX-License-Identifier: BSD-3-Clause
#ifndef Pockets_h
#define Pockets_h

#include "Convexify/BoundarySurface.h"
#include "Convexify/PocketSearch.h"
#include "Generate/GeneratedMeshes.h"
#include "Geometry/TetrahedronFaces.h"
#include "Mesh/MeshCleaning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// Surfaces and pockets whose properties are known, for tests of convexification step by step.
namespace pockets
{

using tetralux::Cell;
using tetralux::Front;
using tetralux::Triangle;

/// The largest relative error of a volume: up to ten thousand terms, each rounded by 1e-16.
constexpr double VolumeRounding = 1e-12;

/// A front and its points. The pocket is on the positive side of each triangle.
struct Pocket
{
  std::vector<double> Coordinates;
  tetralux::Front Triangles;

  tetralux::ExactPoints GetPoints() const
  {
    return tetralux::ExactPoints(this->Coordinates.data());
  }
  /// The volume of the pocket: a surface's own volume is on its negative side.
  double GetVolume() const
  {
    return -tetralux::MeasureEnclosedVolume(this->Coordinates, this->Triangles);
  }
};

inline double MeasureCell(const std::vector<double>& coordinates, const Cell& cell)
{
  Front faces;
  for (const auto& face : tetralux::OutwardFaces)
  {
    faces.push_back({ cell[face[0]], cell[face[1]], cell[face[2]] });
  }
  return tetralux::MeasureEnclosedVolume(coordinates, faces);
}

/// The volume of cells, each of which must be positive.
inline double MeasureCells(const std::vector<double>& coordinates, const std::vector<Cell>& cells)
{
  const tetralux::ExactPoints points(coordinates.data());
  double volume = 0;
  for (const Cell& cell : cells)
  {
    EXPECT_GT(points.Orient(cell[0], cell[1], cell[2], cell[3]), 0);
    volume += MeasureCell(coordinates, cell);
  }
  return volume;
}

/// Whether each edge is passed equally often in its two directions.
inline bool IsClosed(const Front& triangles)
{
  std::map<std::pair<std::int32_t, std::int32_t>, int> balance;
  for (const Triangle& triangle : triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t from = triangle[i];
      const std::int32_t to = triangle[(i + 1) % 3];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return std::all_of(
    balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

/// Whether the faces of cells cancel but for those of a front, so that they fill its pocket.
inline bool Fill(const Front& front, const std::vector<Cell>& cells)
{
  std::multiset<Triangle> open;
  const auto turn = [](Triangle triangle)
  {
    std::rotate(
      triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    return triangle;
  };
  for (const Triangle& triangle : front)
  {
    open.insert(turn({ triangle[0], triangle[2], triangle[1] }));
  }
  for (const Cell& cell : cells)
  {
    for (const auto& face : tetralux::OutwardFaces)
    {
      // An outward face is that of the front from its other side, or meets another cell's.
      const Triangle same = turn({ cell[face[0]], cell[face[1]], cell[face[2]] });
      const Triangle opposite = turn({ cell[face[0]], cell[face[2]], cell[face[1]] });
      const auto found = open.find(same);
      if (found != open.end())
      {
        open.erase(found);
      }
      else
      {
        open.insert(opposite);
      }
    }
  }
  return open.empty();
}

inline Front Reverse(Front front)
{
  for (Triangle& triangle : front)
  {
    std::swap(triangle[1], triangle[2]);
  }
  return front;
}

/// A regular octahedron: convex, of volume 4 / 3.
inline Pocket MakeOctahedron()
{
  return { { 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1 },
    { { 0, 4, 2 }, { 2, 4, 1 }, { 1, 4, 3 }, { 3, 4, 0 }, { 2, 5, 0 }, { 1, 5, 2 }, { 3, 5, 1 },
      { 0, 5, 3 } } };
}

/// Schoenhardt's polyhedron, a prism whose top is turned by 30 degrees and whose sides are bent
/// inwards: no cells over its six points fill it, but its middle sees all of its triangles.
inline Pocket MakeSchoenhardt()
{
  Pocket pocket;
  const double degree = std::acos(-1.) / 180;
  for (int level = 0; level < 2; ++level)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double angle = (120 * i + 30 * level) * degree;
      const double point[3] = { std::cos(angle), std::sin(angle), 2. * level - 1 };
      pocket.Coordinates.insert(pocket.Coordinates.end(), point, point + 3);
    }
  }
  pocket.Triangles = { { 0, 1, 2 }, { 3, 5, 4 } };
  for (int i = 0; i < 3; ++i)
  {
    const int next = (i + 1) % 3;
    // The longer diagonal, from the bottom to the top's next corner.
    pocket.Triangles.push_back({ i, 3 + next, next });
    pocket.Triangles.push_back({ i, 3 + i, 3 + next });
  }
  return pocket;
}

/// Boundary faces of a mesh as one surface; the mesh must be without obstacles.
inline tetralux::BoundarySurface MakeSurface(const tetralux::TetrahedralMesh& mesh)
{
  tetralux::Obstacle obstacle;
  tetralux::BoundarySurface surface = tetralux::FindBoundarySurface(
    mesh, tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints()), obstacle);
  EXPECT_EQ(obstacle.Reason, "");
  return surface;
}

/// Meshes of all kinds of empty space, small ones.
inline std::vector<std::pair<std::string, tetralux::TetrahedralMesh>> GenerateMeshes()
{
  const std::pair<const char*, std::map<std::string, double>> recipes[] = {
    { "ball", { { "cells", 6 } } },
    { "ring", { { "around", 16 }, { "across", 2 } } },
    { "cylinder-with-hole", { { "across", 1 }, { "around", 12 }, { "along", 3 } } },
    { "gear", { { "teeth", 5 }, { "across", 2 }, { "along", 2 } } },
    { "helical-gear", { { "teeth", 3 }, { "across", 2 }, { "along", 8 } } },
    { "heat-sink", { { "fins", 2 }, { "cells", 1 }, { "length", 2 }, { "height", 2 } } },
    { "schoenhardt", { { "cells", 1 } } },
    { "cubes", { { "count", 2 }, { "cells", 1 } } },
    { "cavity", { { "cells", 4 } } },
    { "shared-edge", { { "cells", 2 } } },
    { "checkerboard", { { "blocks", 2 }, { "cells", 2 } } },
    { "cycle", { { "cells", 1 } } },
    { "random", { { "cells", 3 }, { "removed", 0.3 } } },
  };
  std::vector<std::pair<std::string, tetralux::TetrahedralMesh>> meshes;
  for (const auto& [name, parameters] : recipes)
  {
    meshes.emplace_back(name, tetralux::GenerateMesh(name, parameters).Mesh);
    tetralux::RemoveUnusableCells(meshes.back().second);
  }
  return meshes;
}

} // namespace pockets

#endif
