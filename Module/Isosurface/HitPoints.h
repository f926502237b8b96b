// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_HitPoints_h
#define tetralux_HitPoints_h

// Where rays hit surfaces, and the gradients there.

#include "Integral/ColorLookup.h"
#include "Isosurface/CellFieldValues.h"
#include "Isosurface/IsosurfaceKernel.h"
#include "Isosurface/PacketRays.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Fills the colours of the hits of one polygon in a chunk, by the scalars of points. same: its
/// lanes.
TETRALUX_NOINLINE void FindHitColors(const IsosurfaceInput& in, IsosurfaceScratch& scratch,
  std::int64_t id, std::int32_t cell, int first, unsigned same)
{
  CellField<1> made;
  const CellField<1>* field = in.ColorFields ? in.ColorFields + id : &made;
  if (!in.ColorFields)
  {
    MakeScalarField(in.Tree.Source, in.ColorScalars, cell, made);
  }
  for (; same != 0; same &= same - 1)
  {
    const int ray = first + __builtin_ctz(same);
    const double scalar = EvaluateField(
      *field, 0, scratch.Points[0][ray], scratch.Points[1][ray], scratch.Points[2][ray]);
    float color[4];
    LookUpColor(in.Intervals, in.NumberOfIntervals,
      static_cast<float>((scalar - in.FunctionOffset) / in.FunctionScale), color);
    for (int c = 0; c < 4; ++c)
    {
      scratch.HitColors[c][ray] = color[c];
    }
  }
}

/// A component of a field at the points of lanes.
TETRALUX_INLINE Float8 EvaluateLanes(
  const CellField<3>& field, int component, const Double8 (&point)[3])
{
  Double8 value = field.Base[component];
  for (int a = 0; a < 3; ++a)
  {
    value = value + Double8(field.Slope[component][a]) * (point[a] - Double8(field.Origin[a]));
  }
  return ToFloat(value);
}

/// The gradients of a polygon at the points of lanes.
TETRALUX_INLINE void FindGradients(const IsosurfaceInput& in, std::int64_t id, std::int32_t cell,
  const Double8 (&point)[3], Float8 (&gradient)[3])
{
  if (!in.Lighting->OfPoints)
  {
    const GradientRow& row = in.CellGradients ? in.CellGradients[id] : in.Lighting->Gradients[cell];
    gradient[0] = row.X;
    gradient[1] = row.Y;
    gradient[2] = row.Z;
    return;
  }
  CellField<3> made;
  const CellField<3>* field = in.Gradients ? in.Gradients + id : &made;
  if (!in.Gradients)
  {
    MakeGradientField(in.Tree.Source, in.Lighting->Gradients, cell, made);
  }
  for (int a = 0; a < 3; ++a)
  {
    gradient[a] = EvaluateLanes(*field, a, point);
  }
}

/// Fills the points and, where there is light, the gradients of a chunk's hits.
TETRALUX_INLINE void FindHitPoints(const IsosurfaceInput& in, IsosurfaceScratch& scratch, int chunk)
{
  const RayPacket& rays = *scratch.Rays;
  const int first = chunk * LaneCount;
  const RayFrame& frame = in.Frame;
  const Double8 far = LoadDouble8(rays.Far + first);
  const Double8 depth = frame.Parallel ? Double8(0.) - far : Double8(1.) / far;
  const Double8 scale = frame.Parallel ? Double8(1.) : depth;
  const Double8 u = LoadDouble8(rays.U + first);
  const Double8 v = LoadDouble8(rays.V + first);
  Double8 point[3];
  for (int a = 0; a < 3; ++a)
  {
    point[a] = Double8(frame.Origin[a]) +
      (u * Double8(frame.Axes[0][a]) + v * Double8(frame.Axes[1][a])) * scale +
      depth * Double8(frame.Axes[2][a]);
    Store(scratch.Points[a] + first, point[a]);
  }
  Int8 surfaces = 0;
  Float8 gradients[3] = { 0.f, 0.f, 0.f };
  for (unsigned rest = scratch.HitRays[chunk]; rest != 0;)
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
    const Mask8 lanes = MaskFromBits(same);
    surfaces = Select(lanes, Int8(surface), surfaces);
    if (in.ColorScalars)
    {
      FindHitColors(in, scratch, id, cell, first, same);
    }
    if (in.Lighting)
    {
      Float8 own[3];
      FindGradients(in, id, cell, point, own);
      for (int a = 0; a < 3; ++a)
      {
        gradients[a] = Select(lanes, own[a], gradients[a]);
      }
    }
  }
  Store(scratch.Surfaces + first, surfaces);
  for (int a = 0; a < 3; ++a)
  {
    Store(scratch.Gradients[a] + first, gradients[a]);
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
