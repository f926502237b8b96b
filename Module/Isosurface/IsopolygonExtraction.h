// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsopolygonExtraction_h
#define tetralux_IsopolygonExtraction_h

// Makes isopolygons of cells (Wald et al. 2007, section 4.1).

#include "Isosurface/Isopolygon.h"
#include "Simd/Lanes.h"

namespace tetralux
{

/// The edges of a cell that a surface crosses, as pairs of corners of the cell, around the polygon.
struct IsopolygonCase
{
  int Count; ///< 0, 3 or 4; of 3 the last edge is there twice
  std::uint8_t Edges[4][2];
};

/// For each set of corners whose scalars are at least the value: bit i for corner i. The first
/// corner of an edge is the lower one.
constexpr IsopolygonCase IsopolygonCases[16] = {
  { 0, {} },
  { 3, { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 0, 3 } } },
  { 3, { { 0, 1 }, { 1, 2 }, { 1, 3 }, { 1, 3 } } },
  { 4, { { 0, 2 }, { 0, 3 }, { 1, 3 }, { 1, 2 } } },
  { 3, { { 0, 2 }, { 1, 2 }, { 2, 3 }, { 2, 3 } } },
  { 4, { { 0, 1 }, { 0, 3 }, { 2, 3 }, { 1, 2 } } },
  { 4, { { 0, 1 }, { 1, 3 }, { 2, 3 }, { 0, 2 } } },
  { 3, { { 0, 3 }, { 1, 3 }, { 2, 3 }, { 2, 3 } } },
  { 3, { { 0, 3 }, { 1, 3 }, { 2, 3 }, { 2, 3 } } },
  { 4, { { 0, 1 }, { 1, 3 }, { 2, 3 }, { 0, 2 } } },
  { 4, { { 0, 1 }, { 0, 3 }, { 2, 3 }, { 1, 2 } } },
  { 3, { { 0, 2 }, { 1, 2 }, { 2, 3 }, { 2, 3 } } },
  { 4, { { 0, 2 }, { 0, 3 }, { 1, 3 }, { 1, 2 } } },
  { 3, { { 0, 1 }, { 1, 2 }, { 1, 3 }, { 1, 3 } } },
  { 3, { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 0, 3 } } },
  { 0, {} },
};

namespace TETRALUX_ISA
{
namespace
{

/// A cell with the points and scalars of its corners.
struct IsopolygonCell
{
  double Corners[4][3]; ///< in the mesh's frame
  double Scalars[4];
};

/// Makes the polygon of a cell. Its points have ascending ids, so that cells that share an edge
/// compute the same bits for the corner on it: from the lower id to the higher one. Returns whether
/// there is one: some scalars are below the value and some are not. Thus a surface separates points
/// of at least the value from those below it. A cell all of whose points have the value has no
/// polygon; a face of such points is one of the cell whose fourth point is below.
TETRALUX_INLINE bool MakeIsopolygon(const IsopolygonCell& cell, double value, Isopolygon& polygon)
{
  const double(&s)[4] = cell.Scalars;
  const int mask =
    (s[0] >= value) + 2 * (s[1] >= value) + 4 * (s[2] >= value) + 8 * (s[3] >= value);
  const IsopolygonCase& entry = IsopolygonCases[mask];
  if (entry.Count == 0)
  {
    return false;
  }
  for (int i = 0; i < 4; ++i)
  {
    const int a = entry.Edges[i][0];
    const int b = entry.Edges[i][1];
    // Half of them where a difference may overflow; all where a half may underflow.
    constexpr double Large = 1e300;
    const double unit = s[a] > Large || s[a] < -Large || s[b] > Large || s[b] < -Large ? 0.5 : 1;
    const double share = (unit * value - unit * s[a]) / (unit * s[b] - unit * s[a]);
    const double* p = cell.Corners[a];
    const double* q = cell.Corners[b];
    // At a point of the mesh the corner is that point, whichever edge it is on.
    polygon.X[i] = share == 1 ? q[0] : p[0] + share * (q[0] - p[0]);
    polygon.Y[i] = share == 1 ? q[1] : p[1] + share * (q[1] - p[1]);
    polygon.Z[i] = share == 1 ? q[2] : p[2] + share * (q[2] - p[2]);
  }
  return true;
}

/// Calls visit with each polygon of a cell, ascending in value. A cell with a scalar that is not
/// finite has none.
template <class Visit>
TETRALUX_INLINE void ForEachIsopolygon(
  const IsopolygonSource& source, std::int32_t id, const Visit& visit)
{
  const std::int32_t* points = source.Cells + 4 * static_cast<std::int64_t>(id);
  IsopolygonCell cell;
  double least = source.Scalars[points[0]];
  double largest = least;
  double sum = 0;
  for (int i = 0; i < 4; ++i)
  {
    const double scalar = source.Scalars[points[i]];
    cell.Scalars[i] = scalar;
    least = scalar < least ? scalar : least;
    largest = scalar > largest ? scalar : largest;
    sum += scalar - scalar; // 0 of what is finite
  }
  // The least value above the least scalar.
  int low = 0;
  int high = source.NumberOfValues;
  while (low < high)
  {
    const int middle = (low + high) / 2;
    const bool below = source.Values[middle] <= least;
    low = below ? middle + 1 : low;
    high = below ? high : middle;
  }
  if (!(sum == 0) || low == source.NumberOfValues || source.Values[low] > largest)
  {
    return;
  }
  for (int i = 0; i < 4; ++i)
  {
    const double* point = source.Points + 3 * static_cast<std::int64_t>(points[i]);
    for (int a = 0; a < 3; ++a)
    {
      cell.Corners[i][a] = (point[a] - source.Frame.Center[a]) / source.Frame.Radius;
    }
  }
  Isopolygon polygon;
  polygon.Cell = id;
  for (int v = low; v < source.NumberOfValues && source.Values[v] <= largest; ++v)
  {
    if (MakeIsopolygon(cell, source.Values[v], polygon))
    {
      polygon.Surface = v;
      visit(polygon);
    }
  }
}

/// What a ray hit, where polygons are made of cells.
TETRALUX_INLINE std::int64_t PackHit(std::int32_t cell, std::int32_t surface)
{
  return (static_cast<std::int64_t>(cell) << 32) | surface;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
