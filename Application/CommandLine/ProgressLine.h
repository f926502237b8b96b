// SPDX-License-Identifier: BSD-3-Clause
#ifndef ProgressLine_h
#define ProgressLine_h

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

class vtkObject;

/// One line on standard error that tells what the tool does, for how long, and how far it is, for
/// work that takes long. A thread keeps it up to date, so that it also shows work that never says
/// how far it is. It is shown only if standard error is a terminal, and erased with the object.
/// Work that is done within half a second shows no line.
class ProgressLine
{
public:
  explicit ProgressLine(const std::string& label);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// fraction: 0..1.
  void Show(double fraction);

  /// Shows the fraction that comes with an event of an object, such as ProgressEvent. The object
  /// must outlive this one.
  void Observe(vtkObject* object, unsigned long event);

private:
  void KeepUpToDate();
  void Print();

  std::string Label;
  std::chrono::steady_clock::time_point Start;
  std::vector<std::pair<vtkObject*, unsigned long>> Observers; ///< with their tags

  std::thread Thread; ///< none if there is no terminal
  std::mutex Mutex;   ///< for all below
  std::condition_variable Change;
  int Percent = -1; ///< -1: not known
  bool Ends = false;
  bool Shown = false;
};

#endif
