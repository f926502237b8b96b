// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/PreIntegrationKernel.inl"

namespace tetralux
{

PreIntegrationKernels GetPreIntegrationKernelsGeneric()
{
  return TETRALUX_ISA::MakePreIntegrationKernels();
}

} // namespace tetralux
