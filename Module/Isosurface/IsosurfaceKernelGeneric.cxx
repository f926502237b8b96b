// SPDX-License-Identifier: BSD-3-Clause

// The kernel for any processor.
#include "Isosurface/IsosurfaceKernel.inl"

namespace tetralux
{

IsosurfaceKernel GetIsosurfaceKernelGeneric() { return TETRALUX_ISA::DrawBlock; }

} // namespace tetralux
