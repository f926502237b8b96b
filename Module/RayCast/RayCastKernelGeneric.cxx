// SPDX-License-Identifier: BSD-3-Clause

// The kernels for any processor.
#include "RayCast/RayCastKernel.inl"

namespace tetralux
{

RayCastKernels GetRayCastKernelsGeneric() { return TETRALUX_ISA::MakeRayCastKernels(); }

} // namespace tetralux
