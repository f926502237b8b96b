// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/LibraryOutput.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iostream>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace
{

/// Bytes in which the first line is looked for.
constexpr std::size_t BeginningSize = 4096;

/// The streams themselves while they are captured.
int SavedOutput = -1;
int SavedError = -1;

void Flush()
{
  std::cout.flush();
  std::cerr.flush();
  std::fflush(stdout);
  std::fflush(stderr);
}

/// Rules of dashes and empty lines say nothing.
bool SaysSomething(const std::string& line)
{
  return std::any_of(line.begin(), line.end(), [](unsigned char c) { return std::isalnum(c); });
}

} // namespace

LibraryOutput::LibraryOutput()
  : File(memfd_create("library output", MFD_CLOEXEC))
{
  if (this->File >= 0)
  {
    Flush();
    SavedOutput = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    SavedError = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    dup2(this->File, STDERR_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    close(nowhere);
  }
}

LibraryOutput::~LibraryOutput()
{
  if (this->File >= 0)
  {
    Flush();
    dup2(SavedOutput, STDOUT_FILENO);
    dup2(SavedError, STDERR_FILENO);
    close(SavedOutput);
    close(SavedError);
    SavedOutput = SavedError = -1;
    close(this->File);
  }
}

std::string LibraryOutput::GetFirstLine() const
{
  Flush();
  std::string text(BeginningSize, '\0');
  const ssize_t size = this->File < 0 ? 0 : pread(this->File, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    if (SaysSomething(line))
    {
      const std::size_t first = line.find_first_not_of(" \t\r");
      return line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
    }
    begin = end + 1;
  }
  return {};
}

int LibraryOutput::GetStandardError() { return SavedError >= 0 ? SavedError : STDERR_FILENO; }
