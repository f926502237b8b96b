// SPDX-License-Identifier: BSD-3-Clause
#ifndef ProgressLine_h
#define ProgressLine_h

#include <chrono>
#include <string>
#include <utility>
#include <vector>

class vtkObject;

/// One line on standard error that tells what the tool does and how far it is, for work that takes
/// long. It is shown only if standard error is a terminal, and erased with the object.
class ProgressLine
{
public:
  explicit ProgressLine(const std::string& label);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// fraction: 0..1. Work that is done within half a second shows no line.
  void Show(double fraction);

  /// Shows the label at once, for work that can't tell how far it is.
  void ShowLabel();

  /// Shows the fraction that comes with an event of an object, such as ProgressEvent. The object
  /// must outlive this one.
  void Observe(vtkObject* object, unsigned long event);

private:
  std::string Label;
  bool IsTerminal;
  bool Shown = false;
  int ShownPercent = -1;
  std::chrono::steady_clock::time_point Start;
  std::vector<std::pair<vtkObject*, unsigned long>> Observers; ///< with their tags
};

#endif
