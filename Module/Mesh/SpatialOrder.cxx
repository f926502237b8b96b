// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SpatialOrder.h"

#include "Base/CountingSort.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tetralux
{
namespace
{

/// Bits of a coordinate on the curve: three of them fill a 64-bit key, and a mesh whose smallest
/// cell is 1e-6 of its size still has its cells told apart.
constexpr int BitsPerAxis = 21;

/// Moves bit i to bit 3 * i.
std::uint64_t Spread(std::uint64_t bits)
{
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

/// Where a grid cell lies on Hilbert's curve (Skilling, Programming the Hilbert curve, 2004).
std::uint64_t GetHilbertKey(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  for (std::uint32_t bit = 1u << (BitsPerAxis - 1); bit > 1; bit >>= 1)
  {
    // Where an axis has the bit, its lower bits invert those of x; where not, both exchange them.
    const auto turn = [&x, bit](std::uint32_t& axis)
    {
      const std::uint32_t isSet = axis & bit ? bit - 1 : 0;
      const std::uint32_t exchanged = (x ^ axis) & ((bit - 1) ^ isSet);
      x ^= isSet | exchanged;
      axis ^= exchanged;
    };
    x ^= x & bit ? bit - 1 : 0;
    turn(y);
    turn(z);
  }
  y ^= x;
  z ^= y;
  // From Gray code: each bit of all axes is inverted where the bits of z above it have odd parity.
  std::uint32_t parity = z >> 1;
  for (int shift = 1; shift < BitsPerAxis; shift *= 2)
  {
    parity ^= parity >> shift;
  }
  return Spread(x ^ parity) << 2 | Spread(y ^ parity) << 1 | Spread(z ^ parity);
}

struct KeyedPoint
{
  std::uint64_t Key;
  std::int32_t Point;
};

/// Stable radix sort by Key, least significant digit first; digits that do not vary cost one count.
void SortByKey(std::unique_ptr<KeyedPoint[]>& points, std::int64_t size)
{
  constexpr int digitBits = 8;
  constexpr int numberOfDigits = 1 << digitBits;
  const int numberOfParts = omp_get_max_threads();
  auto sorted = NewArray<KeyedPoint>(size);
  const auto next = NewArray<std::int64_t[numberOfDigits]>(numberOfParts);
  for (int shift = 0; shift < 3 * BitsPerAxis; shift += digitBits)
  {
    const auto digitOf = [shift](const KeyedPoint& point)
    { return point.Key >> shift & (numberOfDigits - 1); };
    ForEachPart(numberOfParts, size,
      [&](int part, std::int64_t begin, std::int64_t end)
      {
        std::fill_n(next[part], numberOfDigits, 0);
        for (std::int64_t i = begin; i < end; ++i)
        {
          ++next[part][digitOf(points[i])];
        }
      });
    std::int64_t position = 0;
    for (int digit = 0; digit < numberOfDigits; ++digit)
    {
      for (int part = 0; part < numberOfParts; ++part)
      {
        position += std::exchange(next[part][digit], position);
      }
    }
    ForEachPart(numberOfParts, size,
      [&](int part, std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          sorted[next[part][digitOf(points[i])]++] = points[i];
        }
      });
    std::swap(points, sorted);
  }
}

/// Takes coordinates to the grid of the curve: a cube around the points, so that distances count
/// alike along all axes.
class CurveGrid
{
public:
  CurveGrid(const std::vector<double>& points, const std::int32_t* used, std::int64_t numberOfUsed)
  {
    double minimum[3];
    double maximum[3];
    std::fill_n(minimum, 3, std::numeric_limits<double>::infinity());
    std::fill_n(maximum, 3, -std::numeric_limits<double>::infinity());
#pragma omp parallel for schedule(static) reduction(min : minimum) reduction(max : maximum)
    for (std::int64_t i = 0; i < numberOfUsed; ++i)
    {
      const double* point = &points[std::size_t{ 3 } * used[i]];
      for (int axis = 0; axis < 3; ++axis)
      {
        minimum[axis] = std::min(minimum[axis], point[axis]);
        maximum[axis] = std::max(maximum[axis], point[axis]);
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->HalfMinimum[axis] = 0.5 * minimum[axis];
      this->HalfSize = std::max(this->HalfSize, 0.5 * maximum[axis] - 0.5 * minimum[axis]);
    }
  }

  std::uint64_t GetKey(const double* point) const
  {
    std::uint32_t cell[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      // Halves, so that the size of the largest possible mesh does not overflow.
      const double relative = (0.5 * point[axis] - this->HalfMinimum[axis]) / this->HalfSize;
      cell[axis] = static_cast<std::uint32_t>(
        std::min(relative * (1 << BitsPerAxis), (1 << BitsPerAxis) - 1.0));
    }
    return GetHilbertKey(cell[0], cell[1], cell[2]);
  }

private:
  double HalfMinimum[3];
  double HalfSize = std::numeric_limits<double>::min(); ///< never 0, so that GetKey can divide
};

/// The points that cells use, ascending.
std::vector<std::int32_t> FindUsedPoints(const TetrahedralMesh& mesh)
{
  const auto numberOfPoints = static_cast<std::int64_t>(mesh.GetNumberOfPoints());
  const auto numberOfCorners = static_cast<std::int64_t>(mesh.Cells.size());
  const auto isUsed = NewArray<std::uint8_t>(numberOfPoints);
#pragma omp parallel for schedule(static)
  for (std::int64_t point = 0; point < numberOfPoints; ++point)
  {
    isUsed[point] = 0;
  }
#pragma omp parallel for schedule(static)
  for (std::int64_t corner = 0; corner < numberOfCorners; ++corner)
  {
#pragma omp atomic write
    isUsed[mesh.Cells[corner]] = 1;
  }
  std::vector<std::int32_t> used;
  used.reserve(numberOfPoints);
  for (std::int64_t point = 0; point < numberOfPoints; ++point)
  {
    if (isUsed[point] != 0)
    {
      used.push_back(static_cast<std::int32_t>(point));
    }
  }
  return used;
}

/// result[i] = original[order[i]], where an empty original stands for 0, 1, 2, ...
template <class Order>
std::vector<std::int32_t> Compose(
  const std::vector<std::int32_t>& original, std::int64_t size, const Order& order)
{
  std::vector<std::int32_t> result(size);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < size; ++i)
  {
    result[i] = original.empty() ? order(i) : original[order(i)];
  }
  return result;
}

/// Points along the curve. Returns the new id of each old point.
std::unique_ptr<std::int32_t[]> OrderPoints(TetrahedralMesh& mesh)
{
  const std::vector<std::int32_t> used = FindUsedPoints(mesh);
  const auto numberOfUsed = static_cast<std::int64_t>(used.size());
  const CurveGrid grid(mesh.Points, used.data(), numberOfUsed);
  auto order = NewArray<KeyedPoint>(numberOfUsed);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < numberOfUsed; ++i)
  {
    order[i] = { grid.GetKey(&mesh.Points[std::size_t{ 3 } * used[i]]), used[i] };
  }
  SortByKey(order, numberOfUsed);

  auto newIds = NewArray<std::int32_t>(static_cast<std::int64_t>(mesh.GetNumberOfPoints()));
  std::vector<double> points(3 * numberOfUsed);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < numberOfUsed; ++i)
  {
    newIds[order[i].Point] = static_cast<std::int32_t>(i);
    std::copy_n(&mesh.Points[std::size_t{ 3 } * order[i].Point], 3, &points[3 * i]);
  }
  mesh.OriginalPoints =
    Compose(mesh.OriginalPoints, numberOfUsed, [&order](std::int64_t i) { return order[i].Point; });
  mesh.Points = std::move(points);
  return newIds;
}

void SortFour(std::int32_t* points)
{
  const auto order = [points](int i, int j)
  {
    const std::int32_t smaller = std::min(points[i], points[j]);
    points[j] = std::max(points[i], points[j]);
    points[i] = smaller;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
}

/// Cells by their smallest new point, which brings the cells around a point together at a fraction
/// of the cost of a curve through the cells.
void OrderCells(TetrahedralMesh& mesh, const std::int32_t* newIds)
{
  const auto numberOfCells = static_cast<std::int64_t>(mesh.GetNumberOfCells());
#pragma omp parallel for schedule(static)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    std::int32_t* points = &mesh.Cells[4 * cell];
    std::transform(
      points, points + 4, points, [newIds](std::int32_t point) { return newIds[point]; });
    SortFour(points);
  }
  const Buckets order =
    SortIntoBuckets(numberOfCells, static_cast<std::int64_t>(mesh.GetNumberOfPoints()),
      [&mesh](std::int64_t cell) { return mesh.Cells[4 * cell]; });
  std::vector<std::int32_t> cells(4 * numberOfCells);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < numberOfCells; ++i)
  {
    std::copy_n(&mesh.Cells[std::size_t{ 4 } * order.Items[i]], 4, &cells[4 * i]);
  }
  mesh.OriginalCells =
    Compose(mesh.OriginalCells, numberOfCells, [&order](std::int64_t i) { return order.Items[i]; });
  mesh.Cells = std::move(cells);
}

} // namespace

//----------------------------------------------------------------------------
void OrderSpatially(TetrahedralMesh& mesh)
{
  const auto newIds = OrderPoints(mesh);
  OrderCells(mesh, newIds.get());
}

} // namespace tetralux
