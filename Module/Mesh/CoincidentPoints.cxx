// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CoincidentPoints.h"

#include "Base/DisjointSets.h"
#include "Base/RadixSort.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace tetralux
{
namespace
{

/// A direction in which points of lattices do not line up: powers of the inverse of the plastic
/// number.
constexpr double Direction[3] = { 1, 0.7548776662466927, 0.5698402909980532 };
constexpr double DirectionSum = 2.324717957244746;

/// Largest rounding of a place along the direction, relative to the largest coordinate: of three
/// products and two sums.
constexpr double PlaceRounding = 4 * std::numeric_limits<double>::epsilon();

/// Points by where they are along the direction.
struct SortedPoints
{
  std::vector<std::int32_t> Points;
  std::vector<double> Places; ///< in units of the largest coordinate
};

/// Bits whose order as an unsigned integer is that of the numbers.
std::uint64_t GetSortableBits(double value)
{
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  constexpr std::uint64_t Sign = std::uint64_t{ 1 } << 63;
  return (bits & Sign) != 0 ? ~bits : bits | Sign;
}

SortedPoints SortPoints(
  const TetrahedralMesh& mesh, const std::vector<std::int32_t>& points, double unit)
{
  const std::int64_t count = static_cast<std::int64_t>(points.size());
  std::vector<double> places(count);
  std::vector<KeyedItem> order(count);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double* x = &mesh.Points[std::size_t{ 3 } * points[i]];
    places[i] =
      Direction[0] * (x[0] / unit) + Direction[1] * (x[1] / unit) + Direction[2] * (x[2] / unit);
    order[i] = { static_cast<std::uint32_t>(GetSortableBits(places[i])),
      static_cast<std::int32_t>(i) };
  }
  // By the lower half of the bits, then by the upper one.
  std::vector<KeyedItem> buffer;
  SortByKey(order, buffer);
  for (KeyedItem& item : order)
  {
    item.Key = static_cast<std::uint32_t>(GetSortableBits(places[item.Item]) >> 32);
  }
  SortByKey(order, buffer);
  SortedPoints sorted;
  sorted.Points.resize(count);
  sorted.Places.resize(count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    sorted.Points[i] = points[order[i].Item];
    sorted.Places[i] = places[order[i].Item];
  }
  return sorted;
}

bool AreTogether(const TetrahedralMesh& mesh, std::int32_t a, std::int32_t b, double tolerance)
{
  const double* x = &mesh.Points[std::size_t{ 3 } * a];
  const double* y = &mesh.Points[std::size_t{ 3 } * b];
  return std::abs(x[0] - y[0]) <= tolerance && std::abs(x[1] - y[1]) <= tolerance &&
    std::abs(x[2] - y[2]) <= tolerance;
}

/// Sets of points that are together.
DisjointSets Unite(
  const TetrahedralMesh& mesh, const SortedPoints& sorted, double tolerance, double unit)
{
  DisjointSets sets(mesh.GetNumberOfPoints());
  const double reach = DirectionSum * (tolerance + PlaceRounding);
  const std::size_t count = sorted.Points.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t j = i + 1; j < count && sorted.Places[j] - sorted.Places[i] <= reach; ++j)
    {
      if (AreTogether(mesh, sorted.Points[i], sorted.Points[j], tolerance * unit))
      {
        sets.Unite(sorted.Points[i], sorted.Points[j]);
        if (AreTogether(mesh, sorted.Points[i], sorted.Points[j], 0))
        {
          break; // the other one goes on with all that is near to both
        }
      }
    }
  }
  return sets;
}

/// Whether two points of a cell that differ would become one.
bool AnyCellShrinks(const TetrahedralMesh& mesh, DisjointSets& sets)
{
  for (std::size_t cell = 0; cell < mesh.Cells.size(); cell += 4)
  {
    const std::int32_t* points = &mesh.Cells[cell];
    for (int i = 0; i < 3; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        if (points[i] != points[j] && sets.Find(points[i]) == sets.Find(points[j]) &&
          !AreTogether(mesh, points[i], points[j], 0))
        {
          return true;
        }
      }
    }
  }
  return false;
}

} // namespace

CoincidentPoints FindCoincidentPoints(
  const TetrahedralMesh& mesh, Span<const std::int32_t> candidates, double tolerance)
{
  CoincidentPoints result;
  std::vector<std::int32_t> points;
  double unit = std::numeric_limits<double>::min(); // never 0, so that it can divide
  for (const std::int32_t point : candidates)
  {
    const double* x = &mesh.Points[std::size_t{ 3 } * point];
    const double largest = std::max({ std::abs(x[0]), std::abs(x[1]), std::abs(x[2]) });
    if ((mesh.OriginalPoints.empty() || mesh.OriginalPoints[point] >= 0) && std::isfinite(x[0]) &&
      std::isfinite(x[1]) && std::isfinite(x[2]))
    {
      points.push_back(point);
      unit = std::max(unit, largest);
    }
  }
  const SortedPoints sorted = SortPoints(mesh, points, unit);
  DisjointSets sets = Unite(mesh, sorted, tolerance, unit);
  const auto isAlone = [&sets](std::int32_t point) { return sets.Find(point) == point; };
  if (std::all_of(points.begin(), points.end(), isAlone))
  {
    return result;
  }
  result.Distance = tolerance * unit;
  if (tolerance > 0 && AnyCellShrinks(mesh, sets))
  {
    result.Distance = 0;
    sets = Unite(mesh, sorted, 0, unit);
  }

  const auto originalOf = [&mesh](std::int32_t point)
  { return mesh.OriginalPoints.empty() ? point : mesh.OriginalPoints[point]; };
  std::vector<std::int64_t> firsts(
    mesh.GetNumberOfPoints(), std::numeric_limits<std::int64_t>::max());
  for (const std::int32_t point : points)
  {
    std::int64_t& first = firsts[sets.Find(point)];
    first = std::min(first, originalOf(point));
  }
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  for (const std::int32_t point : points)
  {
    const std::int64_t first = firsts[sets.Find(point)];
    if (originalOf(point) != first)
    {
      pairs.emplace_back(originalOf(point), first);
    }
  }
  if (!std::is_sorted(pairs.begin(), pairs.end()))
  {
    std::sort(pairs.begin(), pairs.end());
  }
  for (const auto& [point, first] : pairs)
  {
    result.Points.push_back(point);
    result.Firsts.push_back(first);
  }
  return result;
}

} // namespace tetralux
