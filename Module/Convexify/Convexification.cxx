// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/Convexification.h"

#include "Base/Stopwatch.h"
#include "Convexify/BoundarySurface.h"
#include "Convexify/BoundaryTriangulation.h"
#include "Convexify/FaceTable.h"
#include "Convexify/PocketFill.h"
#include "Convexify/PocketFinder.h"
#include "Geometry/TetrahedronFaces.h"
#include "Mesh/MeshLimits.h"

#include <algorithm>
#include <sstream>

namespace tetralux
{
namespace
{

/// Checks that cells have positive volume and that they and the mesh share all faces but for those
/// of a convex surface, which is returned. Cells that cover a convex body in total, by boundary,
/// and turn the same way cover each point of it once.
Obstacle VerifyFilled(const BoundarySurface& surface, const std::vector<double>& coordinates,
  const std::vector<Cell>& cells, const Front& flat, std::vector<Triangle>& hull)
{
  const ExactPoints points(coordinates.data());
  Obstacle obstacle;
  const auto refuse = [&](const char* reason, std::int32_t point)
  {
    obstacle.Reason = reason;
    std::copy_n(points[point], 3, obstacle.Point.begin());
    return obstacle;
  };

  // Each face waits for its opposite. The solid side of a boundary triangle is its negative side,
  // as the cell is of its face.
  std::vector<Triangle> open;
  std::vector<bool> isMet;
  FaceTable table(surface.Triangles.size() + 2 * cells.size());
  const auto match = [&](std::int32_t a, std::int32_t b, std::int32_t c)
  {
    const std::int32_t other = table.Find(a, b, c);
    if (other == FaceTable::None)
    {
      table.Set(a, b, c, static_cast<std::int32_t>(open.size()));
      open.push_back({ a, b, c });
      isMet.push_back(false);
      return true;
    }
    const Triangle& opposite = open[other];
    const auto at = std::find(opposite.begin(), opposite.end(), a) - opposite.begin();
    const bool isFree = !isMet[other] && opposite[(at + 1) % 3] == c;
    isMet[other] = true;
    return isFree;
  };
  for (const auto& [a, b, c] : surface.Triangles)
  {
    if (!match(a, b, c))
    {
      return refuse("the filling has a face twice", a);
    }
  }
  for (const auto& [a, b, c] : flat)
  {
    if (!match(a, c, b))
    {
      return refuse("the filling has a face twice", a);
    }
  }
  for (const Cell& cell : cells)
  {
    if (points.Orient(cell[0], cell[1], cell[2], cell[3]) <= 0)
    {
      return refuse("the filling has a cell of no positive volume", cell[0]);
    }
    for (const auto& face : OutwardFaces)
    {
      if (!match(cell[face[0]], cell[face[1]], cell[face[2]]))
      {
        return refuse("the filling has a face twice", cell[face[0]]);
      }
    }
  }
  for (std::size_t t = 0; t < open.size(); ++t)
  {
    if (!isMet[t])
    {
      hull.push_back(open[t]);
    }
  }
  if (!IsConvexSurface(points, hull))
  {
    return refuse("the filling is not convex", hull.empty() ? 0 : hull[0][0]);
  }
  return obstacle;
}

double MeasureCells(const std::vector<double>& coordinates, const std::vector<Cell>& cells)
{
  double sum = 0;
  double rest = 0; // Kahan: what the sum could not take
  for (const Cell& cell : cells)
  {
    const double* p[4];
    double e[3][3];
    for (int i = 0; i < 4; ++i)
    {
      p[i] = &coordinates[3 * static_cast<std::size_t>(cell[i])];
    }
    for (int i = 0; i < 3; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        e[i][a] = p[i + 1][a] - p[0][a];
      }
    }
    const double volume = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
      e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
      e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    const double term = volume - rest;
    const double next = sum + term;
    rest = (next - sum) - term;
    sum = next;
  }
  return sum / 6;
}

/// Convexify's steps.
class Convexifier
{
public:
  Convexifier(const TetrahedralMesh& mesh, const FaceNeighbors& neighbors, TouchingCells touching,
    const std::function<bool(double)>& progress)
    : Mesh(mesh)
    , Neighbors(neighbors)
    , Touching(touching)
    , Progress(progress)
  {
    this->Result.BoundaryFaces = static_cast<std::int64_t>(neighbors.BoundaryFaces.size());
  }

  Convexification Run()
  {
    Obstacle obstacle;
    this->Fill(obstacle);
    if (!obstacle.Reason.empty())
    {
      std::ostringstream line;
      line.precision(10);
      line << obstacle.Reason << ", near (" << obstacle.Point[0] << ", " << obstacle.Point[1]
           << ", " << obstacle.Point[2] << ")";
      if (obstacle.Cells[0] >= 0)
      {
        line << ", cell " << this->GetOriginalCell(obstacle.Cells[0]);
      }
      if (obstacle.Cells[1] >= 0)
      {
        line << " and cell " << this->GetOriginalCell(obstacle.Cells[1]);
      }
      this->Result.Refusal = line.str();
      this->Result.RefusalPoint = obstacle.Point;
      this->Result.RefusalCells = obstacle.Cells;
    }
    return std::move(this->Result);
  }

private:
  std::int64_t GetOriginalCell(std::int32_t cell) const
  {
    return this->Mesh.OriginalCells.empty() ? cell : this->Mesh.OriginalCells[cell];
  }

  bool Continue(double fraction)
  {
    this->Result.Aborted = this->Result.Aborted || (this->Progress && !this->Progress(fraction));
    return !this->Result.Aborted;
  }

  void Fill(Obstacle& obstacle)
  {
    Stopwatch watch;
    const BoundarySurface surface = FindBoundarySurface(this->Mesh, this->Neighbors, obstacle);
    const bool refusesContacts = this->Touching == TouchingCells::Refuse;
    if (refusesContacts && obstacle.Reason.empty())
    {
      obstacle = surface.Contact;
    }
    this->Result.Convex = obstacle.Reason.empty() &&
      IsConvexSurface(ExactPoints(surface.Coordinates.data()), surface.Triangles);
    this->Result.ConvexTestSeconds = watch.Lap();
    if (!obstacle.Reason.empty() || this->Result.Convex || !this->Continue(0.1))
    {
      return;
    }
    obstacle = FindSelfIntersection(surface);
    this->Result.ConvexTestSeconds += watch.Lap();
    if (!obstacle.Reason.empty() || !this->Continue(0.2))
    {
      return;
    }

    const BoundaryTriangulation triangulation = TriangulateDelaunay(surface.Coordinates);
    this->Result.TriangulationSeconds = watch.Lap();
    if (triangulation.Cells.empty())
    {
      obstacle.Reason = "the boundary lies in one plane";
      return;
    }
    if (!this->Continue(0.4))
    {
      return;
    }

    EmptySpace space = FindPockets(surface, triangulation, obstacle);
    this->Result.MissingFaces = space.MissingFaces;
    const PointNeighbors neighbors(triangulation);
    this->Result.PocketSeconds = watch.Lap();
    if (!obstacle.Reason.empty() || !this->Continue(0.5))
    {
      return;
    }

    std::vector<double> coordinates = surface.Coordinates;
    Front flat;
    const std::vector<Cell> cells = FillPockets(std::move(space), neighbors, coordinates, flat,
      obstacle, [this](double fraction) { return this->Continue(0.5 + 0.4 * fraction); });
    this->Result.FillSeconds = watch.Lap();
    if (!obstacle.Reason.empty() || this->Result.Aborted)
    {
      return;
    }

    const std::size_t steinerPoints = (coordinates.size() - surface.Coordinates.size()) / 3;
    if (this->Mesh.GetNumberOfPoints() + steinerPoints > std::size_t{ MaximumPoints } ||
      this->Mesh.GetNumberOfCells() + cells.size() > std::size_t{ MaximumCells })
    {
      obstacle.Reason = "with the imaginary cells there are more points or cells than are possible";
      return;
    }

    std::vector<Triangle> hull;
    obstacle = VerifyFilled(surface, coordinates, cells, flat, hull);
    FaceTable flatFaces(flat.size());
    for (const auto& [a, b, c] : flat)
    {
      flatFaces.Set(a, b, c, 0);
    }
    this->Result.FlatPocketFaces = std::count_if(surface.Triangles.begin(), surface.Triangles.end(),
      [&](const Triangle& triangle)
      { return flatFaces.Find(triangle[0], triangle[1], triangle[2]) != FaceTable::None; });
    if (obstacle.Reason.empty())
    {
      this->Result.MeshVolume = MeasureEnclosedVolume(coordinates, surface.Triangles);
      this->Result.HullVolume = MeasureEnclosedVolume(coordinates, hull);
      this->Result.ImaginaryVolume = MeasureCells(coordinates, cells);
      this->Collect(surface, coordinates, cells);
      if (refusesContacts && !surface.Seams.empty())
      {
        this->FindSeam(surface, obstacle);
      }
      if (obstacle.Reason.empty() && surface.HasInvertedCells)
      {
        this->FindOverlap(surface.MergedIds, obstacle);
      }
    }
    this->Result.VerificationSeconds = watch.Lap();
    this->Continue(1);
  }

  void Collect(const BoundarySurface& surface, const std::vector<double>& coordinates,
    const std::vector<Cell>& cells)
  {
    const std::int32_t numberOfPoints = surface.GetNumberOfPoints();
    const auto firstSteinerPoint = static_cast<std::int32_t>(this->Mesh.GetNumberOfPoints());
    this->Result.Cells.reserve(4 * cells.size());
    for (const Cell& cell : cells)
    {
      for (const std::int32_t point : cell)
      {
        this->Result.Cells.push_back(point < numberOfPoints
            ? surface.PointIds[point]
            : firstSteinerPoint + (point - numberOfPoints));
      }
    }
    this->Result.SteinerPoints.assign(
      coordinates.begin() + static_cast<std::ptrdiff_t>(surface.Coordinates.size()),
      coordinates.end());
  }

  /// The faces of the imaginary cells.
  FaceTable TabulateFaces() const
  {
    FaceTable faces(this->Result.Cells.size() / 2);
    for (std::size_t i = 0; i < this->Result.Cells.size(); i += 4)
    {
      const std::int32_t* cell = &this->Result.Cells[i];
      for (const auto& face : OutwardFaces)
      {
        faces.Set(cell[face[0]], cell[face[1]], cell[face[2]], static_cast<std::int32_t>(i / 4));
      }
    }
    return faces;
  }

  /// Refuses imaginary cells on triangles that have other ids in the mesh.
  void FindSeam(const BoundarySurface& surface, Obstacle& obstacle)
  {
    const FaceTable faces = this->TabulateFaces();
    for (const std::int32_t seam : surface.Seams)
    {
      const auto [a, b, c] = surface.Triangles[seam];
      if (faces.Find(surface.PointIds[a], surface.PointIds[b], surface.PointIds[c]) !=
        FaceTable::None)
      {
        obstacle.Reason = TouchingCellsReason;
        obstacle.Cells = { surface.Faces[seam] / 4, -1 };
        std::copy_n(
          &surface.Coordinates[3 * static_cast<std::size_t>(a)], 3, obstacle.Point.begin());
        this->Result.Cells.clear();
        this->Result.SteinerPoints.clear();
        return;
      }
    }
  }

  /// Where cells fold over each other, what they have in common may count as empty, and be filled.
  void FindOverlap(const std::vector<std::int32_t>& mergedIds, Obstacle& obstacle)
  {
    const FaceTable faces = this->TabulateFaces();
    for (std::size_t i = 0; i < this->Mesh.Cells.size(); ++i)
    {
      const std::int32_t* cell = &this->Mesh.Cells[i / 4 * 4];
      const int* face = OutwardFaces[i % 4];
      const std::int32_t a = mergedIds[cell[face[0]]];
      const std::int32_t b = mergedIds[cell[face[1]]];
      const std::int32_t c = mergedIds[cell[face[2]]];
      if (this->Neighbors.Neighbors[i] >= 0 && a >= 0 && b >= 0 && c >= 0 &&
        faces.Find(a, b, c) != FaceTable::None &&
        !IsCollapsed(this->Mesh, mergedIds, static_cast<std::int64_t>(i / 4)) &&
        !IsCollapsed(this->Mesh, mergedIds, this->Neighbors.Neighbors[i]))
      {
        obstacle.Reason = "cells of the mesh fold over each other";
        obstacle.Cells = { static_cast<std::int32_t>(i / 4), this->Neighbors.Neighbors[i] };
        std::copy_n(&this->Mesh.Points[3 * static_cast<std::size_t>(cell[face[0]])], 3,
          obstacle.Point.begin());
        this->Result.Cells.clear();
        this->Result.SteinerPoints.clear();
        return;
      }
    }
  }

  const TetrahedralMesh& Mesh;
  const FaceNeighbors& Neighbors;
  TouchingCells Touching;
  const std::function<bool(double)>& Progress;
  Convexification Result;
};

} // namespace

//----------------------------------------------------------------------------
bool IsConvex(const TetrahedralMesh& mesh, const FaceNeighbors& neighbors)
{
  Obstacle obstacle;
  const BoundarySurface surface = FindBoundarySurface(mesh, neighbors, obstacle);
  return obstacle.Reason.empty() && surface.Contact.Reason.empty() &&
    IsConvexSurface(ExactPoints(surface.Coordinates.data()), surface.Triangles);
}

//----------------------------------------------------------------------------
Convexification Convexify(const TetrahedralMesh& mesh, const FaceNeighbors& neighbors,
  TouchingCells touching, const std::function<bool(double)>& progress)
{
  return Convexifier(mesh, neighbors, touching, progress).Run();
}

} // namespace tetralux
