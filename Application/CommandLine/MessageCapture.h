// SPDX-License-Identifier: BSD-3-Clause
#ifndef MessageCapture_h
#define MessageCapture_h

#include "vtkOutputWindow.h"

#include <string>

/// Keeps VTK's messages from being printed while it lives, so that the tool can print them as lines
/// of its own. Captures do not nest.
class MessageCapture
{
public:
  MessageCapture();
  ~MessageCapture();
  MessageCapture(const MessageCapture&) = delete;
  MessageCapture& operator=(const MessageCapture&) = delete;

  /// Returns the first error since the construction, as one line without VTK's decoration; empty:
  /// no error.
  std::string GetError() const;

  /// Prints each different warning since the construction as one line on standard error.
  void PrintWarnings() const;

private:
  class Window;
  vtkOutputWindow* Previous;
  Window* Current;
};

#endif
