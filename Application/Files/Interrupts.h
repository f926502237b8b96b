// SPDX-License-Identifier: BSD-3-Clause
#ifndef Interrupts_h
#define Interrupts_h

#include <list>
#include <string>

/// The tool's only signal handler. On SIGINT and SIGTERM, it removes the unfinished outputs and
/// ends the process with exit status 128 + signal, as shells report it. The first Pending installs
/// it; before that, signals act as in any process.
///
/// Outputs are made and committed on one thread. The signal may arrive on any thread.
class Interrupts
{
public:
  enum class Kind
  {
    File,
    Folder ///< removed after what is in it, which must be pending as well
  };

  /// Delays the handler while an object lives: a signal that came meanwhile acts when the last one
  /// goes. For steps that must happen together, and for every change of what is pending.
  class Hold
  {
  public:
    Hold();
    ~Hold();
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
  };

  /// A path that a signal removes while this object lives. There may be any number of them.
  class Pending
  {
  public:
    Pending(const std::string& path, Kind kind);
    ~Pending();
    Pending(const Pending&) = delete;
    Pending& operator=(const Pending&) = delete;

  private:
    struct Entry
    {
      std::string Path;
      Kind What;
    };
    friend class Interrupts;
    std::list<Entry>::iterator Place;
  };

private:
  static std::list<Pending::Entry>& GetEntries();
  static void RemoveEntriesAndExit(int signal);
  static void Handle(int signal);
  static void Install();
};

#endif
