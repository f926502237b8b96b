// SPDX-License-Identifier: BSD-3-Clause

// The kernels for AVX2 with FMA; this file is compiled for those and called where they exist.
#include "TriangleCaster/ImageComponentKernel.inl"

namespace tetralux
{

ImageKernel GetImageComponentKernelAvx2(const ImageKernelInput& in)
{
  return TETRALUX_ISA::ChooseComponentKernel(in);
}

} // namespace tetralux
