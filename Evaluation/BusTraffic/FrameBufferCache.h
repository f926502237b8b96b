// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FrameBufferCache_h
#define tetralux_FrameBufferCache_h

#include <cstdint>

namespace tetralux
{

/// The frame buffer cache of Knittel 1999, section 5: 64 entries, one for each place in a tile of
/// 8 x 8 pixels, direct mapped. An entry holds a pixel's RGB and translucency; the frame buffer has
/// RGB alone, 3 bytes a pixel.
///
/// Pixels that changed are written when another tile takes their place. They are read in blocks of
/// 4 x 4. The paper does not say so, but all its numbers of bytes read are multiples of the 48 that
/// a block has, and they exceed the bytes written by about what blocks on the diagonal have of a
/// tile's other S-triangle.
class FrameBufferCache
{
public:
  static constexpr int BytesOfPixel = 3;
  static constexpr int BlockSize = 4;

  /// Changes a pixel of the frame buffer. x, y: in the tile.
  void Blend(int tile, int x, int y) { this->Change(tile, x, y, true); }

  /// Sets a pixel, whatever is in the frame buffer.
  void Set(int tile, int x, int y) { this->Change(tile, x, y, false); }

  /// Writes all pixels that changed.
  void Flush()
  {
    for (Block& block : this->Blocks)
    {
      this->Write(block);
    }
  }

  std::int64_t GetBytesRead() const { return this->BytesRead; }
  std::int64_t GetBytesWritten() const { return this->BytesWritten; }

private:
  struct Block
  {
    int Tile = -1;
    std::uint32_t Changed = 0; ///< a bit for each pixel
  };

  void Change(int tile, int x, int y, bool read)
  {
    Block& block = this->Blocks[2 * (y / BlockSize) + x / BlockSize];
    if (block.Tile != tile)
    {
      this->Write(block);
      block.Tile = tile;
      this->BytesRead += read ? BytesOfPixel * BlockSize * BlockSize : 0;
    }
    block.Changed |= 1u << (y % BlockSize * BlockSize + x % BlockSize);
  }

  void Write(Block& block)
  {
    for (; block.Changed != 0; block.Changed &= block.Changed - 1)
    {
      this->BytesWritten += BytesOfPixel;
    }
  }

  Block Blocks[4];
  std::int64_t BytesRead = 0;
  std::int64_t BytesWritten = 0;
};

} // namespace tetralux

#endif
