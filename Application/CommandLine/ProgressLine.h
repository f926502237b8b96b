// SPDX-License-Identifier: BSD-3-Clause
#ifndef ProgressLine_h
#define ProgressLine_h

#include <chrono>
#include <string>
#include <utility>
#include <vector>

class vtkObject;

/// One line on standard error that says what is being done and how far it is, for work that takes
/// long; nothing where standard error is not a terminal. The line is gone when the object is.
class ProgressLine
{
public:
  explicit ProgressLine(const std::string& label);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// fraction: 0..1. Work that is done within half a second shows no line.
  void Show(double fraction);

  /// For work that can't say how far it is: shows the label at once.
  void ShowLabel();

  /// Shows the fraction that an object hands to its observers of an event, as ProgressEvent, while
  /// this object lives. The object must outlive this one.
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
