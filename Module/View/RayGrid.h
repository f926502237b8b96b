// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayGrid_h
#define tetralux_RayGrid_h

namespace tetralux
{

/// The rays of an image: any perspective or parallel camera, or a tile of its image.
///
/// In world coordinates the ray of pixel (i, j), counted from the lower left, starts at
/// Origin + i * OriginStepX + j * OriginStepY and runs along
/// Direction + i * DirectionStepX + j * DirectionStepY (of any length but zero); the pixel's centre
/// is in Origin and Direction already. A distance along a ray is in world units from its start; it
/// may be negative.
///
/// MeshFromWorld takes world coordinates to those of the mesh (the inverse of the volume's matrix):
/// three rows of an affine 3 x 4 matrix. Lengths are always measured in the world.
struct RayGrid
{
  int Width = 0;
  int Height = 0;
  double Origin[3] = { 0, 0, 0 };
  double OriginStepX[3] = { 0, 0, 0 };
  double OriginStepY[3] = { 0, 0, 0 };
  double Direction[3] = { 0, 0, -1 };
  double DirectionStepX[3] = { 0, 0, 0 };
  double DirectionStepY[3] = { 0, 0, 0 };
  double MeshFromWorld[3][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } };
};

} // namespace tetralux

#endif
