// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_EmptySpace_h
#define tetralux_EmptySpace_h

// Where a volume has anything that contributes to a picture, outside and inside of its hull: past
// the hull of Knittel 1999, section 2.1.

#include "TetraluxCoreModule.h"
#include "TriangleCaster/ImageVolume.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tetralux
{

/// The blocks that a box meets: from From on, up to To. None where To is not above From.
struct BlockBox
{
  std::int64_t From[3], To[3];

  /// size: blocks along each axis. edge: cells along that of a block. low, high: corners of the box
  /// in coordinates of the volume.
  BlockBox(const std::int32_t (&size)[3], int edge, const double low[3], const double high[3])
  {
    for (int a = 0; a < 3; ++a)
    {
      // Outside of the volume there is nothing, and rounding is far below a thousandth of a cell.
      constexpr double Margin = 1e-3;
      const double most = size[a];
      const double first = (low[a] - Margin) / edge;
      const double last = (high[a] + Margin) / edge;
      const bool meets = first < most && last >= 0;
      this->From[a] = static_cast<std::int64_t>(meets && first > 0 ? first : 0);
      this->To[a] = meets ? static_cast<std::int64_t>(last < most ? last + 1 : most) : 0;
    }
  }
};

/// Smallest and largest value in blocks of cells. Depends on the volume alone.
class TETRALUXCORE_EXPORT BlockRanges
{
public:
  /// Cells along the edge of a block: fine enough for skin and bone, and a range for 64 values.
  static constexpr int BlockSize = 4;

  struct Range
  {
    float Low, High;    ///< of the volume's values; Low above High where none is a number
    bool Mixed = false; ///< some values are finite, and some are not
  };

  /// component: of the volume's points, from 0 on. threads: at least 1.
  void Build(const ImageVolume& volume, int component, int threads);

  const std::int32_t* GetSize() const { return this->Size; }
  const std::vector<Range>& GetRanges() const { return this->Ranges; }

  /// Of all cells that a box meets. low, high: corners in coordinates of the volume.
  Range FindRange(const double low[3], const double high[3]) const;

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

/// Counts of blocks that may contribute, so that any box is known to be empty in constant time.
class TETRALUXCORE_EXPORT EmptySpace
{
public:
  /// size: blocks along each axis. threads: at least 1. contributes: whether a block may
  /// contribute, by its index, x fastest; called by all threads.
  void Build(
    const std::int32_t size[3], int threads, const std::function<bool(std::int64_t)>& contributes);

  /// Whether no cell that a box meets contributes. low, high: corners in coordinates of the volume.
  bool IsEmpty(const double low[3], const double high[3]) const
  {
    const BlockBox box(this->Size, BlockRanges::BlockSize, low, high);
    const std::int64_t(&from)[3] = box.From;
    const std::int64_t(&to)[3] = box.To;
    if (to[0] <= from[0] || to[1] <= from[1] || to[2] <= from[2])
    {
      return true;
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
