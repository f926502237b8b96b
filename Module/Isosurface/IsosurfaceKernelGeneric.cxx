// SPDX-License-Identifier: BSD-3-Clause

// The kernel for any processor.
#include "Isosurface/IsosurfaceKernel.inl"

namespace tetralux
{

IsosurfaceKernels GetIsosurfaceKernelsGeneric()
{
  return { TETRALUX_ISA::DrawBlock, TETRALUX_ISA::PlaceLeaves };
}

} // namespace tetralux
