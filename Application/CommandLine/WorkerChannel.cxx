// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/WorkerChannel.h"

#include <cerrno>
#include <climits>
#include <vector>

#include <sys/socket.h>

namespace
{

int Socket = -1;

/// No message is longer: a kind and a path.
constexpr std::size_t LargestMessage = PATH_MAX + 1;

} // namespace

void WorkerChannel::Open(int socket) { Socket = socket; }

void WorkerChannel::Send(Kind kind, const std::string& text)
{
  if (Socket >= 0)
  {
    const std::string message = (static_cast<char>(kind) + text).substr(0, LargestMessage);
    while (send(Socket, message.data(), message.size(), MSG_NOSIGNAL) < 0 && errno == EINTR)
    {
    }
  }
}

bool WorkerChannel::Receive(int socket, Kind& kind, std::string& text)
{
  std::vector<char> message(LargestMessage);
  const ssize_t size = recv(socket, message.data(), message.size(), MSG_DONTWAIT);
  if (size < 1)
  {
    return false;
  }
  kind = static_cast<Kind>(message[0]);
  text.assign(message.data() + 1, message.data() + size);
  return true;
}
