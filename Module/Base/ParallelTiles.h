// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ParallelTiles_h
#define tetralux_ParallelTiles_h

// The tiles of a picture over the threads of OpenMP, with progress, abort and exceptions.

#include "Base/Tile.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>

#include <omp.h>

namespace tetralux
{

/// Between two reports of progress: short for a user who wants to abort, long for the work.
constexpr std::chrono::milliseconds ReportInterval(5);

/// Between two looks of the calling thread at whether others have finished their last tiles: a
/// small part of a frame of some milliseconds.
constexpr std::chrono::microseconds WaitInterval(100);

/// Calls cast(tile, thread) once for each tile. threads is at least 1; thread is in 0..threads - 1.
/// Calls with the same thread never overlap, so each can own memory.
///
/// progress may be empty. The calling thread alone calls it, at most once a ReportInterval, with
/// the share of tiles that are done. If it returns false, no further tile begins. Its last call is
/// with 1, when nothing is left to abort; an aborted picture has no such call.
///
/// Returns whether every tile was done. If cast or progress throws, no further tile begins. The
/// first exception reaches the caller after all threads have stopped.
template <class Cast>
bool ForEachTile(
  const TileGrid& grid, int threads, const std::function<bool(double)>& progress, const Cast& cast)
{
  using Clock = std::chrono::steady_clock;
  const int count = grid.GetCount();
  std::atomic<bool> stop{ false };
  std::atomic<int> done{ 0 };
  std::exception_ptr failure;
  bool aborted = false;
  Clock::time_point nextReport = Clock::now();
  const auto report = [&]()
  {
    if (omp_get_thread_num() != 0 || !progress || Clock::now() < nextReport)
    {
      return;
    }
    nextReport = Clock::now() + ReportInterval;
    if (!progress(static_cast<double>(done) / count))
    {
      aborted = true;
      stop = true;
    }
  };
  // No exception may leave the parallel region.
  const auto guard = [&](const auto& call)
  {
    try
    {
      call();
    }
    catch (...)
    {
#pragma omp critical(tetralux_tile_failure)
      failure = failure ? failure : std::current_exception();
      stop = true;
    }
  };

#pragma omp parallel num_threads(threads)
  {
#pragma omp for schedule(dynamic) nowait
    for (int i = 0; i < count; ++i)
    {
      if (!stop)
      {
        guard(
          [&]()
          {
            cast(grid.GetTile(i), omp_get_thread_num());
            ++done;
            report();
          });
      }
    }
    // The calling thread goes on reporting while others finish their tiles.
    while (omp_get_thread_num() == 0 && progress && !stop && done < count)
    {
      std::this_thread::sleep_for(WaitInterval);
      guard(report);
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  if (progress && !aborted)
  {
    progress(1);
  }
  return !aborted;
}

} // namespace tetralux

#endif
