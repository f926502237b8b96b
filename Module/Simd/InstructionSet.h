// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_InstructionSet_h
#define tetralux_InstructionSet_h

#include "TetraluxCoreModule.h"

namespace tetralux
{

/// What kernels are compiled for, each once.
enum class InstructionSet
{
  Generic, ///< any processor
  Avx2     ///< x86-64 with AVX2 and FMA
};

/// The best one that there are kernels for and that this processor has. Asks the processor once.
TETRALUXCORE_EXPORT InstructionSet GetInstructionSet();

/// For statistics: "generic" or "AVX2".
TETRALUXCORE_EXPORT const char* GetName(InstructionSet set);

} // namespace tetralux

#endif
