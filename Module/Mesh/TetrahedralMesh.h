// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TetrahedralMesh_h
#define tetralux_TetrahedralMesh_h

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Tetrahedra as they come from the input: nothing is reordered, merged or dropped.
///
/// A mesh holds at most 2^29 - 1 tetrahedra and 2^31 - 1 points, so that 4 * cell + face fits an
/// int32 everywhere. Ids of the input's points and cells fit an int32 as well. Who fills a mesh
/// refuses larger input with an error.
struct TetrahedralMesh
{
  /// Coordinates, three for each point, in the units of the input.
  std::vector<double> Points;

  /// Point ids, four for each tetrahedron, in any orientation.
  std::vector<std::int32_t> Cells;

  /// For each point the id of the input's point, or -1 - k for the k-th added point.
  /// Empty: point i is the input's point i.
  std::vector<std::int32_t> OriginalPoints;

  /// For each tetrahedron the id of the input's cell that it is a part of.
  /// Empty: tetrahedron i is the input's cell i.
  std::vector<std::int32_t> OriginalCells;

  /// Points that a split had to add (the middle of a quadratic cell or of a polyhedron): the k-th
  /// has the value sum of Weights[j] * value(input point Sources[j]), Offsets[k] <= j <
  /// Offsets[k + 1]. All three are empty where no point was added.
  struct
  {
    std::vector<std::int64_t> Offsets;
    std::vector<std::int64_t> Sources;
    std::vector<double> Weights;
  } AddedPoints;

  std::size_t GetNumberOfPoints() const { return this->Points.size() / 3; }
  std::size_t GetNumberOfCells() const { return this->Cells.size() / 4; }
};

} // namespace tetralux

#endif
