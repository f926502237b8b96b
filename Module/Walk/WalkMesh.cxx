// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/WalkMesh.h"

#include "Mesh/FaceNeighbors.h"
#include "Mesh/SpatialOrder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

/// Of the time that a mesh takes, what is over behind each stage.
///@{
constexpr double CleanedShare = 0.1;
constexpr double OrderedShare = 0.5;
constexpr double MatchedShare = 0.95;
///@}

} // namespace

template <>
std::vector<WalkPoint<float>>& WalkMesh::GetPointTable<float>()
{
  return this->FloatPoints;
}

template <>
std::vector<WalkPoint<double>>& WalkMesh::GetPointTable<double>()
{
  return this->DoublePoints;
}

template <class Real>
const WalkPoint<Real>* WalkMesh::GetPoints() const
{
  return const_cast<WalkMesh*>(this)->GetPointTable<Real>().data();
}

template <class Real>
void WalkMesh::FillCoordinates()
{
  auto& table = this->GetPointTable<Real>();
  const std::int64_t ofMesh = static_cast<std::int64_t>(this->Mesh.GetNumberOfPoints());
  const std::int64_t n = ofMesh + static_cast<std::int64_t>(this->SteinerPoints.size() / 3);
  table.resize(n);
#pragma omp parallel for schedule(static)
  for (std::int64_t p = 0; p < n; ++p)
  {
    // Divided: where the radius is not a normal number, its inverse is infinite.
    const double* x =
      p < ofMesh ? &this->Mesh.Points[3 * p] : &this->SteinerPoints[3 * (p - ofMesh)];
    table[p].X = static_cast<Real>((x[0] - this->Center[0]) / this->Radius);
    table[p].Y = static_cast<Real>((x[1] - this->Center[1]) / this->Radius);
    table[p].Z = static_cast<Real>((x[2] - this->Center[2]) / this->Radius);
  }
}

/// What lies behind each face of the cells, in the words of the tables.
RawVector<WalkFace> MakeFaces(
  const std::vector<std::int32_t>& cells, const FaceNeighbors& neighbors)
{
  const std::int64_t numberOfFaces = static_cast<std::int64_t>(neighbors.Neighbors.size());
  RawVector<WalkFace> faces(numberOfFaces);
#pragma omp parallel for schedule(static)
  for (std::int64_t f = 0; f < numberOfFaces; ++f)
  {
    const std::int32_t cell = neighbors.Neighbors[f];
    const std::int32_t point =
      cell < 0 ? 0 : cells[4 * static_cast<std::int64_t>(cell) + neighbors.NeighborFaces[f]];
    faces[f] = { cell, point };
  }
  return faces;
}

WalkMesh::WalkMesh(TetrahedralMesh mesh, const std::function<bool(double)>& progress)
  : Mesh(std::move(mesh))
{
  const auto goOn = [&](double share)
  {
    this->Complete = !progress || progress(share);
    if (!this->Complete)
    {
      this->Mesh = TetrahedralMesh();
    }
    return this->Complete;
  };
  this->Removed = RemoveUnusableCells(this->Mesh);
  if (!goOn(CleanedShare))
  {
    return;
  }
  OrderSpatially(this->Mesh);
  if (!goOn(OrderedShare))
  {
    return;
  }

  this->MeasureBox();
  this->FillCoordinates<float>();

  const std::int64_t numberOfPoints = static_cast<std::int64_t>(this->Mesh.GetNumberOfPoints());
  RawVector<WalkFace> faces;
  {
    const FaceNeighbors neighbors = FindFaceNeighbors(this->Mesh.Cells, numberOfPoints);
    this->NumberOfNonManifoldFaces = neighbors.NumberOfNonManifoldFaces;
    this->NumberOfComponents = neighbors.NumberOfComponents;
    faces = MakeFaces(this->Mesh.Cells, neighbors);
  }
  if (!goOn(MatchedShare))
  {
    return;
  }
  this->Tables = MakeWalkTables(std::move(faces), this->Mesh.Cells, this->FloatPoints);
}

bool WalkMesh::SetPoints(const std::vector<double>& points)
{
  if (points.size() != this->Mesh.Points.size())
  {
    throw std::invalid_argument(std::to_string(points.size()) + " coordinates were given for " +
      std::to_string(this->Mesh.GetNumberOfPoints()) + " points");
  }
  const bool allFinite =
    std::all_of(points.begin(), points.end(), [](double x) { return std::isfinite(x); });
  if (!allFinite || this->Removed.NonFiniteCoordinates > 0)
  {
    return false;
  }
  this->Mesh.Points = points;
  this->Convex.reset();
  this->Convexity.reset();
  this->ConvexTables = WalkTables();
  this->SteinerPoints.clear();
  this->MeasureBox();
  this->FillCoordinates<float>();
  if (!this->DoublePoints.empty())
  {
    this->FillCoordinates<double>();
  }
  RefitWalkTables(this->Tables, this->FloatPoints);
  return true;
}

FaceNeighbors WalkMesh::MakeNeighbors() const
{
  FaceNeighbors neighbors;
  const auto numberOfFaces = static_cast<std::int64_t>(this->Tables.Faces.size());
  neighbors.Neighbors.resize(numberOfFaces);
  neighbors.NeighborFaces.resize(numberOfFaces);
  neighbors.BoundaryFaces.resize(this->Tables.Entries.size());
  neighbors.NumberOfNonManifoldFaces = this->NumberOfNonManifoldFaces;
  neighbors.NumberOfComponents = this->NumberOfComponents;
#pragma omp parallel for schedule(static)
  for (std::int64_t f = 0; f < numberOfFaces; ++f)
  {
    const WalkFace& face = this->Tables.Faces[f];
    neighbors.Neighbors[f] = face.Cell;
    if (face.Cell < 0)
    {
      neighbors.BoundaryFaces[~face.Cell] = static_cast<std::int32_t>(f);
      continue;
    }
    const std::int32_t* points = &this->Mesh.Cells[4 * static_cast<std::size_t>(face.Cell)];
    neighbors.NeighborFaces[f] =
      static_cast<std::uint8_t>(std::find(points, points + 4, face.Point) - points);
  }
  return neighbors;
}

void WalkMesh::MeasureBox()
{
  const std::int64_t numberOfPoints = static_cast<std::int64_t>(this->Mesh.GetNumberOfPoints());
  double lo[3], hi[3];
  std::fill_n(lo, 3, std::numeric_limits<double>::max());
  std::fill_n(hi, 3, std::numeric_limits<double>::lowest());
  for (std::int64_t p = 0; p < numberOfPoints; ++p)
  {
    for (int a = 0; a < 3; ++a)
    {
      lo[a] = std::min(lo[a], this->Mesh.Points[3 * p + a]);
      hi[a] = std::max(hi[a], this->Mesh.Points[3 * p + a]);
    }
  }
  if (numberOfPoints > 0)
  {
    double radius = 0;
    for (int a = 0; a < 3; ++a)
    {
      // Halved before they are added, so that no sum overflows.
      this->Center[a] = 0.5 * lo[a] + 0.5 * hi[a];
      this->HalfSize[a] = 0.5 * hi[a] - 0.5 * lo[a];
      radius = std::hypot(radius, this->HalfSize[a]);
    }
    this->Radius = radius > 0 ? radius : 1;
  }
}

bool WalkMesh::IsConvex()
{
  if (!this->Convexity)
  {
    this->Convexity =
      this->Convex ? this->Convex->Convex : tetralux::IsConvex(this->Mesh, this->MakeNeighbors());
  }
  return *this->Convexity;
}

void WalkMesh::MakeConvex(const std::function<bool(double)>& progress)
{
  if (this->Convex)
  {
    return;
  }
  const std::int64_t numberOfPoints = static_cast<std::int64_t>(this->Mesh.GetNumberOfPoints());
  auto convex = std::make_unique<Convexification>(
    Convexify(this->Mesh, this->MakeNeighbors(), TouchingCells::Refuse, progress));
  if (convex->Aborted)
  {
    return;
  }
  if (!convex->Cells.empty())
  {
    // As all cells of the tables: ascending point ids.
    std::vector<std::int32_t> cells = this->Mesh.Cells;
    cells.insert(cells.end(), convex->Cells.begin(), convex->Cells.end());
    for (std::size_t cell = this->Mesh.Cells.size(); cell < cells.size(); cell += 4)
    {
      std::sort(&cells[cell], &cells[cell] + 4);
    }
    this->SteinerPoints = convex->SteinerPoints;
    this->FillCoordinates<float>();
    if (!this->DoublePoints.empty())
    {
      this->FillCoordinates<double>();
    }
    const FaceNeighbors neighbors =
      FindFaceNeighbors(cells, numberOfPoints + convex->GetNumberOfSteinerPoints());
    this->ConvexTables = MakeWalkTables(MakeFaces(cells, neighbors), cells, this->FloatPoints);
  }
  this->Convex = std::move(convex);
}

template <class Real>
void WalkMesh::SetPointScalars(Span<const double> scalars, double offset, double scale)
{
  auto& table = this->GetPointTable<Real>();
  if (table.empty())
  {
    this->FillCoordinates<Real>();
  }
  // Far beyond any transfer function, and still finite when two of them are subtracted.
  constexpr double Largest = 1e30;
  const std::int64_t n = static_cast<std::int64_t>(scalars.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t p = 0; p < n; ++p)
  {
    const double s = (scalars[p] - offset) / scale;
    table[p].S = std::isfinite(scalars[p]) ? static_cast<Real>(std::clamp(s, -Largest, Largest))
                                           : std::numeric_limits<Real>::quiet_NaN();
  }
}

std::size_t WalkMesh::GetTableSize() const
{
  return this->FloatPoints.size() * sizeof(WalkPoint<float>) +
    this->DoublePoints.size() * sizeof(WalkPoint<double>) + this->Tables.GetSize() +
    this->ConvexTables.GetSize();
}

template const WalkPoint<float>* WalkMesh::GetPoints<float>() const;
template const WalkPoint<double>* WalkMesh::GetPoints<double>() const;
template void WalkMesh::SetPointScalars<float>(Span<const double>, double, double);
template void WalkMesh::SetPointScalars<double>(Span<const double>, double, double);

} // namespace tetralux
