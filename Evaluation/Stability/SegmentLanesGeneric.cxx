// SPDX-License-Identifier: BSD-3-Clause
#include "Stability/SegmentLanes.inl"

namespace tetralux
{

SegmentLanes GetSegmentLanesGeneric() { return TETRALUX_ISA::MakeSegmentLanes("generic"); }

} // namespace tetralux
