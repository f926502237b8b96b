// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpooledInput_h
#define SpooledInput_h

#include <cstdio>
#include <memory>
#include <string>

/// All that comes out of standard input or a pipe, in a file without a name: readers go to and fro
/// in their files.
class SpooledInput
{
public:
  /// Whether a name is "-", which is standard input, or that of a pipe.
  static bool IsPipe(const std::string& fileName);

  /// Reads to the end. Throws WorkError.
  explicit SpooledInput(const std::string& fileName);

  /// What errors call it: the name, or "standard input".
  const std::string& GetName() const { return this->Name; }

  /// The path to read from.
  std::string GetPath() const;

  /// The extension that the content calls for, as ".vtu". Throws WorkError if the format is none
  /// that stands in a single file and shows itself at its beginning: VTK XML and legacy, Exodus,
  /// NRRD.
  std::string FindExtension() const;

private:
  std::string Name;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> File;
};

#endif
