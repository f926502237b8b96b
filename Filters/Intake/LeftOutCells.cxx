// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/LeftOutCells.h"

namespace tetralux
{

std::vector<LeftOutCells> ListLeftOutCells(
  const TetrahedraIntakeReport& report, const RemovedCells& removed)
{
  std::vector<LeftOutCells> list;
  if (report.GetNumberOfSkippedCells() > 0)
  {
    list.push_back({ "cells of types that can't be rendered", report.DescribeSkippedCells() });
  }
  const auto add = [&list](const char* reason, std::int64_t count)
  {
    if (count > 0)
    {
      list.push_back({ reason, std::to_string(count) });
    }
  };
  add("cells with missing or unusable points", report.InvalidCells + removed.InvalidPointIds);
  add("tetrahedra with coordinates that are not finite", removed.NonFiniteCoordinates);
  add("tetrahedra with a repeated point", removed.RepeatedPoints);
  add("tetrahedra that are there already", removed.Duplicates);
  return list;
}

std::string DescribeLeftOutCells(const TetrahedraIntakeReport& report, const RemovedCells& removed)
{
  std::string text;
  for (const LeftOutCells& cells : ListLeftOutCells(report, removed))
  {
    text += (text.empty() ? "left out: " : "; ") + cells.Reason + ": " + cells.Count;
  }
  return text;
}

std::string DescribeFoldedCells(const TetrahedraIntakeReport& report)
{
  return report.FoldedCells == 0 ? std::string()
                                 : std::to_string(report.FoldedCells) +
      " polyhedra could not be divided: no point sees all of their faces from inside, not even of "
      "what tetrahedra between their corners leave; their tetrahedra overlap";
}

} // namespace tetralux
