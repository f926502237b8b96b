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

InstructionSet GetWidestInstructionSet()
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  static const bool avx512 = __builtin_cpu_supports("avx512f") &&
    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
    __builtin_cpu_supports("avx512vl");
  if (avx512)
  {
    return InstructionSet::Avx512;
  }
#endif
  return GetInstructionSet();
}

bool HasFastWideLanes()
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  static const bool fast = GetWidestInstructionSet() == InstructionSet::Avx512 &&
    __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_is("amd");
  return fast;
#else
  return false;
#endif
}

const char* GetName(InstructionSet set)
{
  switch (set)
  {
    case InstructionSet::Avx512:
      return "AVX-512";
    case InstructionSet::Avx2:
      return "AVX2";
    default:
#ifdef __aarch64__
      return "NEON";
#else
      return "generic";
#endif
  }
}

} // namespace tetralux
