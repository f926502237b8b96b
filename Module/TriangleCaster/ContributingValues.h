// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ContributingValues_h
#define tetralux_ContributingValues_h

#include "TriangleCaster/EmptySpace.h"
#include "TriangleCaster/ImageKernel.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Which values change the pixels of a picture, for each blend mode. What is left out because of
/// that leaves each pixel the same bits, since it
/// - is transparent (Composite, Additive),
/// - is transparent, and so is all that it could be larger than (MaximumIntensity) or smaller than
///   (MinimumIntensity),
/// - is outside of the range (AverageIntensity),
/// - is on one side of each surface (Isosurfaces). Two samples that follow each other must then not
///   lie in different blocks on different sides. They don't if a box of blocks around both has none
///   that contributes: blocks beside each other share points, so either they are on the same side,
///   or a point that they share is not finite. Then one of them has finite points too, or neither
///   has. So blocks that have both contribute.
class ContributingValues
{
public:
  /// Uses how in is blended. table: of one of its functions; a value v lies at x = offset + scale v
  /// in it.
  ContributingValues(
    const ImageKernelInput& in, const IntervalTable& table, float scale, float offset);

  bool Include(const BlockRanges::Range& range) const;

private:
  bool IncludeTransfer(float low, float high) const;

  const ImageKernelInput& In;
  const std::vector<IntervalTable::Interval>& Intervals;
  float Scale, Offset;
  std::vector<int> VisibleBefore; ///< intervals that are not transparent, before each one
};

/// One of the functions that a volume is seen by.
struct SpaceFunction
{
  const BlockRanges* Blocks;
  ContributingValues Values;
  BlockLabels::Set Labels; ///< of the samples that it is for

  /// Whether a block with these labels may contribute by it.
  bool Contributes(std::int64_t block, BlockLabels::Set labels) const
  {
    return (labels & this->Labels) != 0 && this->Values.Include(this->Blocks->GetRanges()[block]);
  }
};

} // namespace tetralux

#endif
