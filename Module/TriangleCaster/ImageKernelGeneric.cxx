// SPDX-License-Identifier: BSD-3-Clause

// The kernels for any processor.
#include "TriangleCaster/ImageKernel.inl"

namespace tetralux
{

ImageKernel GetImageKernelGeneric(ImageScalar type)
{
  return TETRALUX_ISA::ChooseImageKernel(type);
}

} // namespace tetralux
