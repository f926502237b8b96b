// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Stopwatch_h
#define tetralux_Stopwatch_h

#include <chrono>

namespace tetralux
{

/// Measures the seconds since it was made, or since the last lap.
class Stopwatch
{
public:
  double GetSeconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

  /// Returns the seconds and starts the next lap.
  double Lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - this->Start).count();
    this->Start = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

} // namespace tetralux

#endif
