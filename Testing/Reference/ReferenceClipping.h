// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceClipping_h
#define tetralux_ReferenceClipping_h

#include "ReferenceMesh.h"
#include "ReferenceRays.h"
#include "ReferenceRuns.h"
#include "ReferenceVector.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tetralux
{
namespace reference
{

/// The ray of one pixel.
struct Ray : ReferenceRay
{
  /// Mesh coordinates are sheared so that the ray becomes an axis: (u, v) are the first two of
  /// Axes, minus Shear times the third, which is where the direction is largest (as Woop et al.,
  /// Watertight Ray/Triangle Intersection, 2013).
  std::array<int, 3> Axes;
  std::array<Real, 2> Shear;

  bool Valid = false;
};

Ray MakeRay(const RayGrid& grid, int i, int j);

/// A cell as the renderer reads it. Its points ascend, so that both cells at a face see the very
/// same numbers there and no surface slips through between them.
struct Cell
{
  std::int32_t Points[4];
  const double* Coordinates[4];
  double Scalars[4];
};

/// False if the cell is unusable.
bool GetCell(const ReferenceMesh& mesh, std::size_t id, Cell& cell);

/// Part of a ray in one cell; it has no length where the cell is flat.
struct Segment
{
  Real Begin; ///< world distance along the ray
  double Length;
  double BeginScalar;
  double EndScalar;
  CellPassage Passage;
  std::int32_t Pixel; ///< in the band
  std::int32_t Cell;
};

/// Clips the ray by a cell; false if the ray misses it. Of the four faces a ray passes none or two.
bool ClipByCell(const Ray& ray, const Cell& cell, Segment& segment);

} // namespace reference
} // namespace tetralux

#endif
