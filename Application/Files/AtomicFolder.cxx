// SPDX-License-Identifier: BSD-3-Clause
#include "Files/AtomicFolder.h"

#include "CommandLine/CommandErrors.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace
{

namespace fs = std::filesystem;

volatile std::sig_atomic_t InterruptSignal = 0;

void RememberSignal(int signal) { InterruptSignal = signal; }

/// The folder's path without a slash at its end, which would be a folder without a name.
fs::path GetFolderPath(const std::string& name)
{
  const fs::path path(name);
  return path.has_filename() ? path : path.parent_path();
}

} // namespace

AtomicFolder::AtomicFolder(const std::string& name, const std::string& marker)
  : Name(name)
{
  const fs::path path = GetFolderPath(name);
  std::error_code error;
  if (fs::exists(path, error))
  {
    if (!fs::is_directory(path, error))
    {
      throw WorkError("cannot write '" + name + "': it is a file, not a folder");
    }
    if (!fs::is_empty(path, error) && !fs::exists(path / marker, error))
    {
      throw WorkError("cannot write '" + name +
        "': the folder has files of something else; only an empty one, or one with " + marker +
        ", is replaced");
    }
  }
  this->TemporaryName =
    (path.parent_path() / ("." + path.filename().string() + "." + std::to_string(getpid())))
      .string();
  fs::create_directory(this->TemporaryName, error);
  if (error)
  {
    this->TemporaryName.clear();
    throw WorkError("cannot write '" + name + "': " + error.message());
  }
  std::signal(SIGINT, RememberSignal);
  std::signal(SIGTERM, RememberSignal);
}

AtomicFolder::~AtomicFolder() { this->Remove(); }

void AtomicFolder::Remove()
{
  if (!this->TemporaryName.empty())
  {
    std::error_code error;
    fs::remove_all(this->TemporaryName, error);
    this->TemporaryName.clear();
  }
}

std::string AtomicFolder::GetPath(const std::string& file) const
{
  return (fs::path(this->TemporaryName) / file).string();
}

void AtomicFolder::MakeFolder(const std::string& name) const
{
  std::error_code error;
  fs::create_directory(this->GetPath(name), error);
  if (error)
  {
    throw WorkError("cannot write '" + this->Name + "/" + name + "': " + error.message());
  }
}

void AtomicFolder::CheckInterrupt()
{
  if (InterruptSignal != 0)
  {
    this->Remove();
    std::_Exit(128 + InterruptSignal); // as shells report it
  }
}

void AtomicFolder::Commit()
{
  this->CheckInterrupt();
  const fs::path path = GetFolderPath(this->Name);
  const fs::path older = this->TemporaryName + ".older";
  std::error_code error;
  if (fs::exists(path, error))
  {
    fs::rename(path, older, error);
  }
  if (!error)
  {
    fs::rename(this->TemporaryName, path, error);
  }
  if (error)
  {
    std::error_code ignored;
    fs::rename(older, path, ignored); // as it was
    throw WorkError("cannot write '" + this->Name + "': " + error.message());
  }
  this->TemporaryName.clear();
  fs::remove_all(older, error);
}
