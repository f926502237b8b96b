// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SpecialFunctions_h
#define tetralux_SpecialFunctions_h

#include "TetraluxCoreModule.h"

namespace tetralux
{

// The two functions of the ray integral's closed form that the C++ library lacks, in double
// precision; SegmentIntegral.h has them in single precision.

/// Largest relative error of both: tested against 50 digits.
constexpr double SpecialFunctionError = 4e-15;

/// exp(x^2) erfc(x), the scaled complementary error function, for x >= 0.
TETRALUXCORE_EXPORT double Erfcx(double x);

/// Dawson's function, exp(-x^2) times the integral of exp(t^2) from 0 to x, for x >= 0.
TETRALUXCORE_EXPORT double Dawson(double x);

} // namespace tetralux

#endif
