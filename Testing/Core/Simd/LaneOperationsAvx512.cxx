// SPDX-License-Identifier: BSD-3-Clause
#include "LaneOperations.inl"

namespace tetralux
{

LaneOperations GetLaneOperationsAvx512() { return TETRALUX_ISA::MakeLaneOperations(); }

} // namespace tetralux
