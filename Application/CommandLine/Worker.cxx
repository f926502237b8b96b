// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/Worker.h"

#include "CommandLine/WorkerChannel.h"

Worker::Pending::Pending(const std::string& path)
  : Path(path)
{
  WorkerChannel::Send(WorkerChannel::PendingBegins, path);
}

Worker::Pending::~Pending() { WorkerChannel::Send(WorkerChannel::PendingEnds, this->Path); }

Worker::Reading::Reading(const std::string& fileName)
{
  WorkerChannel::Send(WorkerChannel::ReadingBegins, fileName);
}

Worker::Reading::~Reading() { WorkerChannel::Send(WorkerChannel::ReadingEnds); }

void Worker::Reading::Report(double fraction)
{
  const int percent = static_cast<int>(100 * fraction);
  if (percent > this->Percent)
  {
    this->Percent = percent;
    WorkerChannel::Send(WorkerChannel::ReadingGoesOn);
  }
}
