// SPDX-License-Identifier: BSD-3-Clause
#include "Files/AtomicFile.h"

#include "CommandLine/CommandErrors.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

/// Names that the signal handler removes; a command writes a picture and statistics at most.
constexpr std::size_t MaximumPending = 8;
std::array<std::atomic<const char*>, MaximumPending> Pending;

void RemovePendingAndExit(int signal)
{
  for (const std::atomic<const char*>& name : Pending)
  {
    if (const char* path = name.load())
    {
      unlink(path);
    }
  }
  _exit(128 + signal); // as shells report it
}

void AddPending(const char* path)
{
  std::signal(SIGINT, RemovePendingAndExit);
  std::signal(SIGTERM, RemovePendingAndExit);
  for (std::atomic<const char*>& name : Pending)
  {
    const char* free = nullptr;
    if (name.compare_exchange_strong(free, path))
    {
      return;
    }
  }
}

void RemovePending(const char* path)
{
  for (std::atomic<const char*>& name : Pending)
  {
    const char* expected = path;
    name.compare_exchange_strong(expected, nullptr);
  }
}

} // namespace

AtomicFile::AtomicFile(const std::string& fileName)
  : Name(fileName)
{
  const std::filesystem::path path(fileName);
  if (std::filesystem::is_directory(path))
  {
    throw WorkError("cannot write '" + fileName + "': it is a folder");
  }
  this->TemporaryName = (path.parent_path() /
    ("." + path.stem().string() + "." + std::to_string(getpid()) + path.extension().string()))
                          .string();
  const int file = open(this->TemporaryName.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0)
  {
    throw WorkError("cannot write '" + fileName + "': " + std::strerror(errno));
  }
  close(file);
  AddPending(this->TemporaryName.c_str());
}

AtomicFile::~AtomicFile()
{
  if (!this->TemporaryName.empty())
  {
    std::remove(this->TemporaryName.c_str());
    RemovePending(this->TemporaryName.c_str());
  }
}

void AtomicFile::Commit()
{
  if (std::rename(this->TemporaryName.c_str(), this->Name.c_str()) != 0)
  {
    throw WorkError("cannot write '" + this->Name + "': " + std::strerror(errno));
  }
  RemovePending(this->TemporaryName.c_str());
  this->TemporaryName.clear();
}
