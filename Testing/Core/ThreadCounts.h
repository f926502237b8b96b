// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ThreadCounts_h
#define tetralux_ThreadCounts_h

#include <gtest/gtest.h>

#include <omp.h>

#include <string>

/// Runs check() with several numbers of threads, more than there are cores among them.
template <class Check>
void ForEachThreadCount(const Check& check)
{
  const int before = omp_get_max_threads();
  for (const int count : { 1, 2, 3, 7 })
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, std::to_string(count) + " threads");
    omp_set_num_threads(count);
    check();
  }
  omp_set_num_threads(before);
}

#endif
