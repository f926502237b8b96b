// SPDX-License-Identifier: BSD-3-Clause
#ifndef AtomicFile_h
#define AtomicFile_h

#include <string>

/// An output file that appears complete or not at all: written under another name in the same
/// folder, then renamed. Without Commit, also after SIGINT or SIGTERM, nothing is left.
class AtomicFile
{
public:
  /// Throws WorkError where the folder does not let a file be made: before any work is done.
  explicit AtomicFile(const std::string& fileName);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write; exists and is empty.
  const std::string& GetTemporaryName() const { return this->TemporaryName; }

  const std::string& GetName() const { return this->Name; }

  /// Gives the file its name. Throws WorkError where that is not possible.
  void Commit();

private:
  std::string Name;
  std::string TemporaryName;
};

#endif
