// SPDX-License-Identifier: BSD-3-Clause

// The kernels for any processor.
#include "TriangleCaster/ImageKernel.inl"

namespace tetralux
{

ImageKernel GetImageKernelGeneric(const ImageKernelInput& in)
{
  return TETRALUX_ISA::ChooseImageKernel(in);
}

} // namespace tetralux
