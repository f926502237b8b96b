// SPDX-License-Identifier: BSD-3-Clause
#ifndef AtomicOutput_h
#define AtomicOutput_h

#include "Files/Interrupts.h"

#include <list>
#include <string>

/// An output, a file or a folder, that appears complete or not at all. It is written under another
/// name in the same place, and Commit gives it its own name. Without Commit, and after SIGINT or
/// SIGTERM, nothing is left.
class AtomicOutput
{
public:
  /// A file. Throws WorkError if the file can't be made, so that this is known before any work.
  explicit AtomicOutput(const std::string& fileName);

  /// A folder. An existing folder is replaced if it is empty, or if it has a file called marker,
  /// which tells that the same command made it. Throws WorkError if the folder must not be replaced
  /// or can't be made.
  AtomicOutput(const std::string& folderName, const std::string& marker);

  ~AtomicOutput();
  AtomicOutput(const AtomicOutput&) = delete;
  AtomicOutput& operator=(const AtomicOutput&) = delete;

  const std::string& GetName() const { return this->Name; }

  /// Path to write the file to. It exists and is empty.
  const std::string& GetTemporaryName() const { return this->TemporaryName; }

  /// Adds a file to the folder; name is relative to the folder. Returns the path to write it to.
  std::string AddFile(const std::string& name);

  /// Adds a folder to the folder. Throws WorkError.
  void AddFolder(const std::string& name);

  /// Gives the output its name. Throws WorkError if that fails; what had the name before is kept
  /// then.
  void Commit();

private:
  std::string Name;
  std::string TemporaryName; ///< empty after Commit
  bool IsFolder;
  std::list<Interrupts::Pending> Pending;
};

#endif
