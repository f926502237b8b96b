// SPDX-License-Identifier: BSD-3-Clause
#ifndef StabilityCommand_h
#define StabilityCommand_h

#include <functional>

namespace CLI
{
class App;
}

/// Adds --stability, --seed and --cases to `tetralux bench`. The returned function runs the
/// measurement and returns true if --stability is given, else it returns false.
///
/// The measurement prints to standard output how wrong each form of the ray integral is on segments
/// where it is hard to get right, against quadrature in extended precision. It throws UsageError if
/// other options are given. It throws WorkError if a form is more wrong than it promises, or if it
/// yields a number that is not finite, a negative colour or opacity, or an opacity above 1.
std::function<bool()> AddStabilityOptions(CLI::App* command);

#endif
