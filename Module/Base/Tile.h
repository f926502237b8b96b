// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Tile_h
#define tetralux_Tile_h

namespace tetralux
{

/// Pixels [X0, X1) x [Y0, Y1).
struct Tile
{
  int X0, Y0, X1, Y1;
};

} // namespace tetralux

#endif
