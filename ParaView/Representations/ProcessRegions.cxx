// SPDX-License-Identifier: BSD-3-Clause
#include "ProcessRegions.h"

#include "AllProcesses.h"

#include "vtkCellTypes.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <vector>

namespace tetralux
{

namespace
{

/// For each point, whether a cell that is drawn has it.
std::vector<bool> MarkDrawnPoints(vtkUnstructuredGrid* grid)
{
  constexpr unsigned char NotDrawn = vtkDataSetAttributes::DUPLICATECELL |
    vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  std::vector<bool> drawn(grid->GetNumberOfPoints());
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    if (ghosts && (ghosts->GetValue(cell) & NotDrawn) != 0)
    {
      continue;
    }
    grid->GetCellPoints(cell, points);
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      drawn[points->GetId(i)] = true;
    }
  }
  return drawn;
}

std::vector<std::array<double, 3>> CollectDrawnPoints(vtkUnstructuredGrid* grid)
{
  const std::vector<bool> drawn = MarkDrawnPoints(grid);
  std::vector<std::array<double, 3>> points;
  for (std::size_t i = 0; i < drawn.size(); ++i)
  {
    if (drawn[i])
    {
      points.emplace_back();
      grid->GetPoint(static_cast<vtkIdType>(i), points.back().data());
    }
  }
  return points;
}

bool HasCurvedCells(vtkUnstructuredGrid* grid)
{
  vtkUnsignedCharArray* types = grid->GetDistinctCellTypesArray();
  for (vtkIdType i = 0; i < types->GetNumberOfValues(); ++i)
  {
    if (!vtkCellTypes::IsLinear(types->GetValue(i)))
    {
      return true;
    }
  }
  return false;
}

/// Along some directions, of all processes.
std::vector<SetExtents> FindExtents(const std::vector<std::array<double, 3>>& points,
  const std::vector<std::array<double, 3>>& directions)
{
  std::vector<double> mine;
  for (const std::array<double, 3>& direction : directions)
  {
    SetExtent extent;
    for (const std::array<double, 3>& point : points)
    {
      const double along =
        direction[0] * point[0] + direction[1] * point[1] + direction[2] * point[2];
      extent.Least = std::min(extent.Least, along);
      extent.Greatest = std::max(extent.Greatest, along);
    }
    mine.insert(mine.end(), { extent.Least, extent.Greatest });
  }
  const std::vector<double> all = Gather(mine);
  const std::size_t processes = all.size() / mine.size();
  std::vector<SetExtents> extents;
  for (std::size_t d = 0; d < directions.size(); ++d)
  {
    extents.push_back({ directions[d], {} });
    for (std::size_t process = 0; process < processes; ++process)
    {
      const double* extent = &all[process * mine.size() + 2 * d];
      extents.back().Sets.push_back({ extent[0], extent[1] });
    }
  }
  return extents;
}

} // namespace

ProcessRegions FindProcessRegions(vtkUnstructuredGrid* mine)
{
  const std::vector<std::array<double, 3>> points = CollectDrawnPoints(mine);
  const std::vector<SetExtents> extents =
    FindExtents(points, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } });
  ProcessRegions regions;
  std::array<double, 6> whole;
  const int process = GetProcess();
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<SetExtent>& of = extents[axis].Sets;
    regions.Bounds[2 * axis] = of[process].Least;
    regions.Bounds[2 * axis + 1] = of[process].Greatest;
    SetExtent all;
    for (const SetExtent& extent : of)
    {
      all.Least = std::min(all.Least, extent.Least);
      all.Greatest = std::max(all.Greatest, extent.Greatest);
    }
    whole[2 * axis] = all.Least;
    whole[2 * axis + 1] = all.Greatest;
  }
  const std::vector<SetExtent>& of = extents.front().Sets;
  const auto isEmpty = [](const SetExtent& extent) { return extent.IsEmpty(); };
  regions.AllHaveCells = std::none_of(of.begin(), of.end(), isEmpty);
  if (std::all_of(of.begin(), of.end(), isEmpty))
  {
    vtkMath::UninitializeBounds(regions.Bounds.data());
    return regions;
  }
  const bool curved = Add(HasCurvedCells(mine) ? 1 : 0) > 0;
  auto planes = std::make_shared<SeparatingPlanes>();
  if (!curved && planes->Find(extents))
  {
    regions.Bounds = planes->CutBox(process, whole);
    regions.Planes = planes;
  }
  return regions;
}

} // namespace tetralux
