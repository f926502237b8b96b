// SPDX-License-Identifier: BSD-3-Clause
#ifndef WorkerChannel_h
#define WorkerChannel_h

#include <string>

/// The one-way line from the worker to its supervisor. Each message is one packet.
namespace WorkerChannel
{

/// First byte of a message; the rest is its text.
enum Kind : char
{
  PendingBegins = '+', ///< path
  PendingEnds = '-',   ///< path
  ReadingBegins = 'R', ///< file name
  ReadingGoesOn = 'P',
  ReadingEnds = 'r',
  Ended = 'E' ///< the work came to its own end; exit status
};

/// Sets the socket to send to. Before that, Send does nothing.
void Open(int socket);

void Send(Kind kind, const std::string& text = {});

/// Receives a message without waiting. Returns false if there is none.
bool Receive(int socket, Kind& kind, std::string& text);

} // namespace WorkerChannel

#endif
