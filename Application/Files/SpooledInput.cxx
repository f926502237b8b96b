// SPDX-License-Identifier: BSD-3-Clause
#include "Files/SpooledInput.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/ProgressLine.h"
#include "Files/WriteBytes.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

bool SpooledInput::IsPipe(const std::string& fileName)
{
  struct stat status;
  return fileName == "-" || (stat(fileName.c_str(), &status) == 0 && S_ISFIFO(status.st_mode));
}

SpooledInput::SpooledInput(const std::string& fileName)
  : Name(fileName == "-" ? "standard input" : fileName)
  , File(std::tmpfile(), std::fclose)
{
  if (!this->File)
  {
    throw WorkError("cannot keep '" + this->Name + "' in a file: " + std::strerror(errno));
  }
  const ProgressLine progress("reading " + this->Name);
  CopyFromStream(fileName == "-" ? "" : fileName, this->GetPath(), this->Name);
}

std::string SpooledInput::GetPath() const
{
  return "/proc/self/fd/" + std::to_string(fileno(this->File.get()));
}

std::string SpooledInput::FindExtension() const
{
  static const std::array<std::pair<std::string, std::string>, 5> beginnings = { {
    { "# vtk", ".vtk" },
    { "<?xml", ".vtu" }, // its reader reads all kinds of VTK XML
    { "<VTKFile", ".vtu" },
    { "CDF", ".e" },
    { "NRRD", ".nrrd" },
  } };
  for (const auto& [beginning, extension] : beginnings)
  {
    std::string text(beginning.size(), '\0');
    if (pread(fileno(this->File.get()), text.data(), text.size(), 0) ==
        static_cast<ssize_t>(text.size()) &&
      text == beginning)
    {
      return extension;
    }
  }
  throw WorkError("cannot read '" + this->Name +
    "': it does not begin as a format that is read from a pipe: VTK XML, VTK legacy, Exodus in "
    "its classic form, NRRD");
}
