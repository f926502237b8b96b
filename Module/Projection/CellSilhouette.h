// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellSilhouette_h
#define tetralux_CellSilhouette_h

// What is drawn so that all pixels are covered whose rays meet a cell.

#include "Projection/LocalScreen.h"
#include "Projection/ScreenFrame.h"

namespace tetralux
{

struct Place
{
  double X, Y;
};

/// The silhouette by the classes of Kraus et al. 2004, figure 1, moved outwards by a margin. front:
/// of each face, opposite to the point of that number. Returns its number of corners, in the order
/// of a fan, 0 where it is of no class or has too sharp a corner.
int FindSilhouette(
  const ScreenPoint* const points[4], const bool front[4], double margin, Place corners[4]);

/// A rectangle around all points, along the longest edge between them, moved outwards.
void FindRectangle(const ScreenPoint* const points[4], double margin, Place corners[4]);

/// A rectangle along the edges of the picture, moved outwards.
void FindRectangle(const ScreenBox& box, double margin, Place corners[4]);

} // namespace tetralux

#endif
