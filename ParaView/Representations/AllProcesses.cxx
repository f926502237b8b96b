// SPDX-License-Identifier: BSD-3-Clause
#include "AllProcesses.h"

#include "vtkCommunicator.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <limits>

namespace tetralux
{

bool IsParallel()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1;
}

int GetProcess()
{
  return IsParallel() ? vtkMultiProcessController::GetGlobalController()->GetLocalProcessId() : 0;
}

double Add(double mine)
{
  double sum = mine;
  if (IsParallel())
  {
    vtkMultiProcessController::GetGlobalController()->AllReduce(
      &mine, &sum, 1, vtkCommunicator::SUM_OP);
  }
  return sum;
}

void UniteBounds(const double* mine, double united[6])
{
  // Least values, and greatest ones with the other sign.
  double values[6], least[6];
  std::fill_n(values, 6, std::numeric_limits<double>::max());
  if (mine && vtkMath::AreBoundsInitialized(mine))
  {
    for (int i = 0; i < 6; ++i)
    {
      values[i] = i % 2 == 0 ? mine[i] : -mine[i];
    }
  }
  std::copy_n(values, 6, least);
  if (IsParallel())
  {
    vtkMultiProcessController::GetGlobalController()->AllReduce(
      values, least, 6, vtkCommunicator::MIN_OP);
  }
  for (int i = 0; i < 6; ++i)
  {
    united[i] = i % 2 == 0 ? least[i] : -least[i];
  }
}

std::vector<double> Gather(const std::vector<double>& mine)
{
  if (!IsParallel())
  {
    return mine;
  }
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  std::vector<double> all(mine.size() * controller->GetNumberOfProcesses());
  controller->AllGather(mine.data(), all.data(), static_cast<vtkIdType>(mine.size()));
  return all;
}

} // namespace tetralux
