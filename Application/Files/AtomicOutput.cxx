// SPDX-License-Identifier: BSD-3-Clause
#include "Files/AtomicOutput.h"

#include "CommandLine/CommandErrors.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace
{

namespace fs = std::filesystem;

[[noreturn]] void Refuse(const std::string& name, const std::string& reason)
{
  throw WorkError("cannot write '" + name + "': " + reason);
}

/// The path without a slash at its end, which would be a folder without a name.
fs::path GetFolderPath(const std::string& name)
{
  const fs::path path(name);
  return path.has_filename() ? path : path.parent_path();
}

/// A hidden name in the same place; it keeps the extension, which writers may look at.
std::string MakeTemporaryName(const fs::path& path, bool isFolder)
{
  const std::string process = "." + std::to_string(getpid());
  const std::string name = isFolder
    ? "." + path.filename().string() + process
    : "." + path.stem().string() + process + path.extension().string();
  return (path.parent_path() / name).string();
}

void CheckReplaceable(const std::string& name, const fs::path& path, const std::string& marker)
{
  std::error_code error;
  if (!fs::exists(path, error))
  {
    return;
  }
  if (!fs::is_directory(path, error))
  {
    Refuse(name, "it is a file, not a folder");
  }
  if (!fs::is_empty(path, error) && !fs::exists(path / marker, error))
  {
    Refuse(name,
      "the folder has files of something else; only an empty one, or one with " + marker +
        ", is replaced");
  }
}

/// Renames a folder, over an older one if there is any.
std::error_code ReplaceFolder(const fs::path& from, const fs::path& to)
{
  const fs::path older = from.string() + ".older";
  std::error_code error;
  if (fs::exists(to, error))
  {
    fs::rename(to, older, error);
  }
  if (error)
  {
    return error;
  }
  fs::rename(from, to, error);
  std::error_code ignored;
  if (error)
  {
    fs::rename(older, to, ignored); // as it was
    return error;
  }
  fs::remove_all(older, ignored);
  return error;
}

} // namespace

AtomicOutput::AtomicOutput(const std::string& fileName)
  : Name(fileName)
  , TemporaryName(MakeTemporaryName(fileName, false))
  , IsFolder(false)
{
  if (fs::is_directory(fileName))
  {
    Refuse(fileName, "it is a folder");
  }
  const Interrupts::Hold hold;
  const int file = open(this->TemporaryName.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0)
  {
    Refuse(fileName, std::strerror(errno));
  }
  close(file);
  this->Pending.emplace_back(this->TemporaryName, Interrupts::Kind::File);
}

AtomicOutput::AtomicOutput(const std::string& folderName, const std::string& marker)
  : Name(folderName)
  , TemporaryName(MakeTemporaryName(GetFolderPath(folderName), true))
  , IsFolder(true)
{
  CheckReplaceable(folderName, GetFolderPath(folderName), marker);
  const Interrupts::Hold hold;
  std::error_code error;
  fs::create_directory(this->TemporaryName, error);
  if (error)
  {
    Refuse(folderName, error.message());
  }
  this->Pending.emplace_back(this->TemporaryName, Interrupts::Kind::Folder);
}

AtomicOutput::~AtomicOutput()
{
  if (!this->TemporaryName.empty())
  {
    std::error_code error;
    fs::remove_all(this->TemporaryName, error);
  }
}

std::string AtomicOutput::AddFile(const std::string& name)
{
  std::string path = (fs::path(this->TemporaryName) / name).string();
  this->Pending.emplace_back(path, Interrupts::Kind::File);
  return path;
}

void AtomicOutput::AddFolder(const std::string& name)
{
  const std::string path = (fs::path(this->TemporaryName) / name).string();
  const Interrupts::Hold hold;
  std::error_code error;
  fs::create_directory(path, error);
  if (error)
  {
    Refuse(this->Name + "/" + name, error.message());
  }
  this->Pending.emplace_back(path, Interrupts::Kind::Folder);
}

void AtomicOutput::Commit()
{
  const Interrupts::Hold hold;
  std::error_code error;
  if (this->IsFolder)
  {
    error = ReplaceFolder(this->TemporaryName, GetFolderPath(this->Name));
  }
  else
  {
    fs::rename(this->TemporaryName, this->Name, error);
  }
  if (error)
  {
    Refuse(this->Name, error.message());
  }
  this->TemporaryName.clear();
  this->Pending.clear();
}
