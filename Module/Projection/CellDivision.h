// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellDivision_h
#define tetralux_CellDivision_h

// Cells divided where intervals of a transfer function end, so that each part is drawn by itself
// with the numbers of one interval. Isosurfaces in a cell are planes, so the parts of a cell have
// an exact order. Most cells are one part.

#include "Base/RawVector.h"
#include "Base/Span.h"
#include "Optics/IntervalTable.h"
#include "Projection/ScreenFrame.h"
#include "TetraluxCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace tetralux
{

/// What cells are divided by.
struct DivisionSource
{
  Span<const IntervalTable::Interval> Intervals;
  Span<const ScreenPoint> Points; ///< of the mesh: their scalars, mapped as those of the intervals
  Span<const double> Coordinates; ///< of the points, three each
  Span<const std::int32_t> Cells; ///< four point ids each
  double LengthScale = 1;         ///< world units of a unit of coordinates, at most

  /// Edge of a cell at most, units of coordinates: cells that can't be thick are not measured.
  double LongestEdge = std::numeric_limits<double>::infinity();

  /// Optical depth of a part at most: thicker ones are cut into slices of equal length. Infinity:
  /// there are no slices.
  double LargestDepth = 0;

  /// Divisions that have more slices than this for each cell that has any, or more than can be
  /// counted, are not made.
  double MostSlices = 0;
};

/// The parts of all cells that attenuate. The same for any number of threads.
class TETRALUXCORE_EXPORT CellDivision
{
public:
  /// The part of a cell in an interval. An end of the interval is open if nothing of the cell is
  /// beyond it, so that a scalar at a node is in one part exactly.
  struct Part
  {
    std::uint32_t Interval : 24;
    std::uint32_t Slices : 6;
    std::uint32_t OpenBelow : 1;
    std::uint32_t OpenAbove : 1;
  };
  static constexpr int MostSlices = 32;
  static constexpr std::size_t MostIntervals = std::size_t(1) << 24;

  /// What of a part is drawn at once, a slice of it.
  struct Slice
  {
    Part Of;
    int Index; ///< 0 is the one in front
  };

  enum class Outcome
  {
    Made,
    Refused, ///< there would be too many parts or slices
    Aborted
  };

  /// Makes the parts, or leaves none. progress: as of ForEachTile, with the share that is done;
  /// where it returns false, the work ends. Parallel, on all threads of OpenMP.
  Outcome Make(const DivisionSource& source, const std::function<bool(double)>& progress = {});

  void Clear();

  bool IsEmpty() const { return this->Begins.empty(); }
  bool HasSlices() const { return this->Sliced; } ///< any part has more than one

  /// Of a cell, ascending in scalar.
  Span<const Part> GetParts(std::int32_t cell) const
  {
    const std::uint32_t begin = this->Begins[cell];
    return { this->Parts.data() + begin, this->Begins[cell + 1] - begin };
  }

  /// All slices of a cell in the order in which rays go through them. eyeScalar: of the field of
  /// the cell at the eye, infinite in a parallel view; rays come from there, and beyond each plane
  /// of constant scalar they stay on its other side.
  void FindOrder(
    std::int32_t cell, double eyeScalar, bool frontToBack, std::vector<Slice>& result) const;

  std::int64_t GetNumberOfSlices(std::int32_t cell) const;

  std::size_t GetNumberOfBytes() const
  {
    return this->Parts.capacity() * sizeof(Part) + this->Begins.capacity() * sizeof(std::uint32_t);
  }

private:
  RawVector<Part> Parts;
  RawVector<std::uint32_t> Begins; ///< of each cell's parts, and the end
  std::vector<float> Ends;         ///< of intervals, above
  bool Sliced = false;
};

} // namespace tetralux

#endif
