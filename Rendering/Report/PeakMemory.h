// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PeakMemory_h
#define tetralux_PeakMemory_h

#include <cstdint>

#include <sys/resource.h>

namespace tetralux
{

/// The largest memory that the process has held so far, in bytes.
inline std::int64_t GetPeakMemory()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{ usage.ru_maxrss } * 1024; // Linux has it in units of 1024 bytes
}

} // namespace tetralux

#endif
