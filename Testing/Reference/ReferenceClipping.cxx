// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceClipping.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace reference
{
namespace
{

/// A point as a ray sees it. U and V are rounded to double, so that the product of two is known
/// exactly; every cell at the point rounds alike.
struct SeenPoint
{
  double U;
  double V;
  Real T; ///< distance along the ray, in the sheared frame
};

SeenPoint See(const Ray& ray, const double* point)
{
  const Real depth = point[ray.Axes[2]] - ray.Origin[ray.Axes[2]];
  SeenPoint seen;
  seen.U = static_cast<double>(point[ray.Axes[0]] - ray.Origin[ray.Axes[0]] - ray.Shear[0] * depth);
  seen.V = static_cast<double>(point[ray.Axes[1]] - ray.Origin[ray.Axes[1]] - ray.Shear[1] * depth);
  seen.T = depth / ray.Direction[ray.Axes[2]];
  return seen;
}

/// On which side of the line from a to b the ray passes: the exact sign of U_a V_b - U_b V_a. Where
/// that is zero, the sign for a ray displaced by (e, e^2) for infinitesimal e > 0; still zero only
/// where both points are seen as one.
int EdgeSide(const SeenPoint& a, const SeenPoint& b)
{
  const double p = a.U * b.V;
  const double q = b.U * a.V;
  if (p != q)
  {
    return p > q ? 1 : -1; // rounding is monotonic
  }
  const double pRest = std::fma(a.U, b.V, -p);
  const double qRest = std::fma(b.U, a.V, -q);
  if (pRest != qRest)
  {
    return pRest > qRest ? 1 : -1;
  }
  if (a.V != b.V)
  {
    return a.V > b.V ? 1 : -1;
  }
  if (a.U != b.U)
  {
    return b.U > a.U ? 1 : -1;
  }
  return 0;
}

/// Twice the area between the ray and the edge from a to b, without the sign.
double EdgeArea(const SeenPoint& a, const SeenPoint& b)
{
  const double p = a.U * b.V;
  const double q = b.U * a.V;
  return std::abs((p - q) + (std::fma(a.U, b.V, -p) - std::fma(b.U, a.V, -q)));
}

} // namespace

Ray MakeRay(const RayGrid& grid, int i, int j)
{
  Ray ray;
  static_cast<ReferenceRay&>(ray) = MakeReferenceRay(grid, i, j);

  int largest = 0;
  for (int axis = 1; axis < 3; ++axis)
  {
    if (std::abs(ray.Direction[axis]) > std::abs(ray.Direction[largest]))
    {
      largest = axis;
    }
  }
  ray.Axes = { (largest + 1) % 3, (largest + 2) % 3, largest };
  const Real main = ray.Direction[largest];
  ray.Shear = { ray.Direction[ray.Axes[0]] / main, ray.Direction[ray.Axes[1]] / main };
  ray.Valid = std::isfinite(ray.Shear[0]) && std::isfinite(ray.Shear[1]) &&
    std::isfinite(Dot(ray.Origin, ray.Origin));
  return ray;
}

bool GetCell(const ReferenceMesh& mesh, std::size_t id, Cell& cell)
{
  const std::int64_t numberOfPoints = static_cast<std::int64_t>(mesh.Points.size() / 3);
  std::copy_n(mesh.Cells.data() + 4 * id, 4, cell.Points);
  std::sort(cell.Points, cell.Points + 4);
  for (int i = 0; i < 4; ++i)
  {
    const std::int32_t point = cell.Points[i];
    if (point < 0 || point >= numberOfPoints)
    {
      return false;
    }
    const double* x = mesh.Points.data() + 3 * static_cast<std::size_t>(point);
    const double scalar = mesh.Scalars[mesh.CellScalars ? id : static_cast<std::size_t>(point)];
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]) ||
      !std::isfinite(scalar))
    {
      return false;
    }
    cell.Coordinates[i] = x;
    cell.Scalars[i] = scalar;
  }
  return true;
}

bool ClipByCell(const Ray& ray, const Cell& cell, Segment& segment)
{
  const double* const* points = cell.Coordinates;
  const double* scalars = cell.Scalars;
  SeenPoint seen[4];
  for (int i = 0; i < 4; ++i)
  {
    seen[i] = See(ray, points[i]);
  }
  const auto allBeside = [&seen](double SeenPoint::*coordinate)
  {
    const double a = seen[0].*coordinate;
    const double b = seen[1].*coordinate;
    const double c = seen[2].*coordinate;
    const double d = seen[3].*coordinate;
    return (a > 0 && b > 0 && c > 0 && d > 0) || (a < 0 && b < 0 && c < 0 && d < 0);
  };
  if (allBeside(&SeenPoint::U) || allBeside(&SeenPoint::V))
  {
    return false;
  }

  static constexpr int Faces[4][3] = { { 1, 2, 3 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 2 } };
  int side[4][4];
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      side[i][j] = EdgeSide(seen[i], seen[j]);
      side[j][i] = -side[i][j];
    }
  }
  Real t[2];
  double s[2];
  CellPassage::Face passed[2];
  int found = 0;
  for (const auto& face : Faces)
  {
    const int first = side[face[0]][face[1]];
    if (first == 0 || first != side[face[1]][face[2]] || first != side[face[2]][face[0]])
    {
      continue;
    }
    const double area[3] = { EdgeArea(seen[face[1]], seen[face[2]]),
      EdgeArea(seen[face[2]], seen[face[0]]), EdgeArea(seen[face[0]], seen[face[1]]) };
    const double sum = area[0] + area[1] + area[2];
    if (found == 2 || !(sum > 0))
    {
      return false; // only where products underflow
    }
    t[found] = 0;
    s[found] = scalars[face[0]]; // by differences, so that a constant stays exactly what it is
    for (int i = 0; i < 3; ++i)
    {
      t[found] += area[i] * seen[face[i]].T;
      s[found] += area[i] / sum * (scalars[face[i]] - scalars[face[0]]);
    }
    t[found] /= sum;
    passed[found] = { cell.Points[face[0]], cell.Points[face[1]], cell.Points[face[2]] };
    ++found;
  }
  if (found != 2)
  {
    return false;
  }
  const int begin = t[0] < t[1] ? 0 : 1;
  segment.Begin = t[begin];
  segment.Length = static_cast<double>(t[1 - begin] - t[begin]);
  segment.BeginScalar = s[begin];
  segment.EndScalar = s[1 - begin];
  segment.Passage = { { passed[begin], passed[1 - begin] }, { t[begin], t[1 - begin] } };
  return true;
}

} // namespace reference
} // namespace tetralux
