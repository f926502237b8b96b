// SPDX-License-Identifier: BSD-3-Clause
#ifndef LibraryOutput_h
#define LibraryOutput_h

#include <string>

/// Keeps what libraries print on standard error, past VTK, and drops what they print on standard
/// output, while it lives. The tool prints nothing meanwhile but its progress. Captures do not
/// nest.
class LibraryOutput
{
public:
  LibraryOutput();
  ~LibraryOutput();
  LibraryOutput(const LibraryOutput&) = delete;
  LibraryOutput& operator=(const LibraryOutput&) = delete;

  /// Returns the first line on standard error that says something, without blanks around it; empty:
  /// none does.
  std::string GetFirstLine() const;

  /// The descriptor of standard error itself.
  static int GetStandardError();

private:
  int File; ///< takes standard error; -1: there is none, and everything is printed
};

#endif
