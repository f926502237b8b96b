// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Isopolygon_h
#define tetralux_Isopolygon_h

// The polygon in which a surface of constant scalar crosses a tetrahedron (Wald et al. 2007,
// section 4.1).

#include <cstdint>

namespace tetralux
{

/// A triangle or a quadrilateral; of a triangle the last corner is there twice. Corners follow each
/// other around it, in any direction.
struct Isopolygon
{
  double X[4], Y[4], Z[4]; ///< of the corners, in the mesh's frame
  float Shares[4];         ///< where the corners are, from the first to the last end of their edges
  std::int32_t Cell;
  std::int32_t Surface; ///< index of its value
  std::int32_t Case;    ///< bit i: the scalar at point i of the cell is at least the value
};

/// The edges of a cell that a surface crosses, as pairs of corners of the cell, around the polygon.
struct IsopolygonCase
{
  int Count; ///< 0, 3 or 4; of 3 the last edge is there twice
  std::int8_t Edges[4][2];
};

/// For each Isopolygon::Case. The first corner of an edge is the lower one.
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

/// Makes the polygon of a cell, whose points have ascending ids, so that cells that share an edge
/// compute the same bits for the corner on it: from the lower id to the higher one. corners: points
/// of the cell. scalars: finite. Returns whether there is one: some scalars are below the value and
/// some are not. Thus a surface separates points of at least the value from those below it; a cell
/// all of whose points have the value has no polygon, and a face of such points has one where the
/// fourth point of a cell is below.
inline bool MakeIsopolygon(
  const double* const (&corners)[4], const double (&scalars)[4], double value, Isopolygon& polygon)
{
  const int mask = (scalars[0] >= value) + 2 * (scalars[1] >= value) + 4 * (scalars[2] >= value) +
    8 * (scalars[3] >= value);
  const IsopolygonCase& entry = IsopolygonCases[mask];
  if (entry.Count == 0)
  {
    return false;
  }
  polygon.Case = mask;
  for (int i = 0; i < 4; ++i)
  {
    const int a = entry.Edges[i][0];
    const int b = entry.Edges[i][1];
    // Halves, since a difference of large scalars may overflow.
    const double share =
      (0.5 * value - 0.5 * scalars[a]) / (0.5 * scalars[b] - 0.5 * scalars[a]);
    const double* p = corners[a];
    const double* q = corners[b];
    // At a point of the mesh the corner is that point, whichever edge it is on.
    polygon.X[i] = share == 1 ? q[0] : p[0] + share * (q[0] - p[0]);
    polygon.Y[i] = share == 1 ? q[1] : p[1] + share * (q[1] - p[1]);
    polygon.Z[i] = share == 1 ? q[2] : p[2] + share * (q[2] - p[2]);
    polygon.Shares[i] = static_cast<float>(share);
  }
  return true;
}

} // namespace tetralux

#endif
