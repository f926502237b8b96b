// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_InstructionSet_h
#define tetralux_InstructionSet_h

#include "TetraluxCoreModule.h"

namespace tetralux
{

/// What kernels are compiled for, each once.
enum class InstructionSet
{
  Generic, ///< any processor; each 64-bit ARM processor has NEON
  Avx2,    ///< x86-64 with AVX2 and FMA
  Avx512   ///< x86-64 with AVX-512 F, DQ, BW and VL beside them
};

/// The best one that all kernels are compiled for and that this processor has. Asks the processor
/// once.
TETRALUXCORE_EXPORT InstructionSet GetInstructionSet();

/// The same for kernels that are compiled for AVX-512, too.
TETRALUXCORE_EXPORT InstructionSet GetWidestInstructionSet();

/// Whether kernels of 16 lanes are faster than those of 8: AVX-512 with VBMI, which permutes bytes.
/// Measured on AMD's Zen 5, those of image data on Zen 4, too. Not taken for granted elsewhere:
/// microcode against data sampling makes gathers slow on some of Intel's processors.
TETRALUXCORE_EXPORT bool HasFastWideLanes();

/// For statistics: "generic", "NEON", "AVX2" or "AVX-512".
TETRALUXCORE_EXPORT const char* GetName(InstructionSet set);

} // namespace tetralux

#endif
