// SPDX-License-Identifier: BSD-3-Clause

// The kernels for AVX-512; this file is compiled for it and called where it exists.
#include "RayCast/RayCastKernel.inl"

namespace tetralux
{

RayCastKernels GetRayCastKernelsAvx512() { return TETRALUX_ISA::MakeRayCastKernels(); }

} // namespace tetralux
