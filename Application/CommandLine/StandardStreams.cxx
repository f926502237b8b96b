// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/StandardStreams.h"

#include "CommandLine/CommandErrors.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include <fcntl.h>
#include <unistd.h>

void OpenStandardStreams()
{
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
  {
    if (fcntl(stream, F_GETFD) < 0)
    {
      // The lowest free number is this one's. The wrong direction lets every access fail.
      open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

std::string EscapeControls(const std::string& text)
{
  std::string escaped;
  for (const char letter : text)
  {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '\n')
    {
      escaped += "\\n";
    }
    else if (letter == '\r')
    {
      escaped += "\\r";
    }
    else if (letter == '\t')
    {
      escaped += "\\t";
    }
    else if (code < 0x20 || code == 0x7f)
    {
      char octal[5];
      std::snprintf(octal, sizeof(octal), "\\%03o", static_cast<unsigned int>(code));
      escaped += octal;
    }
    else
    {
      escaped += letter;
    }
  }
  return escaped;
}

void PrintMessage(const std::string& message)
{
  std::cerr << "tetralux: " + EscapeControls(message) + "\n";
}

void CheckStandardOutput()
{
  std::cout.flush();
  if (!std::cout)
  {
    // The stream does not keep the reason: the next write fails for the same.
    const bool fails = write(STDOUT_FILENO, "\n", 1) < 0;
    throw WorkError("cannot write standard output" +
      (fails ? std::string(": ") + std::strerror(errno) : std::string()));
  }
}
