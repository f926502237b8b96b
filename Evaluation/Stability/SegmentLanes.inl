// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each instruction set, with the options that the kernels are compiled with.
#include "Integral/SegmentIntegral.h"
#include "Simd/InstructionSet.h"
#include "Stability/SegmentLanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

SegmentLanes MakeSegmentLanes(InstructionSet set)
{
  SegmentLanes lanes{};
  lanes.Name = GetName(set);
  lanes.ExpMinus = [](const float* x, float* result) { Store(result, ExpMinus(LoadFloat8(x))); };
  lanes.Erfcx = [](const float* x, float* result) { Store(result, Erfcx(LoadFloat8(x))); };
  lanes.Dawson = [](const float* x, float* result) { Store(result, Dawson(LoadFloat8(x))); };
  lanes.MinusLog = [](const float* x, float* result) { Store(result, MinusLog(LoadFloat8(x))); };
  lanes.MinusLogOfRest = [](const float* x, float* result)
  { Store(result, MinusLogOfRest(LoadFloat8(x))); };
  lanes.OneMinusExp = [](const float* x, float* result)
  { Store(result, OneMinusExp(LoadFloat8(x))); };
  lanes.ShortExpMinus = [](const float* x, float* result)
  { Store(result, ShortExpMinus(LoadFloat8(x))); };
  lanes.ShortMinusLogOfRest = [](const float* x, float* result)
  { Store(result, ShortMinusLogOfRest(LoadFloat8(x))); };
  lanes.ShortOneMinusExp = [](const float* x, float* result)
  { Store(result, ShortOneMinusExp(LoadFloat8(x))); };
  lanes.Power = [](const float* x, const float* power, float* result)
  { Store(result, Power(LoadFloat8(x), LoadFloat8(power))); };
  lanes.FindBulgeShare = [](const float* d0, const float* d1, float* share)
  { Store(share, FindBulgeShare(LoadFloat8(d0), LoadFloat8(d1))); };
  lanes.IntegrateConstant = [](const float* depth, float* opacity, float* transmittance)
  {
    Float8 o, t;
    IntegrateConstant(LoadFloat8(depth), o, t);
    Store(opacity, o);
    Store(transmittance, t);
  };
  lanes.IntegrateSegment =
    [](const float* d0, const float* d1, float* front, float* back, float* transmittance)
  {
    const SegmentWeights w = IntegrateSegment(LoadFloat8(d0), LoadFloat8(d1));
    Store(front, w.Front);
    Store(back, w.Back);
    Store(transmittance, w.Transmittance);
  };
  lanes.IntegrateCurvedSegment =
    [](const float* d0, const float* d1, float* front, float* back, float* bulge)
  {
    Float8 ofBulge;
    const SegmentWeights w = IntegrateCurvedSegment(LoadFloat8(d0), LoadFloat8(d1), ofBulge);
    Store(front, w.Front);
    Store(back, w.Back);
    Store(bulge, ofBulge);
  };
  return lanes;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
