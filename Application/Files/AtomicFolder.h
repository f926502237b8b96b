// SPDX-License-Identifier: BSD-3-Clause
#ifndef AtomicFolder_h
#define AtomicFolder_h

#include <string>

/// An output folder that appears complete or not at all: filled under another name beside it, then
/// renamed. Without Commit nothing is left.
///
/// A folder that has the name already is replaced if it has a file called marker, which says that it
/// was made by the same command, or if it is empty; anything else is refused.
class AtomicFolder
{
public:
  /// Throws WorkError where the folder can't be made or must not be replaced: before any work.
  AtomicFolder(const std::string& name, const std::string& marker);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Path of a file of the folder, or of a folder in it, while it is being filled.
  std::string GetPath(const std::string& file) const;

  /// Makes a folder in the folder. Throws WorkError.
  void MakeFolder(const std::string& name) const;

  const std::string& GetName() const { return this->Name; }

  /// Ends the process, as AtomicFile does, if SIGINT or SIGTERM came: called now and then, where
  /// nothing else is under way. The folder is gone then.
  void CheckInterrupt();

  /// Gives the folder its name. Throws WorkError where that is not possible.
  void Commit();

private:
  void Remove();

  std::string Name;
  std::string TemporaryName;
};

#endif
