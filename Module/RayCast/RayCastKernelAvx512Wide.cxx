// SPDX-License-Identifier: BSD-3-Clause

// The kernels for AVX-512 of 16 lanes; this file is compiled for it and called where that is fast.
#include "RayCast/RayCastKernel.inl"

namespace tetralux
{

RayCastKernels GetRayCastKernelsAvx512Wide() { return TETRALUX_ISA::MakeRayCastKernels(); }

} // namespace tetralux
