// SPDX-License-Identifier: BSD-3-Clause
#include "ThreadShare.h"

#include "vtkMultiProcessController.h"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace tetralux
{

namespace
{

/// Processes of this run on this machine, as the launchers of Open MPI and MPICH tell; else all.
int GetLocalProcesses(int processes)
{
  for (const char* name : { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS" })
  {
    const char* text = std::getenv(name);
    const int local = text ? std::atoi(text) : 0;
    if (local > 0)
    {
      return local;
    }
  }
  return processes;
}

} // namespace

void ShareThreads()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const int processes = controller ? controller->GetNumberOfProcesses() : 1;
  if (processes < 2 || std::getenv("OMP_NUM_THREADS"))
  {
    return;
  }
  const int cores = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  const int share = std::max(1, cores / GetLocalProcesses(processes));
  // A launcher that binds processes leaves fewer.
  omp_set_num_threads(std::min(share, omp_get_num_procs()));
}

} // namespace tetralux
