// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/PocketFinder.h"

#include "Base/DisjointSets.h"
#include "Convexify/FaceTable.h"
#include "Convexify/HullTriangles.h"
#include "Geometry/SimplexIntersection.h"
#include "Geometry/TetrahedronFaces.h"

#include <algorithm>

#include <omp.h>

namespace tetralux
{
namespace
{

/// How the triangulation's cells lie to the missing triangles that meet them.
struct Meetings
{
  std::vector<std::int32_t> Pierced;    ///< cells
  std::vector<std::int32_t> Touched;    ///< improperly, but not inside
  std::vector<std::int32_t> InnerWalls; ///< 4 * cell + face in its plane, cell on the solid side
  std::vector<std::int32_t> OuterWalls; ///< the same, cell on the empty side
  std::vector<std::array<std::int32_t, 2>> Connected;  ///< cells that one triangle meets
  std::vector<std::array<std::int32_t, 2>> FirstCells; ///< triangle and a cell that it meets
};

/// Walks along missing triangles through the triangulation.
class TriangleWalk
{
public:
  TriangleWalk(const BoundarySurface& surface, const BoundaryTriangulation& triangulation)
    : Surface(surface)
    , Triangulation(triangulation)
    , Points(surface.Coordinates.data())
    , VisitedFor(triangulation.GetNumberOfCells(), -1)
    , SignedFor(surface.GetNumberOfPoints(), -1)
    , Signs(surface.GetNumberOfPoints(), 0)
  {
  }

  Meetings Result;

  void Walk(std::int32_t triangleId)
  {
    this->TriangleId = triangleId;
    const Triangle& triangle = this->Surface.Triangles[triangleId];
    std::int32_t firstCell = -1;
    this->Stack.assign(1, this->Triangulation.PointCells[triangle[0]]);
    this->VisitedFor[this->Stack[0]] = triangleId;
    while (!this->Stack.empty())
    {
      const std::int32_t cell = this->Stack.back();
      this->Stack.pop_back();
      if (this->Meet(cell, triangle))
      {
        if (firstCell < 0)
        {
          firstCell = cell;
          this->Result.FirstCells.push_back({ triangleId, cell });
        }
        this->Result.Connected.push_back({ firstCell, cell });
      }
      for (int i = 0; i < 4; ++i)
      {
        const std::int32_t neighbor =
          this->Triangulation.Neighbors[4 * static_cast<std::size_t>(cell) + i];
        if (this->VisitedFor[neighbor] != triangleId)
        {
          this->VisitedFor[neighbor] = triangleId;
          if (!this->Triangulation.IsInfinite(neighbor) && this->CanMeet(neighbor, triangle))
          {
            this->Stack.push_back(neighbor);
          }
        }
      }
    }
  }

private:
  void GetSigns(std::int32_t cell, const Triangle& triangle, int (&signs)[4])
  {
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t point = this->GetPoints(cell)[i];
      if (this->SignedFor[point] != this->TriangleId)
      {
        this->SignedFor[point] = this->TriangleId;
        this->Signs[point] = this->Points.Orient(triangle[0], triangle[1], triangle[2], point);
      }
      signs[i] = this->Signs[point];
    }
  }

  bool CanMeet(std::int32_t cell, const Triangle& triangle)
  {
    int signs[4];
    this->GetSigns(cell, triangle, signs);
    return CellCanMeetTriangle(this->Points, this->GetPoints(cell), triangle.data(), signs);
  }

  /// Notes how a cell and the triangle meet; returns whether improperly.
  bool Meet(std::int32_t cell, const Triangle& triangle)
  {
    const std::int32_t* corners = this->GetPoints(cell);
    int signs[4];
    this->GetSigns(cell, triangle, signs);
    // Most are on one side of the plane, but for the points that both have.
    bool isApart = true;
    int sides = 0;
    for (int i = 0; i < 4 && isApart; ++i)
    {
      isApart = signs[i] != 0
        ? sides == 0 || sides == signs[i]
        : std::find(triangle.begin(), triangle.end(), corners[i]) != triangle.end();
      sides = signs[i] != 0 ? signs[i] : sides;
    }
    if (isApart || CellMeetsTriangleProperly(this->Points, corners, triangle.data()))
    {
      return false;
    }
    if (TrianglePiercesCell(this->Points, corners, triangle.data()))
    {
      this->Result.Pierced.push_back(cell);
      return true;
    }
    this->Result.Touched.push_back(cell);
    for (int i = 0; i < 4; ++i)
    {
      const int* others = OutwardFaces[i];
      if (signs[i] != 0 && signs[others[0]] == 0 && signs[others[1]] == 0 && signs[others[2]] == 0)
      {
        const std::int32_t face[3] = { corners[others[0]], corners[others[1]], corners[others[2]] };
        const int axis = this->Points.FindProjection(triangle[0], triangle[1], triangle[2]);
        if (CoplanarTrianglesOverlap(this->Points, triangle.data(), face, axis))
        {
          (signs[i] > 0 ? this->Result.OuterWalls : this->Result.InnerWalls)
            .push_back(4 * cell + i);
        }
      }
    }
    return true;
  }

  const std::int32_t* GetPoints(std::int32_t cell) const
  {
    return &this->Triangulation.Cells[4 * static_cast<std::size_t>(cell)];
  }

  const BoundarySurface& Surface;
  const BoundaryTriangulation& Triangulation;
  ExactPoints Points;
  std::vector<std::int32_t> VisitedFor; ///< for each cell the last triangle that came there
  std::vector<std::int32_t> SignedFor;  ///< for each point the last triangle that it has a sign for
  std::vector<int> Signs;
  std::vector<std::int32_t> Stack;
  std::int32_t TriangleId = -1;
};

class PocketFinder
{
public:
  PocketFinder(const BoundarySurface& surface, const BoundaryTriangulation& triangulation)
    : Surface(surface)
    , Triangulation(triangulation)
    , Points(surface.Coordinates.data())
    , NumberOfCells(static_cast<std::int32_t>(triangulation.GetNumberOfCells()))
    , OuterCells(surface.Triangles.size(), NotPresent)
    , Walls(4 * static_cast<std::size_t>(NumberOfCells), false)
    , Labels(NumberOfCells, Unknown)
    , IsPierced(NumberOfCells, false)
    , IsTouched(NumberOfCells, false)
    , Sets(NumberOfCells)
    , MeetingCells(surface.Triangles.size(), -1)
  {
  }

  EmptySpace Find(Obstacle& obstacle)
  {
    FaceTable boundary(this->Surface.Triangles.size());
    for (std::size_t t = 0; t < this->Surface.Triangles.size(); ++t)
    {
      const auto [a, b, c] = this->Surface.Triangles[t];
      boundary.Set(a, b, c, static_cast<std::int32_t>(t));
    }
    this->FindPresentTriangles(boundary);
    EmptySpace result;
    result.MissingFaces = std::count(this->OuterCells.begin(), this->OuterCells.end(), NotPresent);
    this->WalkMissingTriangles();

    HullTriangles hull = TriangulateHull(this->Surface, this->Triangulation);
    for (const std::int32_t cell : hull.LostCells)
    {
      this->IsTouched[cell] = true;
    }
    if (hull.Triangles.empty())
    {
      obstacle.Reason = "edges of the boundary cross in a plane of the hull";
      return {};
    }
    if (!this->LabelCells(obstacle))
    {
      return {};
    }
    this->JoinCells(hull);
    this->CollectFront(hull, boundary, result, obstacle);
    return result;
  }

private:
  enum Label : std::uint8_t
  {
    Unknown,
    Inside,
    Outside
  };
  static constexpr std::int32_t NotPresent = -2;
  static constexpr std::int32_t BehindHull = -1;

  const std::int32_t* GetPoints(std::int32_t cell) const
  {
    return &this->Triangulation.Cells[4 * static_cast<std::size_t>(cell)];
  }
  std::int32_t GetNeighbor(std::int32_t cell, int face) const
  {
    return this->Triangulation.Neighbors[4 * static_cast<std::size_t>(cell) + face];
  }
  bool IsKept(std::int32_t cell) const
  {
    return this->Labels[cell] == Outside && !this->IsPierced[cell] && !this->IsTouched[cell];
  }
  bool IsRemoved(std::int32_t cell) const
  {
    return !this->Triangulation.IsInfinite(cell) && !this->IsKept(cell) &&
      (this->IsPierced[cell] || this->Labels[cell] != Inside);
  }

  void FindPresentTriangles(const FaceTable& boundary)
  {
    for (std::int32_t cell = 0; cell < this->NumberOfCells; ++cell)
    {
      if (this->Triangulation.IsInfinite(cell))
      {
        continue;
      }
      const std::int32_t* corners = this->GetPoints(cell);
      for (int i = 0; i < 4; ++i)
      {
        const int* face = OutwardFaces[i];
        const std::int32_t t = boundary.Find(corners[face[0]], corners[face[1]], corners[face[2]]);
        if (t == FaceTable::None)
        {
          continue;
        }
        const auto [a, b, c] = this->Surface.Triangles[t];
        this->Walls[4 * static_cast<std::size_t>(cell) + i] = true;
        const std::int32_t neighbor = this->GetNeighbor(cell, i);
        if (this->Points.Orient(a, b, c, corners[i]) > 0)
        {
          this->OuterCells[t] = cell;
          this->Seed(cell, Outside);
        }
        else
        {
          if (this->Triangulation.IsInfinite(neighbor))
          {
            this->OuterCells[t] = BehindHull;
          }
          this->Seed(cell, Inside);
        }
      }
    }
  }

  void WalkMissingTriangles()
  {
    const auto numberOfTriangles = static_cast<std::int32_t>(this->Surface.Triangles.size());
    std::vector<Meetings> meetings;
#pragma omp parallel
    {
#pragma omp single
      meetings.resize(omp_get_num_threads());
      TriangleWalk walk(this->Surface, this->Triangulation);
#pragma omp for schedule(dynamic, 64)
      for (std::int32_t t = 0; t < numberOfTriangles; ++t)
      {
        if (this->OuterCells[t] == NotPresent)
        {
          walk.Walk(t);
        }
      }
      meetings[omp_get_thread_num()] = std::move(walk.Result);
    }
    for (const Meetings& part : meetings)
    {
      for (const std::int32_t cell : part.Pierced)
      {
        this->IsPierced[cell] = true;
      }
      for (const std::int32_t cell : part.Touched)
      {
        this->IsTouched[cell] = true;
      }
      for (const auto& cells : part.Connected)
      {
        this->Sets.Unite(cells[0], cells[1]);
      }
      for (const auto& [t, cell] : part.FirstCells)
      {
        this->MeetingCells[t] = cell;
      }
      for (const std::int32_t wall : part.InnerWalls)
      {
        this->Walls[wall] = true;
        this->Seed(wall / 4, Inside);
      }
      for (const std::int32_t wall : part.OuterWalls)
      {
        this->Walls[wall] = true;
        this->Seed(wall / 4, Outside);
      }
    }
  }

  void Seed(std::int32_t cell, Label label) { this->Seeds.push_back({ cell, label }); }

  /// Tells the inside from the outside where no triangle passes through. Returns false where a cell
  /// would be both.
  bool LabelCells(Obstacle& obstacle)
  {
    for (std::int32_t cell = 0; cell < this->NumberOfCells; ++cell)
    {
      if (!this->Triangulation.IsInfinite(cell))
      {
        continue;
      }
      const int infinite =
        static_cast<int>(std::find(this->GetPoints(cell), this->GetPoints(cell) + 4,
                           BoundaryTriangulation::Infinite) -
          this->GetPoints(cell));
      const std::int32_t neighbor = this->GetNeighbor(cell, infinite);
      const int face = this->Triangulation.FindFace(neighbor, cell);
      if (!this->Walls[4 * static_cast<std::size_t>(neighbor) + face])
      {
        this->Seed(neighbor, Outside);
      }
    }

    std::vector<std::pair<std::int32_t, Label>> stack = this->Seeds;
    while (!stack.empty())
    {
      const auto [cell, label] = stack.back();
      stack.pop_back();
      if (this->IsPierced[cell] || this->Labels[cell] == label)
      {
        continue;
      }
      if (this->Labels[cell] != Unknown)
      {
        obstacle.Reason = "cells of the mesh lie inside of others";
        for (int a = 0; a < 3; ++a)
        {
          for (int i = 0; i < 4; ++i)
          {
            obstacle.Point[a] += 0.25 * this->Points[this->GetPoints(cell)[i]][a];
          }
        }
        return false;
      }
      this->Labels[cell] = label;
      for (int i = 0; i < 4; ++i)
      {
        const std::int32_t neighbor = this->GetNeighbor(cell, i);
        if (!this->Walls[4 * static_cast<std::size_t>(cell) + i] &&
          !this->Triangulation.IsInfinite(neighbor) && this->Labels[neighbor] != label)
        {
          stack.emplace_back(neighbor, label);
        }
      }
    }
    return true;
  }

  /// Puts the removed cells that are next to each other into one set.
  void JoinCells(const HullTriangles& hull)
  {
    for (std::int32_t cell = 0; cell < this->NumberOfCells; ++cell)
    {
      if (!this->IsRemoved(cell))
      {
        continue;
      }
      for (int i = 0; i < 4; ++i)
      {
        const std::int32_t neighbor = this->GetNeighbor(cell, i);
        if (this->IsRemoved(neighbor) && !this->Walls[4 * static_cast<std::size_t>(cell) + i])
        {
          this->Sets.Unite(cell, neighbor);
        }
      }
    }
    for (const auto& cells : hull.JoinedCells)
    {
      this->Sets.Unite(cells[0], cells[1]);
    }
  }

  void CollectFront(
    const HullTriangles& hull, const FaceTable& boundary, EmptySpace& result, Obstacle& obstacle)
  {
    std::vector<std::pair<std::int32_t, Triangle>> front; // with the set of cells that it bounds
    const auto add = [&](std::int32_t cell, const Triangle& triangle)
    { front.emplace_back(this->Sets.Find(cell), triangle); };

    std::vector<bool> isOnHull(this->Surface.Triangles.size(), false);
    for (std::size_t h = 0; h < hull.Triangles.size(); ++h)
    {
      const Triangle& triangle = hull.Triangles[h];
      const std::int32_t t = boundary.Find(triangle[0], triangle[1], triangle[2]);
      if (t != FaceTable::None)
      {
        isOnHull[t] = true;
      }
      else if (!hull.IsDelaunay[h] || !this->IsKept(hull.Cells[h]))
      {
        add(hull.Cells[h], triangle);
      }
    }
    for (std::size_t t = 0; t < this->Surface.Triangles.size(); ++t)
    {
      if (isOnHull[t])
      {
        continue;
      }
      const std::int32_t outer = this->OuterCells[t];
      if (outer == BehindHull || (outer == NotPresent && this->MeetingCells[t] < 0))
      {
        obstacle.Reason = "a boundary face does not fit into the hull";
        obstacle.Cells = { this->Surface.Faces[t] / 4, -1 };
        std::copy_n(this->Points[this->Surface.Triangles[t][0]], 3, obstacle.Point.begin());
        return;
      }
      if (outer == NotPresent || !this->IsKept(outer))
      {
        add(outer == NotPresent ? this->MeetingCells[t] : outer, this->Surface.Triangles[t]);
      }
    }
    for (std::int32_t cell = 0; cell < this->NumberOfCells; ++cell)
    {
      if (!this->IsKept(cell))
      {
        continue;
      }
      const std::int32_t* corners = this->GetPoints(cell);
      result.Cells.push_back({ corners[0], corners[1], corners[2], corners[3] });
      for (int i = 0; i < 4; ++i)
      {
        const std::int32_t neighbor = this->GetNeighbor(cell, i);
        if (!this->Walls[4 * static_cast<std::size_t>(cell) + i] &&
          !this->Triangulation.IsInfinite(neighbor) && !this->IsKept(neighbor))
        {
          const int* face = OutwardFaces[i];
          add(neighbor, { corners[face[0]], corners[face[1]], corners[face[2]] });
        }
      }
    }

    std::sort(front.begin(), front.end());
    Front set;
    for (std::size_t begin = 0, end = 0; begin < front.size(); begin = end)
    {
      set.clear();
      for (end = begin; end < front.size() && front[end].first == front[begin].first; ++end)
      {
        set.push_back(front[end].second);
      }
      std::vector<Front> pockets = SplitFront(this->Points, set);
      if (pockets.empty())
      {
        obstacle.Reason = "the boundary does not tell inside from outside";
        std::copy_n(this->Points[set[0][0]], 3, obstacle.Point.begin());
        return;
      }
      std::move(pockets.begin(), pockets.end(), std::back_inserter(result.Pockets));
    }
  }

  const BoundarySurface& Surface;
  const BoundaryTriangulation& Triangulation;
  ExactPoints Points;
  std::int32_t NumberOfCells;
  std::vector<std::int32_t> OuterCells; ///< for each triangle the cell on its empty side
  std::vector<bool> Walls;              ///< 4 * cell + face: whether boundary is there
  std::vector<Label> Labels;
  std::vector<bool> IsPierced;
  std::vector<bool> IsTouched;
  DisjointSets Sets;                      ///< of cells that one pocket may have
  std::vector<std::int32_t> MeetingCells; ///< for each missing triangle a cell that it meets
  std::vector<std::pair<std::int32_t, Label>> Seeds;
};

} // namespace

//----------------------------------------------------------------------------
EmptySpace FindPockets(
  const BoundarySurface& surface, const BoundaryTriangulation& triangulation, Obstacle& obstacle)
{
  return PocketFinder(surface, triangulation).Find(obstacle);
}

} // namespace tetralux
