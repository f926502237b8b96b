// SPDX-License-Identifier: BSD-3-Clause

// The kernels for AVX2 with FMA; this file is compiled for those and called where they exist.
#include "TriangleCaster/ImageKernel.inl"

namespace tetralux
{

ImageKernel GetImageKernelAvx2(const ImageKernelInput& in)
{
  return TETRALUX_ISA::ChooseImageKernel(in);
}

} // namespace tetralux
