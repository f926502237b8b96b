// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/ProgressLine.h"

#include "CommandLine/LibraryOutput.h"
#include "CommandLine/StandardStreams.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <unistd.h>

namespace
{

/// Work that takes less time shows nothing.
constexpr std::chrono::milliseconds Patience(500);

/// Time between two lines of the same percentage: the seconds go on.
constexpr std::chrono::seconds Period(1);

constexpr const char* Erase = "\r\x1b[K";

/// Writes to the terminal, also while libraries' output is captured. A terminal that takes no line
/// is no reason to stop.
void Write(const std::string& text)
{
  [[maybe_unused]] const ssize_t written =
    write(LibraryOutput::GetStandardError(), text.data(), text.size());
}

} // namespace

ProgressLine::ProgressLine(const std::string& label)
  : Label(EscapeControls(label))
  , Start(std::chrono::steady_clock::now())
{
  if (isatty(LibraryOutput::GetStandardError()) == 1)
  {
    this->Thread = std::thread([this] { this->KeepUpToDate(); });
  }
}

ProgressLine::~ProgressLine()
{
  for (const auto& [object, tag] : this->Observers)
  {
    object->RemoveObserver(tag);
  }
  if (this->Thread.joinable())
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Ends = true;
    }
    this->Change.notify_one();
    this->Thread.join();
    if (this->Shown)
    {
      Write(Erase);
    }
  }
}

void ProgressLine::Show(double fraction)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const int percent = static_cast<int>(100 * fraction);
  if (percent != this->Percent)
  {
    this->Percent = percent;
    if (this->Shown)
    {
      this->Print();
    }
  }
}

void ProgressLine::Observe(vtkObject* object, unsigned long event)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* self, void* fraction)
    {
      if (fraction)
      {
        static_cast<ProgressLine*>(self)->Show(*static_cast<double*>(fraction));
      }
    });
  this->Observers.emplace_back(object, object->AddObserver(event, command));
}

void ProgressLine::KeepUpToDate()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  const auto ends = [this] { return this->Ends; };
  if (this->Change.wait_for(lock, Patience, ends))
  {
    return;
  }
  do
  {
    this->Shown = true;
    this->Print();
  } while (!this->Change.wait_for(lock, Period, ends));
}

void ProgressLine::Print()
{
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(
    std::chrono::steady_clock::now() - this->Start);
  // The cursor goes back, so that a row of results that follows begins at the left.
  Write(Erase + this->Label +
    (this->Percent < 0 ? std::string(" ...") : " " + std::to_string(this->Percent) + " %") + ", " +
    std::to_string(seconds.count()) + " s\r");
}
