// SPDX-License-Identifier: BSD-3-Clause
#include "Simd/InstructionSet.h"

namespace tetralux
{

InstructionSet GetInstructionSet()
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  static const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2)
  {
    return InstructionSet::Avx2;
  }
#endif
  return InstructionSet::Generic;
}

const char* GetName(InstructionSet set) { return set == InstructionSet::Avx2 ? "AVX2" : "generic"; }

} // namespace tetralux
