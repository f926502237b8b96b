// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/FacetedCells.h"

#include "Geometry/PolyhedronFilling.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace tetralux
{

namespace
{

using Vector = std::array<double, 3>;

Vector At(const double* points, std::int64_t id)
{
  return { points[3 * id], points[3 * id + 1], points[3 * id + 2] };
}

Vector Subtract(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector Add(const Vector& a, const Vector& b) { return { a[0] + b[0], a[1] + b[1], a[2] + b[2] }; }

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A corner of a polygon is bent inwards from this share of the polygon's area on: above rounding.
constexpr double SmallestBend = 1e-9;

/// Distances to the planes of faces that the middle of a cell is looked for with, as a share of the
/// cell's extent: from what only thick cells have room for down to rounding. A mean of corners
/// needs no more than to be inside.
constexpr double LargestClearance = 0.25;
constexpr double SmallestClearance = 1e-9;
constexpr double SmallestClearanceOfMean = 1e-12;

/// Steps that are tried for each of them, and how much farther than below a plane each goes: what
/// converges in some dozens where there is room.
constexpr int MaximumSteps = 200;
constexpr double OverRelaxation = 1.5;

/// The corners of a polygon relative to one of them, so that an offset of the whole mesh does not
/// cancel.
std::vector<Vector> GetCorners(const std::vector<std::int64_t>& polygon, const double* points)
{
  std::vector<Vector> corners;
  corners.reserve(polygon.size());
  for (const std::int64_t id : polygon)
  {
    corners.push_back(Subtract(At(points, id), At(points, polygon[0])));
  }
  return corners;
}

/// Twice the area is its length.
Vector FindNormal(const std::vector<Vector>& corners)
{
  Vector normal = { 0, 0, 0 };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    normal = Add(normal, Cross(corners[i], corners[i + 1]));
  }
  return normal;
}

/// Whether no triangle of the fan at the first corner lies on another one.
bool HasFan(const std::vector<std::int64_t>& polygon, const double* points)
{
  const std::vector<Vector> corners = GetCorners(polygon, points);
  const Vector normal = FindNormal(corners);
  const double least = -SmallestBend * Dot(normal, normal);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    if (Dot(normal, Cross(corners[i], corners[i + 1])) < least)
    {
      return false;
    }
  }
  return true;
}

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

void FacetedCellSplitter::AddPolygon(
  const std::int64_t* ids, std::size_t size, const double* points)
{
  // A fan at the smallest id: what the cell on the other side of the face does as well.
  std::vector<std::int64_t> polygon(ids, ids + size);
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  if (size > 3 && !HasFan(polygon, points))
  {
    this->ClipEars(polygon, points);
    return;
  }
  for (std::size_t i = 1; i + 1 < size; ++i)
  {
    this->AddTriangle(polygon[0], polygon[i], polygon[i + 1]);
  }
}

void FacetedCellSplitter::AddTriangle(std::int64_t a, std::int64_t b, std::int64_t c)
{
  if (a != b && b != c && c != a)
  {
    this->Triangles.insert(this->Triangles.end(), { a, b, c });
  }
}

void FacetedCellSplitter::ClipEars(std::vector<std::int64_t> polygon, const double* points)
{
  // In the one of both orders in which the cell on the other side sees it, too.
  const bool turned = polygon.back() < polygon[1];
  if (turned)
  {
    std::reverse(polygon.begin() + 1, polygon.end());
  }
  std::vector<Vector> corners = GetCorners(polygon, points);
  const Vector normal = FindNormal(corners);
  const auto area = [&](const Vector& a, const Vector& b, const Vector& c)
  { return Dot(normal, Cross(Subtract(b, a), Subtract(c, a))); };
  const std::size_t first = this->Triangles.size();
  while (corners.size() > 2)
  {
    // The ear that is the least thin: nothing of the polygon is in its triangle.
    const std::size_t n = corners.size();
    std::size_t best = n;
    double bestShape = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      const Vector& a = corners[(i + n - 1) % n];
      const Vector& b = corners[i];
      const Vector& c = corners[(i + 1) % n];
      bool empty = true;
      for (std::size_t k = 2; k + 1 < n && empty; ++k)
      {
        const Vector& p = corners[(i + k) % n];
        empty = area(a, b, p) < 0 || area(b, c, p) < 0 || area(c, a, p) < 0;
      }
      const Vector edge = Subtract(c, a);
      const double shape = area(a, b, c) / Dot(edge, edge);
      if (empty && shape > bestShape)
      {
        best = i;
        bestShape = shape;
      }
    }
    best = best == n ? 0 : best; // what is left has no area
    this->AddTriangle(polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]);
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(best));
  }
  for (std::size_t i = first; turned && i < this->Triangles.size(); i += 3)
  {
    std::swap(this->Triangles[i + 1], this->Triangles[i + 2]);
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

std::vector<FacetedCellSplitter::Plane> FacetedCellSplitter::FindPlanes(const double* points) const
{
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < this->Triangles.size(); i += 3)
  {
    const Vector a = At(points, this->Triangles[i]);
    const Vector normal = Cross(Subtract(At(points, this->Triangles[i + 1]), a),
      Subtract(At(points, this->Triangles[i + 2]), a));
    const double length = std::sqrt(Dot(normal, normal));
    if (length > 0)
    {
      Plane plane;
      for (int k = 0; k < 3; ++k)
      {
        plane.Normal[k] = normal[k] / length;
      }
      // Seen from a corner of the cell, as in SignedVolume.
      const Vector height = Subtract(a, At(points, this->Triangles[0]));
      plane.Height = Dot(height, plane.Normal);
      planes.push_back(plane);
    }
  }
  return planes;
}

bool FacetedCellSplitter::FindMiddle(const double* points, std::vector<double>& weights)
{
  const std::size_t n = this->GetPoints().size();
  weights.assign(n, 1. / static_cast<double>(n));
  if (n == 0)
  {
    return false;
  }
  const Vector origin = At(points, this->Triangles[0]);
  Vector mean = { 0, 0, 0 };
  double extent = 0;
  for (const std::int64_t id : this->Points)
  {
    const Vector p = Subtract(At(points, id), origin);
    mean = Add(mean, p);
    extent = std::max(extent, std::sqrt(Dot(p, p)));
  }
  for (double& c : mean)
  {
    c /= static_cast<double>(n);
  }
  const std::vector<Plane> planes = this->FindPlanes(points);
  // The distance to the plane that the point is the least below.
  const auto findNearest = [&planes](const Vector& x, const Plane*& nearest)
  {
    double least = std::numeric_limits<double>::max();
    for (const Plane& plane : planes)
    {
      const double below = plane.Height - Dot(x, plane.Normal);
      if (!(below >= least))
      {
        least = below;
        nearest = &plane;
      }
    }
    return least;
  };
  const Plane* nearest = nullptr;
  if (findNearest(mean, nearest) > SmallestClearanceOfMean * extent)
  {
    return true;
  }
  // Moves below one plane after the other (relaxation, Agmon 1954), by distances that leave as much
  // room as there is.
  for (double clearance = LargestClearance * extent; clearance >= SmallestClearance * extent;
       clearance /= 2)
  {
    Vector x = mean;
    for (int step = 0; step < MaximumSteps; ++step)
    {
      const double below = findNearest(x, nearest);
      if (!(below < clearance))
      {
        weights.assign(n, 0);
        const Vector place = Add(x, origin);
        for (std::size_t corner = 0; corner < n; ++corner)
        {
          this->AddWeights(points, place, corner, 1. / static_cast<double>(n), weights);
        }
        return true;
      }
      for (int k = 0; k < 3; ++k)
      {
        x[k] += OverRelaxation * (below - clearance) * nearest->Normal[k];
      }
    }
  }
  return false;
}

/// A point that sees all faces is between any corner and a place on a face behind it: adds a share
/// of the weights that this gives.
void FacetedCellSplitter::AddWeights(const double* points, const Vector& x, std::size_t corner,
  double share, std::vector<double>& weights) const
{
  const Vector back = Subtract(x, At(points, this->Points[corner]));
  Vector found = { 0, 0, 0 };
  double best = -std::numeric_limits<double>::max();
  std::size_t triangle = 0;
  for (std::size_t i = 0; i < this->Triangles.size(); i += 3)
  {
    // back = u . (corners of the triangle - x)
    Vector edges[3];
    for (int k = 0; k < 3; ++k)
    {
      edges[k] = Subtract(At(points, this->Triangles[i + k]), x);
    }
    const double volume = Dot(edges[0], Cross(edges[1], edges[2]));
    const Vector u = { Dot(back, Cross(edges[1], edges[2])) / volume,
      Dot(back, Cross(edges[2], edges[0])) / volume,
      Dot(back, Cross(edges[0], edges[1])) / volume };
    const double least = std::min({ u[0], u[1], u[2] }) / (u[0] + u[1] + u[2]);
    if (u[0] + u[1] + u[2] > 0 && least > best)
    {
      best = least;
      found = u;
      triangle = i;
    }
  }
  const double sum = std::max(found[0], 0.) + std::max(found[1], 0.) + std::max(found[2], 0.);
  weights[corner] += share / (1 + sum);
  for (int k = 0; k < 3; ++k)
  {
    const auto at = std::lower_bound(this->Points.begin(), this->Points.end(),
      this->Triangles[triangle + static_cast<std::size_t>(k)]);
    weights[static_cast<std::size_t>(at - this->Points.begin())] +=
      share * std::max(found[k], 0.) / (1 + sum);
  }
}

bool FacetedCellSplitter::CutToStar(
  const double* points, std::vector<std::int64_t>& tets, std::vector<double>& weights)
{
  const std::vector<std::int64_t> ids = this->GetPoints();
  std::vector<double> corners;
  for (const std::int64_t id : ids)
  {
    corners.insert(corners.end(), points + 3 * id, points + 3 * id + 3);
  }
  std::vector<std::int32_t> triangles;
  for (const std::int64_t id : this->Triangles)
  {
    const auto at = std::lower_bound(ids.begin(), ids.end(), id);
    triangles.push_back(static_cast<std::int32_t>(at - ids.begin()));
  }
  const std::vector<std::int64_t> whole = this->Triangles;
  const auto isDone = [&](const std::vector<std::int32_t>& rest)
  {
    this->Triangles.clear();
    for (const std::int32_t corner : rest)
    {
      this->Triangles.push_back(ids[static_cast<std::size_t>(corner)]);
    }
    return this->FindMiddle(points, weights);
  };
  // Without a new point if it can be.
  PolyhedronFilling filling;
  if (!FillPolyhedron(corners, triangles, {}, filling) &&
    !FillPolyhedron(corners, triangles, isDone, filling))
  {
    this->Triangles = whole;
    return false;
  }
  if (filling.Rest.empty())
  {
    this->Triangles.clear();
  }
  for (const std::int32_t corner : filling.Cells)
  {
    tets.push_back(ids[static_cast<std::size_t>(corner)]);
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
