// SPDX-License-Identifier: BSD-3-Clause
#ifndef Stability_h
#define Stability_h

#include <cstdint>

struct StabilityOptions
{
  std::uint64_t Seed = 1; ///< of the random cases
  int RandomCases =
    10000; ///< how many combinations are drawn at random, besides those that are listed
};

/// Prints to standard output how wrong every form of the ray integral is on segments where it is
/// hard to get right, against quadrature in extended precision. Throws WorkError if a form is more
/// wrong than it promises, or yields what is never right: a number that is not finite, a negative
/// colour or opacity, an opacity above 1.
void RunStability(const StabilityOptions& options);

#endif
