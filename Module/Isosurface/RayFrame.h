// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayFrame_h
#define tetralux_RayFrame_h

// Coordinates in which rays of a common origin, or of a common direction, are points of a plane.

#include "TetraluxCoreModule.h"
#include "View/RayGrid.h"

namespace tetralux
{

/// Where the coordinates of a mesh are (x - Center) / Radius.
struct MeshFrame
{
  double Center[3] = { 0, 0, 0 };
  double Radius = 1;
};

/// A point of a MeshFrame has the coordinates X, Y and depth, rows of an affine 3 x 4 matrix. The
/// ray (u, v) is where X = u and Y = v if all rays are parallel, else where X = u depth and Y = v
/// depth, and depth is positive.
///
/// The key of a point orders points along a ray: 1 / depth, or minus the depth of parallel rays. A
/// larger key is nearer. On a plane the key is linear in u and v, for both kinds of rays.
struct RayFrame
{
  bool Parallel = false;
  double Rows[3][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } };

  /// By how much X and Y are less than those of the way back: rays pass edges as if they were
  /// displaced by it, but points of planes are found where rays are.
  double Shift[2] = { 0, 0 };

  /// The way back: X Axes[0] + Y Axes[1] + depth Axes[2] + Origin.
  ///@{
  double Axes[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  double Origin[3] = { 0, 0, 0 };
  ///@}
};

/// The frame of a picture's rays: u and v count pixels, and depths are multiples of
/// RayGrid::Direction. Throws std::invalid_argument, with one line, if the rays share neither
/// origin nor direction, or if they lie in a plane.
TETRALUXCORE_EXPORT RayFrame MakeRayFrame(const RayGrid& grid, const MeshFrame& mesh);

/// The frame of rays in a direction that is not 0. Depths are multiples of it.
TETRALUXCORE_EXPORT RayFrame MakeParallelFrame(const double (&direction)[3]);

/// The frame of rays from an origin whose largest component is along an axis, 0..2, towards its
/// positive or negative side: u and v are -1..1, depths are lengths along the axis.
TETRALUXCORE_EXPORT RayFrame MakeAxisFrame(const double (&origin)[3], int axis, bool positive);

} // namespace tetralux

#endif
