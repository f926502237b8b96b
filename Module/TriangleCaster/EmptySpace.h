// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_EmptySpace_h
#define tetralux_EmptySpace_h

// Where a volume has anything that is not transparent, outside and inside of its hull: past the
// hull of Knittel 1999, section 2.1.

#include "Optics/IntervalTable.h"
#include "TetraluxCoreModule.h"
#include "TriangleCaster/ImageVolume.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// Smallest and largest value in blocks of cells. Depends on the volume alone.
class TETRALUXCORE_EXPORT BlockRanges
{
public:
  /// Cells along the edge of a block: fine enough for skin and bone, and 1/64 of the volume's
  /// memory in ranges of 8 bytes.
  static constexpr int BlockSize = 4;

  struct Range
  {
    float Low, High; ///< of the volume's values; Low above High where none is a number
  };

  /// component: of the volume's points, from 0 on. threads: at least 1.
  void Build(const ImageVolume& volume, int component, int threads);

  const std::int32_t* GetSize() const { return this->Size; }
  const std::vector<Range>& GetRanges() const { return this->Ranges; }

  /// Of the whole volume; 0..0 where no value is a finite number.
  Range GetRange() const;

private:
  std::int32_t Size[3] = { 0, 0, 0 }; ///< blocks along each axis
  std::vector<Range> Ranges;          ///< x fastest
};

/// Which labels blocks have, and whether anything of them is shown. Depends on the volume alone.
class TETRALUXCORE_EXPORT BlockLabels
{
public:
  using Set = std::uint64_t;

  /// The set that has this label, 0..255. Labels from the last one on are one.
  static Set GetSet(int label)
  {
    constexpr int Last = 63;
    return static_cast<Set>(1) << (label < Last ? label : Last);
  }

  /// hiddenCells: as FindHiddenCells returns them. threads: at least 1.
  void Build(const ImageVolume& volume, const std::vector<unsigned char>& hiddenCells, int threads);

  /// For each block of BlockRanges, those of points that are not masked, and none if all cells are
  /// hidden; without labels all points have label 0. Empty if nothing has labels or is hidden.
  const std::vector<Set>& GetSets() const { return this->Sets; }

private:
  std::vector<Set> Sets; ///< x fastest
};

/// One of the functions that a volume is seen by.
struct SpaceFunction
{
  const BlockRanges* Blocks;
  const IntervalTable* Table; ///< a value v lies at x = Offset + Scale v in it
  float Scale;
  float Offset;
  BlockLabels::Set Labels; ///< of the samples that it is for
};

/// Counts of blocks that may contribute, so that any box is known to be empty in constant time.
class TETRALUXCORE_EXPORT EmptySpace
{
public:
  /// A block contributes if any function has a sample there that does. functions: at least one.
  void Build(const std::vector<SpaceFunction>& functions, const BlockLabels& labels);

  /// Whether no cell that a box meets contributes. low, high: corners in coordinates of the volume.
  bool IsEmpty(const double low[3], const double high[3]) const
  {
    std::int64_t from[3], to[3];
    for (int a = 0; a < 3; ++a)
    {
      // Outside of the volume there is nothing, and rounding is far below a thousandth of a cell.
      constexpr double Margin = 1e-3;
      const double most = this->Size[a];
      const double first = (low[a] - Margin) / BlockRanges::BlockSize;
      const double last = (high[a] + Margin) / BlockRanges::BlockSize;
      if (!(first < most) || !(last >= 0))
      {
        return true;
      }
      from[a] = static_cast<std::int64_t>(first > 0 ? first : 0);
      to[a] = static_cast<std::int64_t>(last < most ? last + 1 : most);
    }
    const auto sum = [this](std::int64_t i, std::int64_t j, std::int64_t k)
    { return this->Sums[(k * (this->Size[1] + 1) + j) * (this->Size[0] + 1) + i]; };
    const std::int64_t count = sum(to[0], to[1], to[2]) - sum(from[0], to[1], to[2]) -
      sum(to[0], from[1], to[2]) - sum(to[0], to[1], from[2]) + sum(from[0], from[1], to[2]) +
      sum(from[0], to[1], from[2]) + sum(to[0], from[1], from[2]) - sum(from[0], from[1], from[2]);
    return count == 0;
  }

  std::int64_t GetNumberOfVisibleBlocks() const
  {
    return this->Sums.empty() ? 0 : this->Sums.back();
  }

private:
  std::int32_t Size[3] = { 0, 0, 0 };
  std::vector<std::int32_t> Sums; ///< of blocks before each corner, along all axes
};

} // namespace tetralux

#endif
