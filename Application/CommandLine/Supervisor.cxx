// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/Supervisor.h"

#include "CommandLine/StandardStreams.h"
#include "CommandLine/WorkerChannel.h"
#include "CommandLine/WorkerVitals.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

/// Signals that ask a process to end.
constexpr int EndSignals[] = { SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGUSR1, SIGUSR2 };

/// How often a worker that reads is looked at, milliseconds.
constexpr int LookInterval = 500;

constexpr int WorkFailed = 1;

int Fail(const std::string& message)
{
  PrintMessage(message);
  return WorkFailed;
}

/// The process that watches.
class Watch
{
public:
  Watch(pid_t worker, int channel, int signals)
    : Worker(worker)
    , Channel(channel)
    , Signals(signals)
    , Vitals(worker)
  {
  }

  /// Returns the exit status when the worker has ended.
  int WaitForEnd()
  {
    int status = 0;
    while (!this->IsOver(status))
    {
      pollfd sources[] = { { this->Channel, POLLIN, 0 }, { this->Signals, POLLIN, 0 } };
      poll(sources, 2, this->IsReading ? LookInterval : -1);
      this->ReceiveMessages();
      if (sources[0].revents & POLLHUP) // nothing more will come
      {
        this->Channel = -1;
      }
      this->PassSignalsOn();
      if (this->IsReading && !this->Hung && this->Vitals.Hangs())
      {
        this->Hung = true;
        kill(this->Worker, SIGKILL);
      }
    }
    this->ReceiveMessages();
    for (auto path = this->Pending.rbegin(); path != this->Pending.rend(); ++path)
    {
      std::error_code ignored;
      std::filesystem::remove_all(*path, ignored);
    }
    return this->Judge(status);
  }

private:
  bool IsOver(int& status) const
  {
    const pid_t ended = waitpid(this->Worker, &status, WNOHANG);
    return ended == this->Worker || (ended < 0 && errno != EINTR);
  }

  void ReceiveMessages()
  {
    WorkerChannel::Kind kind;
    std::string text;
    while (WorkerChannel::Receive(this->Channel, kind, text))
    {
      switch (kind)
      {
        case WorkerChannel::PendingBegins:
          this->Pending.push_back(text);
          break;
        case WorkerChannel::PendingEnds:
          this->Pending.erase(
            std::remove(this->Pending.begin(), this->Pending.end(), text), this->Pending.end());
          break;
        case WorkerChannel::ReadingBegins:
          this->IsReading = true;
          this->FileName = text;
          this->Vitals.Restart();
          break;
        case WorkerChannel::ReadingGoesOn:
          this->Vitals.Restart();
          break;
        case WorkerChannel::ReadingEnds:
          this->IsReading = false;
          break;
        case WorkerChannel::Ended:
          this->Status = std::stoi(text);
          break;
      }
    }
  }

  /// A terminal sends its signals to both processes, and twice is as good as once.
  void PassSignalsOn()
  {
    signalfd_siginfo signal;
    while (read(this->Signals, &signal, sizeof(signal)) == sizeof(signal))
    {
      if (signal.ssi_signo != SIGCHLD)
      {
        kill(this->Worker, static_cast<int>(signal.ssi_signo));
      }
    }
  }

  int Judge(int status) const
  {
    if (this->Status)
    {
      return *this->Status;
    }
    const std::string reader =
      this->IsReading ? "cannot read '" + this->FileName + "': its reader " : "";
    const std::string damage = this->IsReading ? "; the file may be damaged" : "";
    if (this->Hung)
    {
      return Fail(reader + "works without getting on" + damage + " (" +
        WorkerVitals::PatienceVariable + " sets how long that may last)");
    }
    if (!WIFSIGNALED(status))
    {
      return Fail((this->IsReading ? reader : "a library ") + "has ended the program" + damage);
    }
    const int signal = WTERMSIG(status);
    if (std::find(std::begin(EndSignals), std::end(EndSignals), signal) != std::end(EndSignals))
    {
      return 128 + signal;
    }
    const std::string name = std::string(" (") + strsignal(signal) + ")";
    if (signal == SIGKILL || signal == SIGXCPU)
    {
      return Fail((this->IsReading ? reader : "the work ") + "was ended by the system" + name +
        (signal == SIGKILL ? "; perhaps there is not enough memory" : ""));
    }
    return Fail((this->IsReading ? reader : "the work ") + "has crashed" + name + damage);
  }

  pid_t Worker;
  int Channel;
  int Signals;
  WorkerVitals Vitals;
  std::vector<std::string> Pending; ///< oldest first
  bool IsReading = false;
  std::string FileName; ///< that is read
  bool Hung = false;
  std::optional<int> Status; ///< the work's own, when it came to its end
};

} // namespace

int Supervise(const std::function<int()>& work)
{
  // Writing fails instead, and the error says where.
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);

  // Blocked before the fork, so that none is missed.
  sigset_t watched;
  sigset_t before;
  sigemptyset(&watched);
  sigaddset(&watched, SIGCHLD);
  for (const int signal : EndSignals)
  {
    sigaddset(&watched, signal);
  }
  sigprocmask(SIG_BLOCK, &watched, &before);

  int channel[2];
  const pid_t supervisor = getpid();
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, channel) != 0)
  {
    return Fail(std::string("cannot start the work: ") + std::strerror(errno));
  }
  const pid_t worker = fork();
  if (worker < 0)
  {
    return Fail(std::string("cannot start the work: ") + std::strerror(errno));
  }
  if (worker == 0)
  {
    close(channel[0]);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    prctl(PR_SET_PDEATHSIG, SIGKILL); // the work does not outlive its supervisor
    if (getppid() != supervisor)
    {
      _exit(WorkFailed);
    }
    WorkerChannel::Open(channel[1]);
    const int status = work();
    WorkerChannel::Send(WorkerChannel::Ended, std::to_string(status));
    // What libraries do at the end of a process is left out: they have lines of their own for it.
    std::cout.flush();
    std::fflush(nullptr);
    _exit(status);
  }
  close(channel[1]);
  const int signals = signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK);
  // Signals stay blocked: one that comes too late for the work does not change its status.
  return Watch(worker, channel[0], signals).WaitForEnd();
}
