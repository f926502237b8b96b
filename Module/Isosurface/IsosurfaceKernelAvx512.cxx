// SPDX-License-Identifier: BSD-3-Clause

// The kernel for AVX-512; this file is compiled for it and called where it exists.
#include "Isosurface/IsosurfaceKernel.inl"

namespace tetralux
{

IsosurfaceKernels GetIsosurfaceKernelsAvx512()
{
  return { TETRALUX_ISA::DrawBlock, TETRALUX_ISA::PlaceLeaves };
}

} // namespace tetralux
