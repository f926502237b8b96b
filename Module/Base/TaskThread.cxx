// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TaskThread.h"

#include "Base/Check.h"

#include <utility>

#include <omp.h>

namespace tetralux
{

TaskThread::~TaskThread()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Ending = true;
  }
  this->Changed.notify_all();
  if (this->Thread.joinable())
  {
    this->Thread.join();
  }
}

void TaskThread::Start(std::function<void()> task)
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    TETRALUX_CHECK(!this->Task);
    this->Task = std::move(task);
    this->Failure = nullptr;
    this->Threads = omp_get_max_threads();
  }
  if (!this->Thread.joinable())
  {
    this->Thread = std::thread(&TaskThread::Run, this);
  }
  this->Changed.notify_all();
}

void TaskThread::Wait()
{
  this->WaitUntilIdle();
  if (const std::exception_ptr failure = std::exchange(this->Failure, nullptr))
  {
    std::rethrow_exception(failure);
  }
}

void TaskThread::WaitUntilIdle()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->Changed.wait(lock, [this] { return !this->Task; });
}

void TaskThread::Run()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  while (true)
  {
    this->Changed.wait(lock, [this] { return this->Task || this->Ending; });
    if (!this->Task)
    {
      return;
    }
    omp_set_num_threads(this->Threads);
    lock.unlock();
    std::exception_ptr failure;
    try
    {
      this->Task();
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    lock.lock();
    this->Failure = failure;
    this->Task = nullptr;
    this->Changed.notify_all();
  }
}

} // namespace tetralux
