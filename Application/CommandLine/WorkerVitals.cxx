// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/WorkerVitals.h"

#include <ctime>
#include <fstream>
#include <string>

#include <unistd.h>

namespace
{

/// Processor time without progress that counts as a hang, seconds. Readers that sort or convert
/// what they have read pass over 1e8 cells several times in it. Time in which the process waits,
/// for a disk or a network, does not count.
constexpr double LargestStandstill = 10;

/// Memory that a reader may come to need, as a multiple of what it has read and bytes beyond that.
/// No common compression makes data smaller than this; readers that repeat themselves at the end of
/// a file need ever more.
constexpr double LargestExpansion = 1100;
constexpr double LargestOverhead = 512e6;

} // namespace

WorkerVitals::WorkerVitals(pid_t worker)
  : Worker(worker)
{
}

void WorkerVitals::Restart() { this->Look(this->AtProgress); }

bool WorkerVitals::Hangs()
{
  Signs now;
  if (!this->Look(now))
  {
    return false;
  }
  const bool reads = now.ReadBytes > this->AtProgress.ReadBytes;
  const bool keeps = now.ResidentBytes > this->AtProgress.ResidentBytes &&
    static_cast<double>(now.ResidentBytes) <
      LargestExpansion * static_cast<double>(now.ReadBytes) + LargestOverhead;
  if (reads || keeps)
  {
    this->AtProgress = now;
  }
  return now.ProcessorSeconds - this->AtProgress.ProcessorSeconds > LargestStandstill;
}

bool WorkerVitals::Look(Signs& signs) const
{
  clockid_t clock;
  timespec time;
  if (clock_getcpuclockid(this->Worker, &clock) != 0 || clock_gettime(clock, &time) != 0)
  {
    return false;
  }
  signs.ProcessorSeconds =
    static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  const std::string folder = "/proc/" + std::to_string(this->Worker);
  std::string label;
  std::uint64_t size = 0;
  std::uint64_t resident = 0;
  std::ifstream(folder + "/io") >> label >> signs.ReadBytes; // rchar, its first row
  std::ifstream(folder + "/statm") >> size >> resident;      // in pages
  signs.ResidentBytes = resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return label == "rchar:" && size > 0;
}
