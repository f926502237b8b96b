// SPDX-License-Identifier: BSD-3-Clause

// The kernels for any processor.
#include "TriangleCaster/ImageComponentKernel.inl"

namespace tetralux
{

ImageKernel GetImageComponentKernelGeneric(const ImageKernelInput& in)
{
  return TETRALUX_ISA::ChooseComponentKernel(in);
}

} // namespace tetralux
