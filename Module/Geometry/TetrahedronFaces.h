// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TetrahedronFaces_h
#define tetralux_TetrahedronFaces_h

namespace tetralux
{

/// The corners of a tetrahedron's faces; face i is opposite to point i. Of a tetrahedron of
/// positive volume they run counter-clockwise as seen from outside: GetOrientation(face, point) is
/// negative for the point inside.
constexpr int OutwardFaces[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

} // namespace tetralux

#endif
