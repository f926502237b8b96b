// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/FacetedCells.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tetralux
{

namespace
{

/// The polygons of a face, as positions in the face's own numbering (vtkQuadraticTriangle.h and so
/// on). A linear face is a polygon as it is.
std::vector<std::vector<int>> CutFace(int faceType, int numberOfPoints)
{
  switch (faceType)
  {
    case VTK_QUADRATIC_TRIANGLE:
      return { { 0, 3, 5 }, { 3, 1, 4 }, { 5, 4, 2 }, { 3, 4, 5 } };
    case VTK_BIQUADRATIC_TRIANGLE:
      return { { 6, 0, 3 }, { 6, 3, 1 }, { 6, 1, 4 }, { 6, 4, 2 }, { 6, 2, 5 }, { 6, 5, 0 } };
    case VTK_QUADRATIC_QUAD:
      return { { 0, 4, 7 }, { 4, 1, 5 }, { 5, 2, 6 }, { 6, 3, 7 }, { 4, 5, 6, 7 } };
    case VTK_BIQUADRATIC_QUAD:
      return { { 8, 0, 4 }, { 8, 4, 1 }, { 8, 1, 5 }, { 8, 5, 2 }, { 8, 2, 6 }, { 8, 6, 3 },
        { 8, 3, 7 }, { 8, 7, 0 } };
    case VTK_QUADRATIC_LINEAR_QUAD:
      return { { 0, 4, 5, 3 }, { 4, 1, 2, 5 } };
    default:
    {
      std::vector<int> polygon(numberOfPoints);
      for (int i = 0; i < numberOfPoints; ++i)
      {
        polygon[i] = i;
      }
      return { polygon };
    }
  }
}

FacetedCellType ReadFaces(int cellType)
{
  FacetedCellType result;
  auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(cellType));
  const int numberOfPoints = static_cast<int>(cell->GetNumberOfPoints());
  result.NumberOfPoints = numberOfPoints;
  for (int i = 0; i < numberOfPoints; ++i)
  {
    cell->GetPointIds()->SetId(i, i);
  }

  std::vector<bool> onFace(numberOfPoints, false);
  for (int faceIndex = 0; faceIndex < cell->GetNumberOfFaces(); ++faceIndex)
  {
    vtkCell* face = cell->GetFace(faceIndex);
    const int facePoints = static_cast<int>(face->GetNumberOfPoints());
    for (std::vector<int>& polygon : CutFace(face->GetCellType(), facePoints))
    {
      for (int& point : polygon)
      {
        point = static_cast<int>(face->GetPointId(point));
        onFace[point] = true;
      }
      result.Polygons.push_back(std::move(polygon));
    }
  }
  const auto middle = std::find(onFace.begin(), onFace.end(), false);
  result.MiddlePoint =
    middle == onFace.end() ? -1 : static_cast<int>(std::distance(onFace.begin(), middle));

  double center[3];
  cell->GetParametricCenter(center);
  result.MiddleWeights.resize(numberOfPoints);
  cell->InterpolateFunctions(center, result.MiddleWeights.data());
  result.ApexAtCorner = cell->IsLinear() != 0;
  return result;
}

} // namespace

double GetSignedVolume(const double* a, const double* b, const double* c, const double* d)
{
  const double u[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
  const double v[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
  const double w[3] = { d[0] - a[0], d[1] - a[1], d[2] - a[2] };
  return ((u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
           (u[0] * v[1] - u[1] * v[0]) * w[2]) /
    6;
}

const FacetedCellType* GetFacetedCellType(int cellType)
{
  static const std::map<int, FacetedCellType> types = []
  {
    std::map<int, FacetedCellType> result;
    for (int type : { VTK_PENTAGONAL_PRISM, VTK_HEXAGONAL_PRISM, VTK_QUADRATIC_TETRA,
           VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_PYRAMID,
           VTK_TRIQUADRATIC_HEXAHEDRON, VTK_TRIQUADRATIC_PYRAMID, VTK_QUADRATIC_LINEAR_WEDGE,
           VTK_BIQUADRATIC_QUADRATIC_WEDGE, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON })
    {
      result.emplace(type, ReadFaces(type));
    }
    return result;
  }();
  const auto found = types.find(cellType);
  return found == types.end() ? nullptr : &found->second;
}

void FacetedCellSplitter::Clear() { this->Triangles.clear(); }

void FacetedCellSplitter::AddPolygon(const std::int64_t* ids, std::size_t size)
{
  // A fan at the smallest id: what the cell on the other side of the face does as well.
  const std::size_t first = std::min_element(ids, ids + size) - ids;
  for (std::size_t i = 1; i + 1 < size; ++i)
  {
    const std::int64_t a = ids[first];
    const std::int64_t b = ids[(first + i) % size];
    const std::int64_t c = ids[(first + i + 1) % size];
    if (a != b && b != c && c != a)
    {
      this->Triangles.insert(this->Triangles.end(), { a, b, c });
    }
  }
}

const std::vector<std::int64_t>& FacetedCellSplitter::GetPoints()
{
  this->Points = this->Triangles;
  std::sort(this->Points.begin(), this->Points.end());
  this->Points.erase(std::unique(this->Points.begin(), this->Points.end()), this->Points.end());
  return this->Points;
}

double FacetedCellSplitter::SignedVolume(const double* points) const
{
  double volume = 0;
  for (std::size_t i = 0; i < this->Triangles.size(); i += 3)
  {
    // Seen from a corner of the cell, so that an offset of the whole mesh does not cancel.
    volume += GetSignedVolume(points + 3 * this->Triangles[i], points + 3 * this->Triangles[i + 2],
      points + 3 * this->Triangles[i + 1], points + 3 * this->Triangles[0]);
  }
  return volume;
}

void FacetedCellSplitter::OrientOutward(const double* points)
{
  if (this->SignedVolume(points) < 0)
  {
    for (std::size_t i = 0; i < this->Triangles.size(); i += 3)
    {
      std::swap(this->Triangles[i + 1], this->Triangles[i + 2]);
    }
  }
}

bool FacetedCellSplitter::ConeFromSmallestId(
  const double* points, std::vector<std::int64_t>& tets) const
{
  if (this->Triangles.empty())
  {
    return false;
  }
  // Fraction of the cell's volume below which a part is flat: far above the rounding of the
  // volumes, far below any part that a face in general position makes.
  const double flatFraction = 1e-9;
  const double flatVolume = flatFraction * std::abs(this->SignedVolume(points));
  const std::int64_t apex = *std::min_element(this->Triangles.begin(), this->Triangles.end());
  const std::size_t start = tets.size();
  for (std::size_t i = 0; i < this->Triangles.size(); i += 3)
  {
    const std::int64_t a = this->Triangles[i];
    const std::int64_t b = this->Triangles[i + 1];
    const std::int64_t c = this->Triangles[i + 2];
    if (a == apex || b == apex || c == apex)
    {
      continue;
    }
    const double volume =
      GetSignedVolume(points + 3 * a, points + 3 * c, points + 3 * b, points + 3 * apex);
    if (!(volume > flatVolume)) // also where a coordinate is not a number
    {
      tets.resize(start);
      return false;
    }
    tets.insert(tets.end(), { a, c, b, apex });
  }
  return true;
}

void FacetedCellSplitter::ConeFrom(std::int64_t apex, std::vector<std::int64_t>& tets) const
{
  for (std::size_t i = 0; i < this->Triangles.size(); i += 3)
  {
    tets.insert(
      tets.end(), { this->Triangles[i], this->Triangles[i + 2], this->Triangles[i + 1], apex });
  }
}

} // namespace tetralux
