// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/BoundarySurface.h"

#include "Convexify/FaceTable.h"
#include "Geometry/TetrahedronFaces.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace tetralux
{
namespace
{

/// For each point of the boundary the smallest id of the points at the same place.
std::vector<std::int32_t> MergeCoincidentPoints(
  const TetrahedralMesh& mesh, const std::vector<std::int32_t>& ids)
{
  std::vector<std::int32_t> sorted = ids;
  const auto at = [&](std::int32_t id) { return &mesh.Points[3 * static_cast<std::size_t>(id)]; };
  std::sort(sorted.begin(), sorted.end(),
    [&](std::int32_t i, std::int32_t j)
    {
      const double* p = at(i);
      const double* q = at(j);
      return std::tuple(p[0], p[1], p[2], i) < std::tuple(q[0], q[1], q[2], j);
    });
  std::vector<std::int32_t> first(mesh.GetNumberOfPoints(), -1);
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    const bool isSame = i > 0 && std::equal(at(sorted[i]), at(sorted[i]) + 3, at(sorted[i - 1]));
    first[sorted[i]] = isSame ? first[sorted[i - 1]] : sorted[i];
  }
  return first;
}

/// Six times the volume of a cell.
double GetVolume(const TetrahedralMesh& mesh, std::int64_t cell)
{
  const double* p[4];
  for (int i = 0; i < 4; ++i)
  {
    p[i] = &mesh.Points[3 * static_cast<std::size_t>(mesh.Cells[4 * cell + i])];
  }
  double e[3][3];
  for (int i = 0; i < 3; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      e[i][a] = p[i + 1][a] - p[0][a];
    }
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
    e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// The points of a face, turned as in OutwardFaces or the other way round.
Triangle GetFace(const TetrahedralMesh& mesh, std::int64_t cell, int face, bool isFlipped)
{
  const int* corners = OutwardFaces[face];
  const std::int32_t* points = &mesh.Cells[4 * cell];
  Triangle triangle = { points[corners[0]], points[corners[1]], points[corners[2]] };
  if (isFlipped)
  {
    std::swap(triangle[1], triangle[2]);
  }
  return triangle;
}

/// Whether two triangles of the same points run around in the same direction.
bool RunAlike(const Triangle& triangle0, const Triangle& triangle1)
{
  const auto start = std::find(triangle1.begin(), triangle1.end(), triangle0[0]);
  return triangle1[(start - triangle1.begin() + 1) % 3] == triangle0[1];
}

void SetPoint(Obstacle& obstacle, const TetrahedralMesh& mesh, std::int64_t cell)
{
  for (int a = 0; a < 3; ++a)
  {
    obstacle.Point[a] = 0;
    for (int i = 0; i < 4; ++i)
    {
      obstacle.Point[a] +=
        0.25 * mesh.Points[3 * static_cast<std::size_t>(mesh.Cells[4 * cell + i]) + a];
    }
  }
}

/// For each cell whether its order of points is turned against the orientation of its part.
std::vector<std::uint8_t> OrientCells(const TetrahedralMesh& mesh, const FaceNeighbors& neighbors,
  bool& hasInverted, Obstacle& obstacle)
{
  enum : std::uint8_t
  {
    Kept,
    Flipped,
    Unknown
  };
  const auto numberOfCells = static_cast<std::int64_t>(mesh.GetNumberOfCells());
  std::vector<std::uint8_t> turns(numberOfCells, Unknown);
  std::vector<std::int32_t> part;
  for (std::int64_t seed = 0; seed < numberOfCells; ++seed)
  {
    if (turns[seed] != Unknown)
    {
      continue;
    }
    part.assign(1, static_cast<std::int32_t>(seed));
    turns[seed] = Kept;
    double volume = 0;
    bool hasPositive = false;
    bool hasNegative = false;
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      const std::int64_t cell = part[i];
      const double cellVolume = (turns[cell] == Kept ? 1 : -1) * GetVolume(mesh, cell);
      hasPositive = hasPositive || cellVolume > 0;
      hasNegative = hasNegative || cellVolume < 0;
      volume += cellVolume;
      for (int face = 0; face < 4; ++face)
      {
        const std::int32_t neighbor = neighbors.Neighbors[4 * cell + face];
        if (neighbor < 0)
        {
          continue;
        }
        // Oriented alike, the two see their face in opposite directions.
        const bool isAlike = !RunAlike(GetFace(mesh, cell, face, turns[cell] != Kept),
          GetFace(mesh, neighbor, neighbors.NeighborFaces[4 * cell + face], false));
        const std::uint8_t turn = isAlike ? Kept : Flipped;
        if (turns[neighbor] == Unknown)
        {
          turns[neighbor] = turn;
          part.push_back(neighbor);
        }
        else if (turns[neighbor] != turn && obstacle.Reason.empty())
        {
          obstacle.Reason = "cells that share faces can't be oriented alike";
          obstacle.Cells = { static_cast<std::int32_t>(cell), neighbor };
          SetPoint(obstacle, mesh, cell);
        }
      }
    }
    hasInverted = hasInverted || (hasPositive && hasNegative);
    if (volume < 0)
    {
      for (const std::int32_t cell : part)
      {
        turns[cell] ^= 1;
      }
    }
  }
  return turns;
}

/// Refuses boundary triangles that, by points at the same place, are also between two cells.
void RefuseCoveredFaces(const TetrahedralMesh& mesh, const FaceNeighbors& neighbors,
  const std::vector<std::int32_t>& first, const std::vector<Triangle>& triangles,
  const std::vector<bool>& isKept, Obstacle& obstacle)
{
  FaceTable table(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    if (isKept[i])
    {
      const auto [a, b, c] = triangles[i];
      table.Set(a, b, c, static_cast<std::int32_t>(i));
    }
  }
  const auto numberOfFaces = static_cast<std::int64_t>(neighbors.Neighbors.size());
  for (std::int64_t face = 0; face < numberOfFaces && obstacle.Reason.empty(); ++face)
  {
    if (neighbors.Neighbors[face] < 0 || IsCollapsed(mesh, first, face / 4) ||
      IsCollapsed(mesh, first, neighbors.Neighbors[face]))
    {
      continue;
    }
    const Triangle triangle = GetFace(mesh, face / 4, static_cast<int>(face % 4), false);
    const std::int32_t a = first[triangle[0]], b = first[triangle[1]], c = first[triangle[2]];
    const std::int32_t covered = a < 0 || b < 0 || c < 0 ? FaceTable::None : table.Find(a, b, c);
    if (covered != FaceTable::None)
    {
      obstacle.Reason = "three cells share a face";
      obstacle.Cells = { neighbors.BoundaryFaces[covered] / 4,
        static_cast<std::int32_t>(face / 4) };
      SetPoint(obstacle, mesh, face / 4);
    }
  }
}

} // namespace

//----------------------------------------------------------------------------
bool IsCollapsed(
  const TetrahedralMesh& mesh, const std::vector<std::int32_t>& mergedIds, std::int64_t cell)
{
  std::array<std::int32_t, 4> ids;
  std::transform(&mesh.Cells[4 * cell], &mesh.Cells[4 * cell] + 4, ids.begin(),
    [&mergedIds](std::int32_t id) { return mergedIds[id]; });
  std::sort(ids.begin(), ids.end());
  const auto known = std::find_if(ids.begin(), ids.end(), [](std::int32_t id) { return id >= 0; });
  return std::adjacent_find(known, ids.end()) != ids.end();
}

//----------------------------------------------------------------------------
BoundarySurface FindBoundarySurface(
  const TetrahedralMesh& mesh, const FaceNeighbors& neighbors, Obstacle& obstacle)
{
  BoundarySurface surface;
  const std::vector<std::uint8_t> turns =
    OrientCells(mesh, neighbors, surface.HasInvertedCells, obstacle);
  if (!obstacle.Reason.empty())
  {
    return {};
  }

  std::vector<std::int32_t> ids;
  std::vector<Triangle> triangles;
  triangles.reserve(neighbors.BoundaryFaces.size());
  for (const std::int32_t face : neighbors.BoundaryFaces)
  {
    triangles.push_back(GetFace(mesh, face / 4, face % 4, turns[face / 4] != 0));
    ids.insert(ids.end(), triangles.back().begin(), triangles.back().end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  surface.MergedIds = MergeCoincidentPoints(mesh, ids);
  const std::vector<std::int32_t>& first = surface.MergedIds;
  for (Triangle& triangle : triangles)
  {
    for (std::int32_t& id : triangle)
    {
      id = first[id];
    }
  }

  // Faces at the same place are next to each other: what one side has more than the other stays.
  std::vector<std::int32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<Triangle> keys = triangles;
  for (Triangle& key : keys)
  {
    std::sort(key.begin(), key.end());
  }
  std::sort(order.begin(), order.end(),
    [&](std::int32_t i, std::int32_t j) { return std::tie(keys[i], i) < std::tie(keys[j], j); });
  std::vector<bool> isKept(triangles.size(), true);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end)
  {
    const Triangle& key = keys[order[begin]];
    for (end = begin; end < order.size() && keys[order[end]] == key; ++end)
    {
      const bool isCollapsed = key[0] == key[1] || key[1] == key[2];
      isKept[order[end]] = !isCollapsed;
    }
    if (end - begin > 2 && isKept[order[begin]] && obstacle.Reason.empty() &&
      std::count_if(order.begin() + static_cast<std::ptrdiff_t>(begin),
        order.begin() + static_cast<std::ptrdiff_t>(end),
        [&](std::int32_t i)
        { return !IsCollapsed(mesh, first, neighbors.BoundaryFaces[i] / 4); }) > 2)
    {
      obstacle.Reason = "three cells share a face";
      obstacle.Cells = { neighbors.BoundaryFaces[order[begin]] / 4,
        neighbors.BoundaryFaces[order[begin + 1]] / 4 };
      std::copy_n(&mesh.Points[3 * static_cast<std::size_t>(key[0])], 3, obstacle.Point.begin());
    }
    for (std::size_t i = begin; i < end; ++i)
    {
      for (std::size_t j = i + 1; j < end && isKept[order[i]]; ++j)
      {
        if (isKept[order[j]] && !RunAlike(triangles[order[i]], triangles[order[j]]))
        {
          isKept[order[i]] = isKept[order[j]] = false;
          const std::int32_t faces[2] = { neighbors.BoundaryFaces[order[i]],
            neighbors.BoundaryFaces[order[j]] };
          if (faces[0] / 4 != faces[1] / 4 && surface.Contact.Reason.empty())
          {
            surface.Contact.Reason = TouchingCellsReason;
            surface.Contact.Cells = { faces[0] / 4, faces[1] / 4 };
            std::copy_n(
              &mesh.Points[3 * static_cast<std::size_t>(key[0])], 3, surface.Contact.Point.begin());
          }
        }
      }
    }
  }

  if (std::any_of(ids.begin(), ids.end(), [&](std::int32_t id) { return first[id] != id; }))
  {
    RefuseCoveredFaces(mesh, neighbors, first, triangles, isKept, obstacle);
  }

  // Points that no kept triangle has are left out: they are inside the mesh.
  constexpr std::int32_t unused = -1;
  constexpr std::int32_t used = -2;
  std::vector<std::int32_t> local(mesh.GetNumberOfPoints(), unused);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (const std::int32_t id : triangles[i])
    {
      local[id] = isKept[i] ? used : local[id];
    }
  }
  for (const std::int32_t id : ids)
  {
    if (local[id] == used)
    {
      local[id] = surface.GetNumberOfPoints();
      surface.PointIds.push_back(id);
      const double* point = &mesh.Points[3 * static_cast<std::size_t>(id)];
      surface.Coordinates.insert(surface.Coordinates.end(), point, point + 3);
    }
  }
  const ExactPoints points(surface.Coordinates.data());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    if (!isKept[i])
    {
      continue;
    }
    const auto [a, b, c] = triangles[i];
    surface.Triangles.push_back({ local[a], local[b], local[c] });
    const std::int32_t face = neighbors.BoundaryFaces[i];
    surface.Faces.push_back(face);
    if (GetFace(mesh, face / 4, face % 4, turns[face / 4] != 0) != triangles[i])
    {
      surface.Seams.push_back(static_cast<std::int32_t>(surface.Triangles.size() - 1));
    }
    if (obstacle.Reason.empty() && points.FindProjection(local[a], local[b], local[c]) < 0)
    {
      obstacle.Reason = "a boundary face has no area";
      obstacle.Cells = { neighbors.BoundaryFaces[i] / 4, -1 };
      std::copy_n(
        &surface.Coordinates[3 * static_cast<std::size_t>(local[a])], 3, obstacle.Point.begin());
    }
  }
  return surface;
}

//----------------------------------------------------------------------------
double MeasureEnclosedVolume(
  const std::vector<double>& coordinates, const std::vector<Triangle>& triangles)
{
  if (triangles.empty())
  {
    return 0;
  }
  // From a point of the surface, so that an offset of the whole does not cancel.
  const double* origin = &coordinates[3 * static_cast<std::size_t>(triangles[0][0])];
  double sum = 0;
  double rest = 0; // Kahan: what the sum could not take
  for (const Triangle& triangle : triangles)
  {
    double p[3][3];
    for (int i = 0; i < 3; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        p[i][a] = coordinates[3 * static_cast<std::size_t>(triangle[i]) + a] - origin[a];
      }
    }
    const double volume = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
      p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
      p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    const double term = volume - rest;
    const double next = sum + term;
    rest = (next - sum) - term;
    sum = next;
  }
  return sum / 6;
}

} // namespace tetralux
