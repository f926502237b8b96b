// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PocketFront_h
#define tetralux_PocketFront_h

#include "Convexify/BoundarySurface.h"

#include <vector>

namespace tetralux
{

/// The triangles around a pocket of empty space, which is on the positive side of each.
using Front = std::vector<Triangle>;

/// Splits triangles that bound empty space into the fronts of its parts, which have at most points
/// and edges in common. A part with islands in it has all of its triangles in one front. Returns
/// nothing where the triangles bound no space: an edge whose two directions don't alternate.
std::vector<Front> SplitFront(const ExactPoints& points, const Front& triangles);

} // namespace tetralux

#endif
