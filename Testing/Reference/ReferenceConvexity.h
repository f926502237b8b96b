// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceConvexity_h
#define tetralux_ReferenceConvexity_h

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tetralux
{

/// A mesh with the imaginary cells that make it convex.
struct ConvexifiedMesh
{
  std::vector<double> Points;               ///< with the Steiner points, three coordinates each
  std::vector<std::int32_t> Cells;          ///< of the mesh, four point ids each
  std::vector<std::int32_t> ImaginaryCells; ///< four point ids each
};

/// The sign of the volume of a, b, c, d in VTK's order of a tetrahedron's points: in double
/// precision where that is certain, else in whole numbers of any size.
int GetReferenceSign(const double* a, const double* b, const double* c, const double* d);

/// The first thing that is wrong, in words; empty where nothing is. Imaginary cells must have a
/// positive volume; a face with one may have at most two cells, on both
/// sides of it; a face of one cell must
/// be on the hull, to 1e-12 of the size of the whole; and the volumes of mesh and imaginary cells
/// must add up to that of the hull, to 1e-9.
/// Points at the same place count as one. minimumSteinerPoint: the id from which on points must be
/// in no cell of the mesh.
std::string CheckConvexity(const ConvexifiedMesh& mesh, std::int32_t minimumSteinerPoint);

/// Random straight lines, and on how many of them a walk from cell to cell goes through the same
/// faces of the mesh's boundary, in the same order, as all boundary faces tested one by one.
struct RayAgreement
{
  std::int64_t Rays = 0;
  std::int64_t Agreeing = 0;
  std::int64_t Crossings = 0; ///< of all rays with the boundary
};
RayAgreement CompareRays(
  const ConvexifiedMesh& mesh, std::int64_t numberOfRays, std::uint64_t seed);

} // namespace tetralux

#endif
