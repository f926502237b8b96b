// SPDX-License-Identifier: BSD-3-Clause
#include "Stability/SegmentLanes.inl"

namespace tetralux
{

SegmentLanes GetSegmentLanesGeneric()
{
  return TETRALUX_ISA::MakeSegmentLanes(InstructionSet::Generic);
}

} // namespace tetralux
