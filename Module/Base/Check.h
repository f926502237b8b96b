// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Check_h
#define tetralux_Check_h

#include "TetraluxCoreModule.h"

namespace tetralux
{

/// Prints the condition, file and line to the standard error stream, and aborts.
[[noreturn]] TETRALUXCORE_EXPORT void FailCheck(const char* condition, const char* file, int line);

} // namespace tetralux

/// Checks an invariant: a condition that only a mistake in this code can make false. What a caller
/// may get wrong is no invariant; it throws. Active if TETRALUX_CHECKS is defined, as CMake does
/// for Core in Debug builds and under sanitizers. Otherwise the condition is not evaluated.
#ifdef TETRALUX_CHECKS
#define TETRALUX_CHECK(condition)                                                                  \
  ((condition) ? static_cast<void>(0) : ::tetralux::FailCheck(#condition, __FILE__, __LINE__))
#else
#define TETRALUX_CHECK(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif

#endif
