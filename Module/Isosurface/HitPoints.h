// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_HitPoints_h
#define tetralux_HitPoints_h

// Where rays hit surfaces, and the gradients there.

#include "Isosurface/CellFieldValues.h"
#include "Isosurface/IsosurfaceKernel.h"
#include "Isosurface/PacketRays.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Fills the points and, where there is light, the gradients of a chunk's hits.
TETRALUX_INLINE void FindHitPoints(const IsosurfaceInput& in, IsosurfaceScratch& scratch, int chunk)
{
  const RayPacket& rays = scratch.Rays;
  const int first = chunk * LaneCount;
  const RayFrame& frame = in.Frame;
  unsigned rest = 0;
  for (int i = 0; i < LaneCount; ++i)
  {
    rest |= rays.Hit[first + i] >= 0 ? 1u << i : 0u;
  }
#pragma omp simd
  for (int i = first; i < first + LaneCount; ++i)
  {
    const double depth = frame.Parallel ? -rays.Far[i] : 1 / rays.Far[i];
    const double scale = frame.Parallel ? 1 : depth;
    const double u = rays.U[i];
    const double v = rays.V[i];
    for (int a = 0; a < 3; ++a)
    {
      scratch.Points[a][i] = frame.Origin[a] +
        (u * frame.Axes[0][a] + v * frame.Axes[1][a]) * scale + depth * frame.Axes[2][a];
    }
  }
  while (rest != 0)
  {
    // The rays that hit one polygon.
    const std::int64_t id = rays.Hit[first + __builtin_ctz(rest)];
    unsigned same = 0;
    for (int i = 0; i < LaneCount; ++i)
    {
      same |= rays.Hit[first + i] == id ? 1u << i : 0u;
    }
    same &= rest;
    rest &= ~same;
    const std::int32_t cell =
      in.Tree.Polygons ? in.Tree.Polygons[id].Cell : static_cast<std::int32_t>(id >> 32);
    const std::int32_t surface =
      in.Tree.Polygons ? in.Tree.Polygons[id].Surface : static_cast<std::int32_t>(id & 0xffffffff);
    for (int i = 0; i < LaneCount; ++i)
    {
      scratch.Surfaces[first + i] = (same >> i & 1) != 0 ? surface : scratch.Surfaces[first + i];
    }
    if (!in.Lighting)
    {
      continue;
    }
    float gradient[3][LaneCount];
    if (in.Lighting->OfPoints)
    {
      CellField<3> made;
      const CellField<3>* field = in.Gradients ? in.Gradients + id : &made;
      if (!in.Gradients)
      {
        MakeGradientField(in.Tree.Source, in.Lighting->Gradients, cell, made);
      }
      for (int a = 0; a < 3; ++a)
      {
#pragma omp simd
        for (int i = 0; i < LaneCount; ++i)
        {
          gradient[a][i] = static_cast<float>(EvaluateField(*field, a, scratch.Points[0][first + i],
            scratch.Points[1][first + i], scratch.Points[2][first + i]));
        }
      }
    }
    else
    {
      const GradientRow& row = in.Lighting->Gradients[cell];
      for (int i = 0; i < LaneCount; ++i)
      {
        gradient[0][i] = row.X;
        gradient[1][i] = row.Y;
        gradient[2][i] = row.Z;
      }
    }
    for (int a = 0; a < 3; ++a)
    {
      for (int i = 0; i < LaneCount; ++i)
      {
        float& result = scratch.Gradients[a][first + i];
        result = (same >> i & 1) != 0 ? gradient[a][i] : result;
      }
    }
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
