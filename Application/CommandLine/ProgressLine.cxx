// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/ProgressLine.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <iostream>

#include <unistd.h>

namespace
{

/// Work that takes less time shows no fraction.
constexpr std::chrono::milliseconds Patience(500);

} // namespace

ProgressLine::ProgressLine(const std::string& label)
  : Label(label)
  , IsTerminal(isatty(STDERR_FILENO) == 1)
  , Start(std::chrono::steady_clock::now())
{
}

ProgressLine::~ProgressLine()
{
  for (const auto& [object, tag] : this->Observers)
  {
    object->RemoveObserver(tag);
  }
  if (this->Shown)
  {
    std::cerr << "\r\x1b[K" << std::flush;
  }
}

void ProgressLine::Show(double fraction)
{
  const int percent = static_cast<int>(100 * fraction);
  if (this->IsTerminal && percent != this->ShownPercent &&
    std::chrono::steady_clock::now() - this->Start > Patience)
  {
    this->Shown = true;
    this->ShownPercent = percent;
    std::cerr << "\r\x1b[K" << this->Label << " " << percent << " %" << std::flush;
  }
}

void ProgressLine::ShowLabel()
{
  if (this->IsTerminal)
  {
    this->Shown = true;
    std::cerr << "\r\x1b[K" << this->Label << " ..." << std::flush;
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
