// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SetCache_h
#define tetralux_SetCache_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// A first-level cache of today's processors: sets of some ways, of which the one that was not used
/// for longest is replaced, and lines of 64 bytes. Voxels have 1 byte and lie in memory with x
/// fastest, then y.
class SetCache
{
public:
  static constexpr int BytesOfFill = 64;

  /// bytes: of the cache, a multiple of 64 ways. dimensions: of the volume, points.
  SetCache(int bytes, int ways, const int (&dimensions)[3])
    : Ways(ways)
    , Sets(bytes / BytesOfFill / ways)
    , Row(dimensions[0])
    , Slice(static_cast<std::int64_t>(dimensions[0]) * dimensions[1])
    , Lines(static_cast<std::size_t>(ways) * this->Sets, -1)
  {
  }

  /// As BankedCache::ReadCell.
  int ReadCell(int x, int y, int z, bool fill)
  {
    int misses = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const std::int64_t address =
        x + (corner & 1) + (y + (corner >> 1 & 1)) * this->Row + (z + (corner >> 2)) * this->Slice;
      misses += this->Read(address / BytesOfFill, fill);
    }
    return misses;
  }

private:
  int Read(std::int64_t line, bool fill)
  {
    std::int64_t* first = &this->Lines[static_cast<std::size_t>(line % this->Sets) * this->Ways];
    std::int64_t* last = first + this->Ways;
    std::int64_t* found = std::find(first, last, line);
    const bool missing = found == last;
    if (missing && !fill)
    {
      return 1;
    }
    // The last used comes first.
    std::rotate(first, missing ? last - 1 : found, missing ? last : found + 1);
    *first = line;
    return missing ? 1 : 0;
  }

  int Ways;
  int Sets;
  std::int64_t Row;
  std::int64_t Slice;
  std::vector<std::int64_t> Lines; ///< numbers of lines, set by set, or -1
};

} // namespace tetralux

#endif
