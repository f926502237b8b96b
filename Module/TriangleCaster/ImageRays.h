// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageRays_h
#define tetralux_ImageRays_h

// The rays of one vector: which slabs they go through, and where.

#include "Simd/Lanes.h"
#include "TriangleCaster/ImageKernel.h"
#include "View/CroppedRay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Slabs between two places at which positions are computed in double precision: their rounding in
/// single precision then stays below 1e-6 of the way through them.
constexpr int SlabsOfBlock = 16;

/// No slab, on either side.
constexpr std::int32_t NoSlab = std::numeric_limits<std::int32_t>::max();

/// Rays in lanes, and what they have gathered.
struct ImageRays
{
  std::int32_t X[LaneCount], Y[LaneCount]; ///< pixels; X is -1 where a lane has none

  // Coordinates of the volume at slab position 0, and what they grow by in a slab.
  double Base[3][LaneCount], Step[3][LaneCount];
  double WorldLength[LaneCount]; ///< of a ray's way through a depth of 1
  float StepLength[LaneCount];   ///< the length that counts for opacity, of a whole slab

  // Parts of the ray, ascending: first and last slab, and where in those it begins and ends.
  std::int32_t First[MostCroppedParts][LaneCount], Last[MostCroppedParts][LaneCount];
  float Begin[MostCroppedParts][LaneCount], End[MostCroppedParts][LaneCount];
  int PartCount;
  std::int32_t FirstSlab, LastSlab;   ///< of all rays and parts
  std::int32_t InnerFirst, InnerLast; ///< slabs that each ray of one part goes through wholly
  std::int32_t HasPart[LaneCount];    ///< all bits set, or none

  float Color[3][LaneCount];
  float Translucency[LaneCount];
  float Front[LaneCount];   ///< slab position of what contributes first, or -1
  float Kept[4][LaneCount]; ///< what models need besides, each in its own way; 0 at first
  bool Ended;               ///< nothing changes any ray any more

  /// Nothing gathered, and no part to go through.
  void Clear()
  {
    for (int l = 0; l < LaneCount; ++l)
    {
      this->Color[0][l] = this->Color[1][l] = this->Color[2][l] = 0.f;
      this->Translucency[l] = 1.f;
      this->Front[l] = -1.f;
      this->WorldLength[l] = 0;
      this->HasPart[l] = 0;
      for (auto& kept : this->Kept)
      {
        kept[l] = 0.f;
      }
    }
    this->FirstSlab = NoSlab;
    this->LastSlab = -1;
    this->Ended = true;
  }
};

/// Pixels of a vector.
struct PixelLanes
{
  Float8 Color[3]; ///< premultiplied
  Float8 Opacity;
  Float8 Front; ///< slab position of the pixel's depth, or below 0 where it has none
};

/// Slab positions between which rays are in a box.
TETRALUX_INLINE void MeetBox(
  const IndexBox& box, const ImageRays& rays, double (&begin)[LaneCount], double (&end)[LaneCount])
{
#pragma omp simd
  for (int l = 0; l < LaneCount; ++l)
  {
    double from = begin[l];
    double to = end[l];
    for (int a = 0; a < 3; ++a)
    {
      const double base = rays.Base[a][l];
      const double step = rays.Step[a][l];
      const double low = (box.Low[a] - base) / step;
      const double high = (box.High[a] - base) / step;
      const bool inside = (base >= box.Low[a]) & (base <= box.High[a]);
      const double enter = step > 0 ? low : high;
      const double leave = step > 0 ? high : low;
      from = step != 0 && enter > from ? enter : from;
      to = step != 0 ? (leave < to ? leave : to) : inside ? to : -1;
    }
    begin[l] = from;
    end[l] = to;
  }
}

/// How near, in slabs, a sample is to a side of the volume if they count as at one place: above the
/// rounding of both, 1e-12 or so, so that the parts on both sides agree whose it is.
constexpr double SampleOnSide = 1e-6;

/// The beginning or the end of the way through the slab that has a place, begin and end being those
/// of the ray's part: the beginning if the slab's sample lies behind the place.
inline double FindSlabEdge(double place, double begin, double end)
{
  const double slab = std::floor(place);
  const double from = std::max(slab, begin);
  const double to = std::min(slab + 1, end);
  return 0.5 * (from + to) >= place - SampleOnSide ? from : to;
}

/// Leaves a part of a ray the slabs whose samples are between from and to.
inline void TakeOwnSlabs(double from, double to, double& begin, double& end)
{
  const double first = from > begin ? FindSlabEdge(from, begin, end) : begin;
  end = to < end ? FindSlabEdge(to, begin, end) : end;
  begin = first;
}

/// Where the rays go, and the slab positions between which they are in the volume and its limits.
TETRALUX_NOINLINE void PlaceRays(
  const ImageKernelInput& in, ImageRays& rays, double (&begin)[LaneCount], double (&end)[LaneCount])
{
  const SlicePlanes& slices = in.Slices;
  const double origin = slices.Origin;
  const double distance = slices.Distance;
  const bool planes = slices.Shape == SliceShape::Planes;
  double depthOf[LaneCount]; // of a Direction
#pragma omp simd
  for (int l = 0; l < LaneCount; ++l)
  {
    const double i = rays.X[l], j = rays.Y[l];
    double way[3];
    for (int a = 0; a < 3; ++a)
    {
      way[a] = in.WorldDirection[a].At(i, j);
    }
    const double length = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    const double normal =
      way[0] * slices.Normal[0] + way[1] * slices.Normal[1] + way[2] * slices.Normal[2];
    const double depth = planes ? normal : length;
    depthOf[l] = depth;
    rays.WorldLength[l] = length / depth;
    const double counted = distance / in.UnitDistance * (in.CorrectOpacity ? length / depth : 1);
    constexpr double Largest = 1e37; // opacity is 1 long before
    rays.StepLength[l] = static_cast<float>(counted < Largest ? counted : Largest);
    for (int a = 0; a < 3; ++a)
    {
      const double start = in.Start[a].At(i, j);
      const double direction = in.Direction[a].At(i, j);
      rays.Base[a][l] = start + origin / depth * direction;
      rays.Step[a][l] = distance / depth * direction;
    }
    begin[l] = 0;
    end[l] = slices.Count;
  }
  MeetBox(in.Sliced, rays, begin, end);
  for (const PlaneAlongRays& plane : in.Planes)
  {
#pragma omp simd
    for (int l = 0; l < LaneCount; ++l)
    {
      const double i = rays.X[l], j = rays.Y[l];
      const double slope = plane.Slope.At(i, j);
      const double height = plane.Height.At(i, j) + origin / depthOf[l] * slope;
      const double u = -height / (distance / depthOf[l] * slope);
      begin[l] = slope > 0 && u > begin[l] ? u : begin[l];
      end[l] = slope < 0 && u < end[l] ? u : end[l];
      // Parallel to the plane: all or nothing.
      end[l] = slope == 0 && height < 0 ? -1 : end[l];
    }
  }
  if (in.Limits->MaximumDistances)
  {
    for (int l = 0; l < LaneCount; ++l)
    {
      const std::int64_t pixel = static_cast<std::int64_t>(rays.Y[l]) * in.Width + rays.X[l];
      const double farthest = rays.X[l] < 0 ? 0 : in.Limits->MaximumDistances[pixel];
      const double u = (farthest / rays.WorldLength[l] - origin) / distance;
      end[l] = u < end[l] ? u : end[l];
    }
  }
}

/// Sets up rays whose X and Y are set.
TETRALUX_NOINLINE void SetUpRays(const ImageKernelInput& in, ImageRays& rays)
{
  double begins[MostCroppedParts][LaneCount], ends[MostCroppedParts][LaneCount];
  PlaceRays(in, rays, begins[0], ends[0]);
  rays.PartCount = 1;
  if (in.Limits->Cropping)
  {
    for (int l = 0; l < LaneCount; ++l)
    {
      const double base[3] = { rays.Base[0][l], rays.Base[1][l], rays.Base[2][l] };
      const double step[3] = { rays.Step[0][l], rays.Step[1][l], rays.Step[2][l] };
      const CroppedRay parts = CropRay(
        in.Limits->CroppingPlanes, in.Limits->CroppingFlags, base, step, begins[0][l], ends[0][l]);
      for (int p = 0; p < MostCroppedParts; ++p)
      {
        begins[p][l] = p < parts.Count ? parts.Begin[p] : 0;
        ends[p][l] = p < parts.Count ? parts.End[p] : -1;
      }
      rays.PartCount = std::max(rays.PartCount, parts.Count);
    }
  }
  if (in.Partial)
  {
    double from[LaneCount], to[LaneCount];
    std::fill_n(from, LaneCount, std::numeric_limits<double>::lowest());
    std::fill_n(to, LaneCount, std::numeric_limits<double>::max());
    MeetBox(in.Own, rays, from, to);
    for (int p = 0; p < rays.PartCount; ++p)
    {
      for (int l = 0; l < LaneCount; ++l)
      {
        if (from[l] < to[l])
        {
          TakeOwnSlabs(from[l], to[l], begins[p][l], ends[p][l]);
        }
        else
        {
          ends[p][l] = begins[p][l];
        }
      }
    }
  }
  rays.FirstSlab = NoSlab;
  rays.LastSlab = -1;
  rays.InnerFirst = rays.PartCount == 1 ? 0 : NoSlab;
  rays.InnerLast = NoSlab;
  for (int p = 0; p < rays.PartCount; ++p)
  {
    for (int l = 0; l < LaneCount; ++l)
    {
      const double from = begins[p][l];
      const double to = ends[p][l];
      const bool exists = rays.X[l] >= 0 && from < to;
      const std::int32_t first = exists ? static_cast<std::int32_t>(from) : NoSlab;
      const std::int32_t last = exists ? static_cast<std::int32_t>(std::ceil(to)) - 1 : -1;
      rays.First[p][l] = first;
      rays.Last[p][l] = last;
      rays.Begin[p][l] = exists ? static_cast<float>(from - first) : 0.f;
      rays.End[p][l] = exists ? static_cast<float>(to - last) : 0.f;
      rays.HasPart[l] = (p > 0 ? rays.HasPart[l] : 0) | (exists ? -1 : 0);
      if (exists)
      {
        rays.FirstSlab = std::min(rays.FirstSlab, first);
        rays.LastSlab = std::max(rays.LastSlab, last);
        rays.InnerFirst = std::max(rays.InnerFirst, first + 1);
        rays.InnerLast = std::min(rays.InnerLast, last - 1);
      }
    }
  }
  rays.Ended = rays.LastSlab < 0;
}

/// Positions within a block of slabs, in single precision, relative to a cell near them.
struct BlockPositions
{
  Float8 Base[3], Step[3]; ///< from the cell's corner at the first slab of the block
  Float8 Low[3], High[3];  ///< what a cell may have of an index, seen from that cell
  Int8 Index;              ///< of that cell's first value
};

TETRALUX_INLINE BlockPositions FindPositions(
  const ImageKernelInput& in, const ImageRays& rays, std::int32_t slab)
{
  const std::int32_t strides[3] = { 1, in.Row, in.Slice };
  BlockPositions positions;
  positions.Index = 0;
  for (int a = 0; a < 3; ++a)
  {
    const Double8 step = LoadDouble8(rays.Step[a]);
    const Double8 x = Fma(Double8(slab), step, LoadDouble8(rays.Base[a]));
    const Float8 last = static_cast<float>(in.LastCell[a]);
    const Int8 cell = RoundToInt(Min(Max(ToFloat(x - Double8(0.5)), Float8(0.f)), last));
    const Float8 corner = ToFloat(cell);
    positions.Base[a] = ToFloat(x - ToDouble(corner));
    positions.Step[a] = ToFloat(step);
    positions.Low[a] = Float8(0.f) - corner;
    positions.High[a] = last - corner;
    positions.Index = positions.Index + cell * Int8(strides[a]);
  }
  return positions;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
