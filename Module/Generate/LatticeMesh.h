// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LatticeMesh_h
#define tetralux_LatticeMesh_h

#include "Mesh/TetrahedralMesh.h"

#include <array>
#include <functional>

namespace tetralux
{

/// A structured grid of hexahedra, some of them left out, in any shape.
struct Lattice
{
  std::array<int, 3> Cells; ///< hexahedra along each axis

  /// Whether the last layer of cells along an axis is joined to the first one.
  std::array<bool, 3> IsPeriodic = { false, false, false };

  /// Whether hexahedron (i, j, k) is part of the mesh; nothing set: all are.
  std::function<bool(int i, int j, int k)> IsKept;

  /// Where lattice point (i, j, k) lies. Must turn the lattice neither inside out nor over.
  std::function<std::array<double, 3>(int i, int j, int k)> Place;
};

/// Adds the tetrahedra of the lattice to the mesh, and the points that they use: five for each
/// hexahedron, or six where the period of an axis is odd, so that parity does not close.
/// Throws std::invalid_argument if the mesh gets larger than a TetrahedralMesh may be.
void AddLattice(const Lattice& lattice, TetrahedralMesh& mesh);

/// Throws std::invalid_argument if a TetrahedralMesh cannot hold that many tetrahedra.
void CheckNumberOfTetrahedra(double count);

} // namespace tetralux

#endif
