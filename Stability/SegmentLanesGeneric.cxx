// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentLanes.inl"

namespace tetralux
{

SegmentLanes GetSegmentLanesGeneric() { return TETRALUX_ISA::MakeSegmentLanes("generic"); }

} // namespace tetralux
