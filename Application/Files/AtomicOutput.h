// SPDX-License-Identifier: BSD-3-Clause
#ifndef AtomicOutput_h
#define AtomicOutput_h

#include <memory>
#include <string>
#include <vector>

namespace Worker
{
class Pending;
}

/// An output, a file or a folder, that appears complete or not at all. Without Commit nothing is
/// left, however the process ends.
///
/// A file has no name until it is whole, if the file system can do that; else it has a hidden one
/// in the same folder, which the supervisor removes. A folder always has a hidden name until then.
/// Commit follows symbolic links, and a file that is replaced leaves its permissions to the new
/// one. Pipes and devices, and "-", which is standard output, get what was written at Commit.
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

  /// The name as errors call it.
  const std::string& GetName() const { return this->Name; }

  /// Path to write the file to. It exists and is empty, and has no extension.
  const std::string& GetTemporaryName() const { return this->TemporaryName; }

  /// Returns the path to write a file of the folder to; name is relative to the folder.
  std::string AddFile(const std::string& name) const;

  /// Adds a folder to the folder. Throws WorkError.
  void AddFolder(const std::string& name) const;

  /// Gives the output its name. Throws WorkError if that fails; what had the name before is kept
  /// then.
  void Commit();

private:
  void MakeFile(const std::string& folder);
  void CommitFile();
  void CommitFolder();

  std::string Name;
  std::string Target;        ///< Name behind its links; empty: standard output
  std::string TemporaryName; ///< empty after Commit
  std::string HiddenName;    ///< in the folder of Target: the temporary name, or the last but one
  bool IsFolder;
  bool Passes = false;                      ///< the target is a stream, which gets a copy
  int File = -1;                            ///< open as long as it has no name
  std::unique_ptr<Worker::Pending> Pending; ///< of HiddenName
};

/// Whether the name of an output ends in one of some extensions, or is "-" or that of a pipe or a
/// device without any, which get the first one's format.
bool HasExtension(const std::string& fileName, const std::vector<std::string>& extensions);

#endif
