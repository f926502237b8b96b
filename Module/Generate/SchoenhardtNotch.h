// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SchoenhardtNotch_h
#define tetralux_SchoenhardtNotch_h

#include "Mesh/TetrahedralMesh.h"

namespace tetralux
{

/// Adds the box -1 <= x, y <= 1, -0.5 <= z <= 1 without Schoenhardt's polyhedron, which is open at
/// the top of the box: a notch that no tetrahedra can fill without points of their own
/// (Schoenhardt, Ueber die Zerlegung von Dreieckspolyedern in Tetraeder, 1928).
///
/// The polyhedron is a prism, 0 <= z <= 1, over an equilateral triangle of circumradius 0.6 whose
/// first corner is on the x axis; its top is turned counterclockwise by twist, in radians, more
/// than 0 and less than pi / 3, and its sides are folded inwards along the longer diagonals.
///
/// subdivisions: parts of each edge of the coarsest possible mesh, at least 1.
void AddSchoenhardtNotch(double twist, int subdivisions, TetrahedralMesh& mesh);

} // namespace tetralux

#endif
