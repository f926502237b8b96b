// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Tile_h
#define tetralux_Tile_h

#include <algorithm>

namespace tetralux
{

/// Pixels [X0, X1) x [Y0, Y1).
struct Tile
{
  int X0, Y0, X1, Y1;
};

/// A picture cut into square tiles, row by row. Those at its right and upper end may be smaller.
struct TileGrid
{
  int Width = 0;  ///< of the picture, pixels
  int Height = 0; ///< of the picture, pixels
  int Size = 1;   ///< of a tile, pixels along its edge

  int GetColumns() const { return (this->Width + this->Size - 1) / this->Size; }
  int GetCount() const
  {
    return this->GetColumns() * ((this->Height + this->Size - 1) / this->Size);
  }
  Tile GetTile(int index) const
  {
    const int x = index % this->GetColumns() * this->Size;
    const int y = index / this->GetColumns() * this->Size;
    return { x, y, std::min(x + this->Size, this->Width), std::min(y + this->Size, this->Height) };
  }
};

} // namespace tetralux

#endif
