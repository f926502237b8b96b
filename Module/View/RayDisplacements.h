// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayDisplacements_h
#define tetralux_RayDisplacements_h

namespace tetralux
{

/// Where a ray is displaced to, the one after the other, that passes an edge of the boundary so
/// closely that rounding may decide on which side; in units of that rounding, across the ray, with
/// any two axes, see RayAcross.h.
///
/// Why: faces that touch but do not share their points, where cells meet cells of half their size,
/// are rounded each on its own. A ray through their edges might go through both, or through none.
/// At least as far from every edge as rounding reaches it goes through one.
///
/// The first ones are on the side of edges on which rays through edges are taken to pass, by
/// ShiftSlope: one for edges along the axes and diagonals of a lattice that is seen along an axis,
/// one for lines that go two down to the right and one across, too, and one for those that go
/// three. Of the others each is farther than the one before, in a direction of its own, since a ray
/// through a point has edges in many directions beside it; an edge bars less of the farther ones.
/// The last one is still far less than a pixel.
constexpr int NumberOfRayDisplacements = 14;
constexpr double RayDisplacements[NumberOfRayDisplacements][2] = { { 3.4, -1.3 }, { 5.9, -1.3 },
  { 7, -3.8 }, { -4.5, 1.5 }, { 3, -6 }, { 2, 7.5 }, { -7.5, -5 }, { 10, -2 }, { -6.5, 9 },
  { -1.5, -12 }, { 7.5, 10.5 }, { 11.5, -8 }, { -15, 2.5 }, { 3, -15.5 } };

/// Above any displacement: radii of the mesh.
constexpr double FarthestDisplacement = 1. / (1 << 18);

} // namespace tetralux

#endif
