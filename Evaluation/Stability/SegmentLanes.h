// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SegmentLanes_h
#define tetralux_SegmentLanes_h

#include "Simd/LaneCount.h"

#include <vector>

namespace tetralux
{

/// The functions of SegmentIntegral.h and LaneFunctions.h as compiled for one instruction set: a
/// call computes LaneCount results from arrays of LaneCount numbers.
struct SegmentLanes
{
  using Function = void (*)(const float* x, float* result);

  const char* Name;
  Function ExpMinus;
  Function Erfcx;
  Function Dawson;
  Function MinusLog;
  Function MinusLogOfRest;
  Function OneMinusExp;
  Function ShortExpMinus;
  Function ShortMinusLogOfRest;
  Function ShortOneMinusExp;
  void (*Power)(const float* x, const float* power, float* result);
  void (*FindBulgeShare)(const float* d0, const float* d1, float* share);
  void (*IntegrateConstant)(const float* depth, float* opacity, float* transmittance);
  void (*IntegrateSegment)(
    const float* d0, const float* d1, float* front, float* back, float* transmittance);
  void (*IntegrateCurvedSegment)(
    const float* d0, const float* d1, float* front, float* back, float* bulge);
};

/// Those of every instruction set that this processor has.
std::vector<SegmentLanes> GetSegmentLanes();

} // namespace tetralux

#endif
