// SPDX-License-Identifier: BSD-3-Clause

// The kernel for AVX2 with FMA; this file is compiled for those and called where they exist.
#include "Isosurface/IsosurfaceKernel.inl"

namespace tetralux
{

IsosurfaceKernels GetIsosurfaceKernelsAvx2()
{
  return { TETRALUX_ISA::DrawBlock, TETRALUX_ISA::PlaceLeaves };
}

} // namespace tetralux
