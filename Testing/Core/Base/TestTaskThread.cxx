// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TaskThread.h"

#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <omp.h>

namespace
{

using tetralux::TaskThread;

TEST(TaskThread, RunsTasksInOneOtherThread)
{
  TaskThread thread;
  std::thread::id ids[3];
  for (std::thread::id& id : ids)
  {
    thread.Start([&] { id = std::this_thread::get_id(); });
    thread.Wait();
  }
  EXPECT_NE(ids[0], std::this_thread::get_id());
  EXPECT_EQ(ids[1], ids[0]);
  EXPECT_EQ(ids[2], ids[0]);
}

TEST(TaskThread, HasTheThreadsOfWhoStartsATask)
{
  TaskThread thread;
  const int before = omp_get_max_threads();
  for (const int count : { 1, 3, 2 })
  {
    omp_set_num_threads(count);
    int used = 0;
    thread.Start(
      [&]
      {
#pragma omp parallel reduction(+ : used)
        ++used;
      });
    thread.Wait();
    EXPECT_EQ(used, count);
  }
  omp_set_num_threads(before);
}

TEST(TaskThread, ThrowsWhatATaskThrewAndGoesOn)
{
  TaskThread thread;
  thread.Start([] { throw std::runtime_error("no"); });
  EXPECT_THROW(thread.Wait(), std::runtime_error);
  EXPECT_NO_THROW(thread.Wait());
  bool ran = false;
  thread.Start([&] { ran = true; });
  thread.Wait();
  EXPECT_TRUE(ran);
}

TEST(TaskThread, ScopesWaitForATaskAndForgetWhatItThrew)
{
  TaskThread thread;
  bool ran = false;
  {
    const TaskThread::Scope scope(thread);
    thread.Start(
      [&]
      {
        ran = true;
        throw std::runtime_error("no");
      });
  }
  EXPECT_TRUE(ran);
  thread.Start([] {});
  EXPECT_NO_THROW(thread.Wait());
}

} // namespace
