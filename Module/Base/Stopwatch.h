// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Stopwatch_h
#define tetralux_Stopwatch_h

#include <chrono>

namespace tetralux
{

/// Seconds since it was made.
class Stopwatch
{
public:
  double GetSeconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

} // namespace tetralux

#endif
