// SPDX-License-Identifier: BSD-3-Clause
#include "Stability/SegmentLanes.inl"

namespace tetralux
{

SegmentLanes GetSegmentLanesAvx2() { return TETRALUX_ISA::MakeSegmentLanes(InstructionSet::Avx2); }

} // namespace tetralux
