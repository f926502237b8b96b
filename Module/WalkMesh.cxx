// SPDX-License-Identifier: BSD-3-Clause
#include "WalkMesh.h"

#include "FaceNeighbors.h"
#include "SpatialOrder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
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
  const std::int64_t n = static_cast<std::int64_t>(this->Mesh.GetNumberOfPoints());
  table.resize(n);
#pragma omp parallel for schedule(static)
  for (std::int64_t p = 0; p < n; ++p)
  {
    // Divided: where the radius is not a normal number, its inverse is infinite.
    const double* x = &this->Mesh.Points[3 * p];
    table[p] = { static_cast<Real>((x[0] - this->Center[0]) / this->Radius),
      static_cast<Real>((x[1] - this->Center[1]) / this->Radius),
      static_cast<Real>((x[2] - this->Center[2]) / this->Radius), 0 };
  }
}

WalkMesh::WalkMesh(TetrahedralMesh mesh)
  : Mesh(std::move(mesh))
{
  this->Removed = RemoveUnusableCells(this->Mesh);
  OrderSpatially(this->Mesh);

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
      radius = std::hypot(radius, 0.5 * hi[a] - 0.5 * lo[a]);
    }
    this->Radius = radius > 0 ? radius : 1;
  }
  this->FillCoordinates<float>();

  const FaceNeighbors neighbors = FindFaceNeighbors(this->Mesh.Cells, numberOfPoints);
  this->NumberOfNonManifoldFaces = neighbors.NumberOfNonManifoldFaces;
  this->NumberOfComponents = neighbors.NumberOfComponents;

  const std::int64_t numberOfFaces = static_cast<std::int64_t>(neighbors.Neighbors.size());
  std::vector<WalkFace> faces(numberOfFaces);
#pragma omp parallel for schedule(static)
  for (std::int64_t f = 0; f < numberOfFaces; ++f)
  {
    const std::int32_t cell = neighbors.Neighbors[f];
    const std::int32_t point = cell < 0
      ? 0
      : this->Mesh.Cells[4 * static_cast<std::int64_t>(cell) + neighbors.NeighborFaces[f]];
    faces[f] = { cell, point };
  }
  this->Tables = MakeWalkTables(std::move(faces), this->Mesh.Cells, this->FloatPoints);
}

template <class Real>
void WalkMesh::SetPointScalars(Span<const double> scalars, double offset, double scale)
{
  auto& table = this->GetPointTable<Real>();
  if (table.size() != this->Mesh.GetNumberOfPoints())
  {
    this->FillCoordinates<Real>();
  }
  // Far beyond any transfer function, and still finite when two of them are subtracted.
  constexpr double Largest = 1e30;
  const std::int64_t n = static_cast<std::int64_t>(table.size());
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
    this->DoublePoints.size() * sizeof(WalkPoint<double>) + this->Tables.GetSize();
}

template const WalkPoint<float>* WalkMesh::GetPoints<float>() const;
template const WalkPoint<double>* WalkMesh::GetPoints<double>() const;
template void WalkMesh::SetPointScalars<float>(Span<const double>, double, double);
template void WalkMesh::SetPointScalars<double>(Span<const double>, double, double);

} // namespace tetralux
