// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BankedCache_h
#define tetralux_BankedCache_h

#include <cstdint>
#include <vector>

namespace tetralux
{

/// The texture cache of Knittel 1999, section 5: eight banks, each direct mapped, so that the eight
/// voxels around any point can be read at once.
///
/// The lowest bits of x, y and z choose the bank. A line holds 8 voxels of one bank, and is filled
/// on its own. The paper does not say which 8. Here they are a cube of 2 x 2 x 2 voxels of a bank,
/// so that the lines of all banks at one place are a cube of 4 x 4 x 4 voxels of the volume. The
/// lowest bits of that cube's place choose the entry, so that a cube of 8 (512 voxels) or 16 (4096)
/// voxels along an edge that begins at a multiple of 4 fits in. Both are chosen for misses near the
/// paper's: rows of 8 voxels have about twice as many, entries by linear addresses up to ten times.
class BankedCache
{
public:
  /// A voxel has 2 bytes, and a line 8 voxels.
  static constexpr int BytesOfFill = 16;

  /// bits: of the entries of a bank along each axis, 1 (512 voxels, 1 KB) or 2 (4096 voxels, 8 KB).
  explicit BankedCache(int bits)
    : Bits(bits)
    , Lines(std::size_t{ 8 } << (3 * bits), -1)
  {
  }

  /// Reads the voxels at the corners of a cell. fill: missing ones are brought in. Returns how many
  /// were missing.
  int ReadCell(int x, int y, int z, bool fill)
  {
    int misses = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      misses += this->Read(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2), fill);
    }
    return misses;
  }

private:
  int Read(int x, int y, int z, bool fill)
  {
    const int bank = (x & 1) | (y & 1) << 1 | (z & 1) << 2;
    const int mask = (1 << this->Bits) - 1;
    const int cube[3] = { x >> 2, y >> 2, z >> 2 };
    const int entry =
      (cube[0] & mask) | (cube[1] & mask) << this->Bits | (cube[2] & mask) << (2 * this->Bits);
    constexpr int AxisBits = 21; // of a cube's place
    const std::int64_t tag = cube[0] | static_cast<std::int64_t>(cube[1]) << AxisBits |
      static_cast<std::int64_t>(cube[2]) << (2 * AxisBits);
    std::int64_t& line = this->Lines[(static_cast<std::size_t>(entry) << 3) | bank];
    const bool missing = line != tag;
    if (missing && fill)
    {
      line = tag;
    }
    return missing ? 1 : 0;
  }

  int Bits;
  std::vector<std::int64_t> Lines; ///< the cube that each holds a part of, or -1
};

} // namespace tetralux

#endif
