// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OnceWarning_h
#define tetralux_OnceWarning_h

#include "vtkObject.h"

#include <string>

namespace tetralux
{

/// A warning that may be due in every frame, and is given once: not again before it was another
/// one, or none.
class OnceWarning
{
public:
  /// warning: one line, empty where all is well. source: who gives it.
  void Update(vtkObject* source, const std::string& warning)
  {
    this->Update(source, warning, warning);
  }

  /// cause: what the warning is about, if its numbers differ from frame to frame.
  void Update(vtkObject* source, const std::string& warning, const std::string& cause)
  {
    if (cause == this->Last)
    {
      return;
    }
    this->Last = cause;
    if (!warning.empty())
    {
      vtkWarningWithObjectMacro(source, << warning);
    }
  }

private:
  std::string Last;
};

} // namespace tetralux

#endif
