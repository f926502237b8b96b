// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TaskThread_h
#define tetralux_TaskThread_h

#include "TetraluxCoreModule.h"

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace tetralux
{

/// A thread beside the one that uses it. It runs one task at a time, and lasts: OpenMP makes a team
/// for each thread that has parallel work, and that takes longer than a short task. A task has as
/// many OpenMP threads as the thread that started it.
class TETRALUXCORE_EXPORT TaskThread
{
public:
  TaskThread() = default;
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;
  ~TaskThread();

  /// Starts a task. The last one must have been waited for.
  void Start(std::function<void()> task);

  /// Waits for the task, if there is one, and throws what it threw.
  void Wait();

  /// Waits at the end of a block, however that is left.
  class Scope
  {
  public:
    explicit Scope(TaskThread& thread)
      : Thread(thread)
    {
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() { this->Thread.WaitUntilIdle(); }

  private:
    TaskThread& Thread;
  };

private:
  void WaitUntilIdle();
  void Run();

  std::mutex Mutex;
  std::condition_variable Changed;
  std::function<void()> Task; ///< none: nothing to do
  std::exception_ptr Failure; ///< of the last task
  int Threads = 1;            ///< of OpenMP for the task
  bool Ending = false;
  std::thread Thread; ///< started with the first task
};

} // namespace tetralux

#endif
