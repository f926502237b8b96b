// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/MessageCapture.h"

#include "CommandLine/StandardStreams.h"

#include "vtkLogger.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace
{

/// Different warnings that are kept. Readers of damaged files may give one for each cell.
constexpr std::size_t MaximumWarnings = 20;

/// "ERROR: In file.cxx, line 12\nvtkClass (0x1234): what is wrong\n\n" -> "what is wrong"
std::string StripDecoration(std::string text)
{
  const std::size_t lineEnd = text.find('\n');
  if (lineEnd != std::string::npos &&
    (text.compare(0, 6, "ERROR:") == 0 || text.compare(0, 8, "Warning:") == 0))
  {
    text.erase(0, lineEnd + 1);
  }
  const std::size_t object = text.find("): ");
  if (object != std::string::npos && text.compare(0, 3, "vtk") == 0)
  {
    text.erase(0, object + 3);
  }
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
  {
    text.pop_back();
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

} // namespace

class MessageCapture::Window : public vtkOutputWindow
{
public:
  static Window* New();
  vtkTypeMacro(Window, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayGenericWarningText(const char* text) override { this->DisplayWarningText(text); }

  void DisplayErrorText(const char* text) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Error.empty())
    {
      this->Error = StripDecoration(text);
    }
  }

  void DisplayWarningText(const char* text) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const std::string line = StripDecoration(text);
    if (std::find(this->Warnings.begin(), this->Warnings.end(), line) != this->Warnings.end())
    {
      return;
    }
    if (this->Warnings.size() < MaximumWarnings)
    {
      this->Warnings.push_back(line);
    }
    else
    {
      ++this->MoreWarnings;
    }
  }

  std::mutex Mutex;
  std::string Error;
  std::vector<std::string> Warnings; ///< each once
  std::int64_t MoreWarnings = 0;     ///< given since Warnings was full, repeated ones too
};

vtkStandardNewMacro(MessageCapture::Window);

MessageCapture::MessageCapture()
  : Previous(vtkOutputWindow::GetInstance())
  , Current(Window::New())
{
  // VTK's logger prints every message too, without the output window.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  this->Previous->Register(nullptr);
  vtkOutputWindow::SetInstance(this->Current);
}

MessageCapture::~MessageCapture()
{
  vtkOutputWindow::SetInstance(this->Previous);
  this->Previous->Delete();
  this->Current->Delete();
}

std::string MessageCapture::GetError() const
{
  const std::lock_guard<std::mutex> lock(this->Current->Mutex);
  return this->Current->Error;
}

void MessageCapture::PrintWarnings() const
{
  const std::lock_guard<std::mutex> lock(this->Current->Mutex);
  for (const std::string& warning : this->Current->Warnings)
  {
    PrintMessage("warning: " + warning);
  }
  if (this->Current->MoreWarnings > 0)
  {
    PrintMessage("warning: " + std::to_string(this->Current->MoreWarnings) + " more warnings");
  }
}
