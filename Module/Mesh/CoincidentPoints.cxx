// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CoincidentPoints.h"

#include "Base/DisjointSets.h"
#include "Base/RadixSort.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace tetralux
{
namespace
{

/// Edge of a box of the grid that points are sorted into, in tolerances: so large that most points
/// are near to no side of their box, and so small that few are in one.
constexpr double BoxSize = 16;

/// Three whole numbers as one. Boxes that share a number by chance cost comparisons, no more.
std::uint32_t Mix(const std::array<std::int64_t, 3>& numbers)
{
  std::uint64_t mixed = 0;
  for (const std::int64_t number : numbers)
  {
    mixed = (mixed ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15u;
    mixed ^= mixed >> 29;
  }
  return static_cast<std::uint32_t>(mixed >> 32);
}

/// Points sorted by the boxes that they are in or within the tolerance of.
class BoxedPoints
{
public:
  /// tolerance: 0 for points that are the same exactly.
  BoxedPoints(
    const TetrahedralMesh& mesh, const std::vector<std::int32_t>& points, double tolerance)
  {
    for (const std::int32_t point : points)
    {
      const double* x = &mesh.Points[std::size_t{ 3 } * point];
      if (tolerance > 0)
      {
        this->AddNear(point, x, BoxSize * tolerance);
      }
      else
      {
        this->AddExact(point, x);
      }
    }
    std::vector<KeyedItem> buffer;
    SortByKey(this->Entries, buffer);
  }

  /// Calls visit(i, j) for entries of one box, i before j, until it returns false for i.
  template <class Visit>
  void ForEachPair(const Visit& visit) const
  {
    const std::size_t count = this->Entries.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t j = i + 1; j < count && this->Entries[j].Key == this->Entries[i].Key; ++j)
      {
        if (!visit(this->Entries[i].Item, this->Entries[j].Item))
        {
          break;
        }
      }
    }
  }

private:
  void AddExact(std::int32_t point, const double* x)
  {
    std::array<std::int64_t, 3> bits;
    for (int a = 0; a < 3; ++a)
    {
      const double number = x[a] + 0.; // no -0, which equals 0
      std::memcpy(&bits[a], &number, sizeof number);
    }
    this->Entries.push_back({ Mix(bits), point });
  }

  void AddNear(std::int32_t point, const double* x, double size)
  {
    std::array<std::int64_t, 3> box;
    std::array<std::int64_t, 3> beside; // the box beside it along an axis, or the same one
    for (int a = 0; a < 3; ++a)
    {
      const double place = x[a] / size;
      const double below = std::floor(place);
      const double rest = place - below;
      box[a] = static_cast<std::int64_t>(below);
      // A little more than the tolerance, for the rounding of the place.
      constexpr double Reach = 1.5 / BoxSize;
      beside[a] = rest < Reach ? box[a] - 1 : rest > 1 - Reach ? box[a] + 1 : box[a];
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      std::array<std::int64_t, 3> other = box;
      bool isNew = true;
      for (int a = 0; a < 3; ++a)
      {
        if ((corner >> a & 1) != 0)
        {
          other[a] = beside[a];
          isNew = isNew && beside[a] != box[a];
        }
      }
      if (isNew)
      {
        this->Entries.push_back({ Mix(other), point });
      }
    }
  }

  std::vector<KeyedItem> Entries;
};

bool AreTogether(const TetrahedralMesh& mesh, std::int32_t a, std::int32_t b, double tolerance)
{
  const double* x = &mesh.Points[std::size_t{ 3 } * a];
  const double* y = &mesh.Points[std::size_t{ 3 } * b];
  return std::abs(x[0] - y[0]) <= tolerance && std::abs(x[1] - y[1]) <= tolerance &&
    std::abs(x[2] - y[2]) <= tolerance;
}

/// Sets of points that are together.
DisjointSets Unite(
  const TetrahedralMesh& mesh, const std::vector<std::int32_t>& points, double tolerance)
{
  DisjointSets sets(mesh.GetNumberOfPoints());
  BoxedPoints(mesh, points, tolerance)
    .ForEachPair(
      [&](std::int32_t a, std::int32_t b)
      {
        if (!AreTogether(mesh, a, b, tolerance))
        {
          return true;
        }
        sets.Unite(a, b);
        // Where both are the same exactly, the other one goes on with all that is near to both.
        return !AreTogether(mesh, a, b, 0);
      });
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
  double unit = 0; // the largest coordinate
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
  DisjointSets sets = Unite(mesh, points, tolerance * unit);
  const auto isAlone = [&sets](std::int32_t point) { return sets.Find(point) == point; };
  if (std::all_of(points.begin(), points.end(), isAlone))
  {
    return result;
  }
  result.Distance = tolerance * unit;
  if (tolerance > 0 && AnyCellShrinks(mesh, sets))
  {
    result.Distance = 0;
    sets = Unite(mesh, points, 0);
  }

  const auto originalOf = [&mesh](std::int32_t point) -> std::int64_t
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
