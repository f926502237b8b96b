// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_DepthMap_h
#define tetralux_DepthMap_h

namespace tetralux
{

/// What a depth buffer holds of the point RayGrid::Origin + p of the world: half of Z / W, and a
/// half, where Z = Depth[0] p.x + Depth[1] p.y + Depth[2] p.z + Depth[3], and W likewise.
struct DepthMap
{
  double Depth[4];
  double Divisor[4];
};

} // namespace tetralux

#endif
