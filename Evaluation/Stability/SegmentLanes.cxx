// SPDX-License-Identifier: BSD-3-Clause
#include "Stability/SegmentLanes.h"

#include "Simd/InstructionSet.h"

namespace tetralux
{

SegmentLanes GetSegmentLanesGeneric();
#ifdef TETRALUX_HAVE_AVX2_KERNEL
SegmentLanes GetSegmentLanesAvx2();
#endif

std::vector<SegmentLanes> GetSegmentLanes()
{
  std::vector<SegmentLanes> all{ GetSegmentLanesGeneric() };
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  if (GetInstructionSet() == InstructionSet::Avx2)
  {
    all.push_back(GetSegmentLanesAvx2());
  }
#endif
  return all;
}

} // namespace tetralux
