// SPDX-License-Identifier: BSD-3-Clause
#include "Files/AtomicOutput.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "CommandLine/Worker.h"
#include "Files/WriteBytes.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

namespace fs = std::filesystem;

/// Files without a name that may be open at once: systems allow a process some 1000 open files.
/// Those beyond have hidden names.
constexpr int MaximumUnnamed = 64;

int NumberOfUnnamed = 0;

/// Links from one to the next before they count as a loop; Linux has the same limit.
constexpr int MaximumLinks = 40;

constexpr mode_t AllPermissions = 07777;

/// Whether a name is that of standard output, a pipe or a device.
bool IsStream(const std::string& fileName)
{
  struct stat status;
  return fileName == "-" ||
    (stat(fileName.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode));
}

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

std::string GetParent(const fs::path& path)
{
  return path.has_parent_path() ? path.parent_path().string() : ".";
}

/// A hidden name in the same folder. It is short whatever the output's own name is.
std::string MakeHiddenName(const fs::path& path)
{
  static int number = 0;
  return (
    path.parent_path() / (".tetralux-" + std::to_string(getpid()) + "-" + std::to_string(number++)))
    .string();
}

/// Where the file is that a name stands for: the end of its links, of which the last may lead to
/// nothing yet.
std::string FollowLinks(const std::string& name)
{
  fs::path path(name);
  std::error_code error;
  for (int i = 0; fs::is_symlink(path, error); ++i)
  {
    if (i == MaximumLinks)
    {
      Refuse(name, std::strerror(ELOOP));
    }
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path.string();
}

mode_t GetMask()
{
  const mode_t mask = umask(0);
  umask(mask);
  return mask;
}

/// The permissions of a file, or those that a new one gets.
mode_t GetPermissions(const std::string& path)
{
  struct stat status;
  return stat(path.c_str(), &status) == 0 ? status.st_mode & AllPermissions : 0666 & ~GetMask();
}

void CheckFile(const std::string& name, const std::string& target)
{
  struct stat status;
  if (!fs::path(target).has_filename() ||
    (stat(target.c_str(), &status) == 0 && S_ISDIR(status.st_mode)))
  {
    Refuse(name, "it is a folder");
  }
  // An older file is written over only if that is allowed, though it could be replaced; a new one
  // may have a name that is too long.
  if (access(target.c_str(), W_OK) != 0 && errno != ENOENT)
  {
    Refuse(name, std::strerror(errno));
  }
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

/// Gives a folder the name of an older one, which gets the first one's name, as far as the file
/// system can do both in one step; else the older one's name ends in ".older" at first.
std::error_code ExchangeFolders(const std::string& from, const std::string& to)
{
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0)
  {
    return {};
  }
  const std::string older = from + ".older";
  std::error_code error;
  fs::rename(to, older, error);
  if (error)
  {
    return error;
  }
  fs::rename(from, to, error);
  std::error_code ignored;
  fs::rename(older, error ? to : from, ignored);
  return error;
}

} // namespace

AtomicOutput::AtomicOutput(const std::string& fileName)
  : Name(fileName == "-" ? "standard output" : fileName)
  , IsFolder(false)
{
  if (IsStream(fileName))
  {
    this->Passes = true;
    if (fileName == "-")
    {
      const int flags = fcntl(STDOUT_FILENO, F_GETFL);
      if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
      {
        Refuse(this->Name, std::strerror(EBADF));
      }
      if (isatty(STDOUT_FILENO) == 1)
      {
        Refuse(this->Name, "it is a terminal");
      }
    }
    else
    {
      this->Target = fileName;
      CheckFile(this->Name, this->Target);
    }
    this->MakeFile(fs::temp_directory_path().string());
    return;
  }
  this->Target = FollowLinks(fileName);
  CheckFile(this->Name, this->Target);
  this->MakeFile(GetParent(this->Target));
}

AtomicOutput::AtomicOutput(const std::string& folderName, const std::string& marker)
  : Name(folderName)
  , Target(FollowLinks(GetFolderPath(folderName).string()))
  , TemporaryName(MakeHiddenName(Target))
  , HiddenName(TemporaryName)
  , IsFolder(true)
{
  CheckReplaceable(folderName, this->Target, marker);
  this->Pending = std::make_unique<Worker::Pending>(this->TemporaryName);
  std::error_code error;
  fs::create_directory(this->TemporaryName, error);
  if (error)
  {
    Refuse(folderName, error.message());
  }
}

AtomicOutput::~AtomicOutput()
{
  if (this->File >= 0)
  {
    close(this->File);
    --NumberOfUnnamed;
  }
  if (this->Pending)
  {
    std::error_code error;
    fs::remove_all(this->HiddenName, error);
  }
}

/// Makes a file in a folder, if possible without a name. Only this process may open it until it is
/// whole.
void AtomicOutput::MakeFile(const std::string& folder)
{
  constexpr mode_t OwnOnly = 0600;
  if (NumberOfUnnamed < MaximumUnnamed)
  {
    this->File = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, OwnOnly);
  }
  const std::string path = "/proc/self/fd/" + std::to_string(this->File);
  if (this->File >= 0 && access(path.c_str(), W_OK) == 0)
  {
    ++NumberOfUnnamed;
    this->TemporaryName = path;
    this->HiddenName = MakeHiddenName(this->Target);
    return;
  }
  if (this->File >= 0)
  {
    close(this->File);
    this->File = -1;
  }
  this->HiddenName = this->TemporaryName = MakeHiddenName(fs::path(folder) / "any");
  this->Pending = std::make_unique<Worker::Pending>(this->TemporaryName);
  const int file =
    open(this->TemporaryName.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, OwnOnly);
  if (file < 0)
  {
    Refuse(this->Name, std::strerror(errno));
  }
  close(file);
}

std::string AtomicOutput::AddFile(const std::string& name) const
{
  return (fs::path(this->TemporaryName) / name).string();
}

void AtomicOutput::AddFolder(const std::string& name) const
{
  std::error_code error;
  fs::create_directory(this->AddFile(name), error);
  if (error)
  {
    Refuse(this->Name + "/" + name, error.message());
  }
}

void AtomicOutput::Commit()
{
  if (this->Passes)
  {
    CopyToStream(this->TemporaryName, this->Target, this->Name);
  }
  else if (this->IsFolder)
  {
    this->CommitFolder();
  }
  else
  {
    this->CommitFile();
  }
}

void AtomicOutput::CommitFile()
{
  if (chmod(this->TemporaryName.c_str(), GetPermissions(this->Target)) != 0)
  {
    Refuse(this->Name, std::strerror(errno));
  }
  if (this->File >= 0)
  {
    // A link does not replace a file, so that the file gets a hidden name before its own.
    this->Pending = std::make_unique<Worker::Pending>(this->HiddenName);
    if (linkat(AT_FDCWD, this->TemporaryName.c_str(), AT_FDCWD, this->HiddenName.c_str(),
          AT_SYMLINK_FOLLOW) != 0)
    {
      Refuse(this->Name, std::strerror(errno));
    }
  }
  if (std::rename(this->HiddenName.c_str(), this->Target.c_str()) != 0)
  {
    Refuse(this->Name, std::strerror(errno));
  }
  this->Pending.reset();
}

void AtomicOutput::CommitFolder()
{
  std::error_code error;
  if (fs::exists(this->Target, error))
  {
    error = ExchangeFolders(this->TemporaryName, this->Target);
  }
  else
  {
    fs::rename(this->TemporaryName, this->Target, error);
  }
  if (error)
  {
    Refuse(this->Name, error.message());
  }
  // What is left is the older folder, which the destructor removes.
}

bool HasExtension(const std::string& fileName, const std::vector<std::string>& extensions)
{
  const std::string extension = GetExtension(fileName);
  return extension.empty()
    ? IsStream(fileName)
    : std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}
