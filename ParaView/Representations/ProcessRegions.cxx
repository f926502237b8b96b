// SPDX-License-Identifier: BSD-3-Clause
#include "ProcessRegions.h"

#include "AllProcesses.h"
#include "Geometry/SeparatingNormal.h"

#include "vtkCellTypes.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
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

using Points = std::vector<std::array<double, 3>>;

double Dot(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Points CollectDrawnPoints(vtkUnstructuredGrid* grid)
{
  const std::vector<bool> drawn = MarkDrawnPoints(grid);
  Points points;
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
std::vector<SetExtents> FindExtents(const Points& points, const Points& directions)
{
  std::vector<double> mine;
  for (const std::array<double, 3>& direction : directions)
  {
    SetExtent extent;
    for (const std::array<double, 3>& point : points)
    {
      const double along = Dot(direction, point);
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

/// How often planes between two processes are tried at most. Each that fails adds corners of their
/// hulls; where they touch, three common corners are enough.
constexpr int MostTrials = 20;

/// Appends the points that are farthest along each direction, of each process to its corners.
void AddCorners(const Points& points, const Points& directions, std::vector<Points>& corners)
{
  std::vector<double> mine;
  for (const std::array<double, 3>& direction : directions)
  {
    const auto isLess = [&](const auto& a, const auto& b)
    { return Dot(direction, a) < Dot(direction, b); };
    const auto ends = std::minmax_element(points.begin(), points.end(), isLess);
    constexpr std::array<double, 3> None = { NAN, NAN, NAN };
    for (const auto& end : { ends.first, ends.second })
    {
      const std::array<double, 3>& corner = points.empty() ? None : *end;
      mine.insert(mine.end(), corner.begin(), corner.end());
    }
  }
  const std::vector<double> all = Gather(mine);
  corners.resize(all.size() / mine.size());
  for (std::size_t i = 0; i < all.size(); i += 3)
  {
    if (!std::isnan(all[i]))
    {
      corners[i / mine.size()].push_back({ all[i], all[i + 1], all[i + 2] });
    }
  }
}

/// Whether a known direction parts two processes, of which both have points.
bool ArePartedBy(const std::vector<SetExtents>& extents, std::size_t a, std::size_t b)
{
  return std::any_of(extents.begin(), extents.end(),
    [&](const SetExtents& along)
    {
      const SetExtent& first = along.Sets[a];
      const SetExtent& second = along.Sets[b];
      const double size =
        std::max(first.Greatest, second.Greatest) - std::min(first.Least, second.Least);
      return std::max(first.Least, second.Least) >=
        std::min(first.Greatest, second.Greatest) - SeparationOverlap * size;
    });
}

/// Normals of planes between processes that no known direction parts, by what is known of their
/// corners. Nothing if there is none between some of them.
std::optional<Points> FindNormals(
  const std::vector<SetExtents>& extents, const std::vector<Points>& corners)
{
  Points normals;
  for (std::size_t a = 0; a < corners.size(); ++a)
  {
    for (std::size_t b = a + 1; b < corners.size(); ++b)
    {
      if (corners[a].empty() || corners[b].empty() || ArePartedBy(extents, a, b))
      {
        continue;
      }
      std::array<double, 3> normal;
      if (!FindSeparatingNormal(corners[a], corners[b], normal))
      {
        return std::nullopt;
      }
      normals.push_back(normal);
    }
  }
  return normals;
}

/// Adds the extents along normals of planes that part processes. Stops where there are none.
void AddObliqueExtents(const Points& points, std::vector<SetExtents>& extents)
{
  std::vector<Points> corners;
  Points directions; // of a cube's faces, edges and corners, one of each two opposite ones
  for (const double x : { -1., 0., 1. })
  {
    for (const double y : { -1., 0., 1. })
    {
      for (const double z : { -1., 0., 1. })
      {
        if (std::array<double, 3>{ x, y, z } > std::array<double, 3>{})
        {
          directions.push_back({ x, y, z });
        }
      }
    }
  }
  for (int trial = 0; trial < MostTrials; ++trial)
  {
    AddCorners(points, directions, corners);
    const std::optional<Points> normals = FindNormals(extents, corners);
    if (!normals || normals->empty())
    {
      return;
    }
    directions = *normals;
    const std::vector<SetExtents> more = FindExtents(points, directions);
    extents.insert(extents.end(), more.begin(), more.end());
  }
}

} // namespace

ProcessRegions FindProcessRegions(vtkUnstructuredGrid* mine, bool oblique)
{
  const Points points = CollectDrawnPoints(mine);
  std::vector<SetExtents> extents = FindExtents(points, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } });
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
  if (curved)
  {
    return regions;
  }
  if (planes->Find(extents))
  {
    regions.Bounds = planes->CutBox(process, whole);
    regions.Planes = planes;
  }
  else if (oblique)
  {
    AddObliqueExtents(points, extents);
    if (planes->Find(extents))
    {
      regions.Planes = planes;
    }
  }
  return regions;
}

} // namespace tetralux
