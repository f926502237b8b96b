// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OcclusionRays_h
#define tetralux_OcclusionRays_h

// How much of the ambient light reaches the hits of a packet. All hits take the same directions, so
// that the rays of one are parallel and make a packet; rays run towards the hits, as shadow rays.

#include "Isosurface/ShadowRays.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The normals of hits in the world, of length 1 and towards the viewer.
TETRALUX_INLINE void FindNormals(const IsosurfaceInput& in, const IsosurfaceScratch& scratch,
  float (&normals)[3][RayPacket::MaximumRays])
{
  const RayGrid& grid = *in.Grid;
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    double normal[3], view[3];
    double length2 = 0, view2 = 0, towards = 0, largest = 0;
    for (int a = 0; a < 3; ++a)
    {
      const double g = scratch.Gradients[a][i];
      const double size = g < 0 ? -g : g;
      largest = size > largest ? size : largest;
    }
    for (int a = 0; a < 3; ++a)
    {
      const float(&row)[3] = in.Lighting->NormalFromMesh[a];
      normal[a] = 0;
      for (int b = 0; b < 3; ++b)
      {
        // About 1 long, whose squares are in range.
        normal[a] += largest > 0 ? row[b] * (scratch.Gradients[b][i] / largest) : 0;
      }
      view[a] = grid.Direction[a] + scratch.Rays->U[i] * grid.DirectionStepX[a] +
        scratch.Rays->V[i] * grid.DirectionStepY[a];
      length2 += normal[a] * normal[a];
      view2 += view[a] * view[a];
      towards += normal[a] * view[a];
    }
    const double scale =
      (length2 > 0 ? (towards > 0 ? -1 : 1) / __builtin_sqrt(length2) : -1 / __builtin_sqrt(view2));
    for (int a = 0; a < 3; ++a)
    {
      normals[a][i] = static_cast<float>(scale * (length2 > 0 ? normal[a] : view[a]));
    }
  }
}

/// Fills scratch.Ambient: of the light from all directions before a hit, weighted by the cosine
/// with its normal, the share from where nothing blocks it within OcclusionRadius. chunks: those
/// with hits, one bit each.
TETRALUX_NOINLINE void FindOcclusion(const IsosurfaceInput& in, std::uint32_t chunks,
  IsosurfaceScratch& scratch, IsosurfaceCounts& counts)
{
  float normals[3][RayPacket::MaximumRays];
  float seen[RayPacket::MaximumRays], all[RayPacket::MaximumRays];
  FindNormals(in, scratch, normals);
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    seen[i] = all[i] = 0;
  }
  RayPacket& packet = scratch.ShadowRays;
  for (int s = 0; s < in.NumberOfOcclusionSamples; ++s)
  {
    const OcclusionSample& sample = in.Occlusion[s];
    float weights[RayPacket::MaximumRays];
    for (int i = 0; i < RayPacket::MaximumRays; ++i)
    {
      ClearShadowRay(packet, i);
      const float cosine = normals[0][i] * sample.Direction[0] +
        normals[1][i] * sample.Direction[1] + normals[2][i] * sample.Direction[2];
      const bool takesPart =
        (chunks >> (i / LaneCount) & 1) != 0 && scratch.Rays->Hit[i] >= 0 && cosine > 0;
      weights[i] = takesPart ? cosine : 0;
      if (takesPart)
      {
        const double point[3] = { scratch.Points[0][i], scratch.Points[1][i],
          scratch.Points[2][i] };
        double placed[3];
        Transform(sample.Frame, point, placed);
        packet.U[i] = placed[0];
        packet.V[i] = placed[1];
        packet.Far[i] = in.OcclusionOffset - placed[2];
        packet.Near[i] = in.OcclusionRadius - placed[2];
      }
    }
    TraceShadows(in, sample.Frame, sample.Placed, scratch, counts);
    for (int i = 0; i < RayPacket::MaximumRays; ++i)
    {
      all[i] += weights[i];
      seen[i] += packet.Hit[i] >= 0 ? 0 : weights[i];
    }
  }
  for (int i = 0; i < RayPacket::MaximumRays; ++i)
  {
    scratch.Ambient[i] = all[i] > 0 ? seen[i] / all[i] : 1;
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
