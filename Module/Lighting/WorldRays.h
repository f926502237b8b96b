// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_WorldRays_h
#define tetralux_WorldRays_h

// Rays of a picture, in lanes.

#include "Simd/Lanes.h"
#include "View/RayGrid.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The rays of a packet in the world.
struct WorldRays
{
  Double8 Origin[3], Direction[3]; ///< directions of length 1
};

/// The rays of the pixels (x, y). lengths: of the grid's directions.
TETRALUX_INLINE WorldRays MakeWorldRays(
  const RayGrid& grid, Double8 x, Double8 y, Double8* lengths = nullptr)
{
  WorldRays rays;
  for (int a = 0; a < 3; ++a)
  {
    rays.Origin[a] = Fma(Double8(grid.OriginStepX[a]), x,
      Fma(Double8(grid.OriginStepY[a]), y, Double8(grid.Origin[a])));
    rays.Direction[a] = Fma(Double8(grid.DirectionStepX[a]), x,
      Fma(Double8(grid.DirectionStepY[a]), y, Double8(grid.Direction[a])));
  }
  const Double8* d = rays.Direction;
  const Double8 length = Sqrt(Fma(d[0], d[0], Fma(d[1], d[1], d[2] * d[2])));
  for (Double8& component : rays.Direction)
  {
    component = component / length;
  }
  if (lengths)
  {
    *lengths = length;
  }
  return rays;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
