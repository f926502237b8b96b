// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Interrupts.h"

#include <atomic>
#include <csignal>
#include <mutex>

#include <sched.h>
#include <unistd.h>

namespace
{

/// The handler reads the entries only if nobody holds, and a holder changes them only if no handler
/// runs: each side raises its own counter before it reads the other's. So the entries can be an
/// ordinary list, of any length.
std::atomic<int> Holds(0);
std::atomic<int> Handlers(0);

/// The last signal; 0: none. It acts when nobody holds.
std::atomic<int> LastSignal(0);

static_assert(std::atomic<int>::is_always_lock_free, "signal handlers must not wait for a lock");

constexpr int Signals[] = { SIGINT, SIGTERM };

} // namespace

std::list<Interrupts::Pending::Entry>& Interrupts::GetEntries()
{
  // Never destroyed: a signal may come while the process ends.
  static auto* entries = new std::list<Pending::Entry>;
  return *entries;
}

void Interrupts::RemoveEntriesAndExit(int signal)
{
  // Newest first: what is in a folder came after the folder.
  const std::list<Pending::Entry>& entries = GetEntries();
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry)
  {
    if (entry->What == Kind::Folder)
    {
      rmdir(entry->Path.c_str());
    }
    else
    {
      unlink(entry->Path.c_str());
    }
  }
  _exit(128 + signal);
}

void Interrupts::Handle(int signal)
{
  ++Handlers;
  LastSignal = signal; // before Holds is read: a holder that goes now sees it
  if (Holds == 0)
  {
    RemoveEntriesAndExit(signal);
  }
  --Handlers;
}

void Interrupts::Install()
{
  struct sigaction action = {};
  action.sa_handler = Handle;
  action.sa_flags = SA_RESTART;
  for (const int signal : Signals)
  {
    sigaddset(&action.sa_mask, signal);
  }
  for (const int signal : Signals)
  {
    sigaction(signal, &action, nullptr);
  }
}

Interrupts::Hold::Hold()
{
  ++Holds;
  while (Handlers != 0) // on another thread, which ends the process or is about to return
  {
    sched_yield();
  }
}

Interrupts::Hold::~Hold()
{
  if (--Holds == 0 && LastSignal != 0)
  {
    RemoveEntriesAndExit(LastSignal);
  }
}

Interrupts::Pending::Pending(const std::string& path, Kind kind)
{
  static std::once_flag installed;
  std::call_once(installed, Install);
  const Hold hold;
  std::list<Entry>& entries = GetEntries();
  this->Place = entries.insert(entries.end(), { path, kind });
}

Interrupts::Pending::~Pending()
{
  const Hold hold;
  GetEntries().erase(this->Place);
}
