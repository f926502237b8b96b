// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/IntakeReport.h"

#include "vtkCellTypes.h"

#include <numeric>

namespace tetralux
{

std::int64_t TetrahedraIntakeReport::GetNumberOfSkippedCells() const
{
  return std::accumulate(this->SkippedByType.begin(), this->SkippedByType.end(), std::int64_t(0),
    [](std::int64_t sum, const auto& entry) { return sum + entry.second; });
}

std::string TetrahedraIntakeReport::DescribeSkippedCells() const
{
  std::string text;
  for (const auto& [type, count] : this->SkippedByType)
  {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + GetCellTypeName(type);
  }
  return text;
}

std::string GetCellTypeName(int cellType)
{
  const std::string name = vtkCellTypes::GetClassNameFromTypeId(cellType);
  return name == "UnknownClass" ? "cell type " + std::to_string(cellType) : name;
}

} // namespace tetralux
