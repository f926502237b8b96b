// SPDX-License-Identifier: BSD-3-Clause
#ifndef WorkerVitals_h
#define WorkerVitals_h

#include <cstdint>

#include <sys/types.h>

/// Tells whether a process that reads a file has stopped to do so without ending: it works, but it
/// neither reads, nor needs new memory in proportion to what it has read, nor reports progress.
class WorkerVitals
{
public:
  explicit WorkerVitals(pid_t worker);

  /// Counts as progress.
  void Restart();

  /// Looks at the process. Returns true if it hangs. Where the system does not tell what the
  /// process does, this is never so.
  bool Hangs();

private:
  struct Signs
  {
    double ProcessorSeconds = 0;
    std::uint64_t ReadBytes = 0;
    std::uint64_t ResidentBytes = 0;
  };

  bool Look(Signs& signs) const;

  pid_t Worker;
  Signs AtProgress; ///< at the last progress
};

#endif
