// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WriteBytes.h"

#include "CommandLine/CommandErrors.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace
{

/// Bytes that are copied at a time, and that a file which can grow takes.
constexpr std::size_t BlockSize = std::size_t(1) << 16;

/// A file that is closed with the object.
class OpenFile
{
public:
  OpenFile(const std::string& path, int flags)
    : Descriptor(open(path.c_str(), flags | O_CLOEXEC, 0666))
  {
  }

  ~OpenFile()
  {
    if (this->Descriptor >= 0)
    {
      close(this->Descriptor);
    }
  }

  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  const int Descriptor; ///< -1: it can't be opened
};

bool WriteAll(int file, const char* bytes, std::size_t size)
{
  while (size > 0)
  {
    const ssize_t written = write(file, bytes, size);
    if (written >= 0)
    {
      bytes += written;
      size -= static_cast<std::size_t>(written);
    }
    else if (errno != EINTR)
    {
      return false;
    }
  }
  return true;
}

/// Copies to the end. Returns false, with errno, if that fails; -1 is no file.
bool Copy(int from, int to)
{
  std::vector<char> block(BlockSize);
  ssize_t size = -1;
  while (from >= 0 && to >= 0 && (size = read(from, block.data(), block.size())) != 0)
  {
    if (size < 0 ? errno != EINTR : !WriteAll(to, block.data(), static_cast<std::size_t>(size)))
    {
      return false;
    }
  }
  return size == 0;
}

[[noreturn]] void Refuse(const std::string& what, const std::string& name)
{
  throw WorkError("cannot " + what + " '" + name + "': " + std::strerror(errno));
}

} // namespace

void WriteText(const std::string& text, const std::string& path, const std::string& name)
{
  const OpenFile file(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (file.Descriptor < 0 || !WriteAll(file.Descriptor, text.data(), text.size()))
  {
    Refuse("write", name);
  }
}

void CopyToStream(const std::string& file, const std::string& path, const std::string& name)
{
  const OpenFile from(file, O_RDONLY);
  std::optional<OpenFile> to;
  if (!path.empty())
  {
    to.emplace(path, O_WRONLY);
  }
  if (!Copy(from.Descriptor, to ? to->Descriptor : STDOUT_FILENO))
  {
    Refuse("write", name);
  }
}

void CopyFromStream(const std::string& path, const std::string& file, const std::string& name)
{
  const OpenFile to(file, O_WRONLY);
  std::optional<OpenFile> from;
  if (!path.empty())
  {
    from.emplace(path, O_RDONLY);
  }
  if (!Copy(from ? from->Descriptor : STDIN_FILENO, to.Descriptor))
  {
    Refuse("read", name);
  }
}

std::string FindWriteObstacle(const std::string& path)
{
  const OpenFile file(path, O_WRONLY | O_APPEND | O_CREAT);
  const std::vector<char> block(BlockSize);
  return file.Descriptor >= 0 && WriteAll(file.Descriptor, block.data(), block.size())
    ? std::string()
    : std::strerror(errno);
}
