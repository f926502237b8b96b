// SPDX-License-Identifier: BSD-3-Clause
#ifndef Worker_h
#define Worker_h

#include <string>

/// What the process that does the tool's work tells the one that watches over it. See Supervisor.h.
/// Nothing is told, and nothing is wrong, in a process that nobody watches.
namespace Worker
{

/// A file or a folder with all that is in it, which is removed if the process ends while this
/// object lives, in whatever way it ends. Make it before the file.
class Pending
{
public:
  explicit Pending(const std::string& path);
  ~Pending();
  Pending(const Pending&) = delete;
  Pending& operator=(const Pending&) = delete;

private:
  std::string Path;
};

/// A file is read by a library while this object lives. If the process ends, or works without
/// reading on, then the file is damaged, and the error says so.
class Reading
{
public:
  explicit Reading(const std::string& fileName);
  ~Reading();
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  /// Tells how far it is, 0..1. Only a fraction above all before counts as progress.
  void Report(double fraction);

private:
  int Percent = 0;
};

} // namespace Worker

#endif
