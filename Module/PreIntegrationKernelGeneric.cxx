// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegrationKernel.inl"

namespace tetralux
{

PreIntegrationKernels GetPreIntegrationKernelsGeneric()
{
  return TETRALUX_ISA::MakePreIntegrationKernels();
}

} // namespace tetralux
