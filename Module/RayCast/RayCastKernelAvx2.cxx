// SPDX-License-Identifier: BSD-3-Clause

// The kernels for AVX2 with FMA; this file is compiled for those and called where they exist.
#include "RayCast/RayCastKernel.inl"

namespace tetralux
{

RayCastKernels GetRayCastKernelsAvx2() { return TETRALUX_ISA::MakeRayCastKernels(); }

} // namespace tetralux
