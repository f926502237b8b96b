// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/PreIntegrationKernel.inl"

namespace tetralux
{

PreIntegrationKernels GetPreIntegrationKernelsAvx2()
{
  return TETRALUX_ISA::MakePreIntegrationKernels();
}

} // namespace tetralux
