// SPDX-License-Identifier: BSD-3-Clause
#include "Base/CountingSort.h"
#include "Hierarchy/MinMaxTree.h"
#include "Hierarchy/MinMaxTreeUpward.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tetralux
{
namespace
{

constexpr int LargestStep = std::numeric_limits<std::uint16_t>::max();

/// No scalar: neutral where ranges are joined.
constexpr MinMaxTree::Range EmptyRange = { LargestStep, 0 };

MinMaxTree::Range Join(MinMaxTree::Range a, MinMaxTree::Range b)
{
  return { std::min(a.Least, b.Least), std::max(a.Largest, b.Largest) };
}

/// Offset and scale for all scalars that are finite.
void SetUnits(MinMaxRanges& ranges, Span<const double> scalars, int numberOfThreads)
{
  constexpr double Largest = std::numeric_limits<double>::max();
  double lower = Largest;
  double upper = -Largest;
  const auto size = static_cast<std::int64_t>(scalars.size());
#pragma omp parallel for schedule(static) num_threads(numberOfThreads) reduction(min               \
                                                                                 : lower)          \
  reduction(max                                                                                    \
            : upper)
  for (std::int64_t p = 0; p < size; ++p)
  {
    if (std::isfinite(scalars[p]))
    {
      lower = std::min(lower, scalars[p]);
      upper = std::max(upper, scalars[p]);
    }
  }
  if (lower > upper)
  {
    return;
  }
  ranges.Offset = lower;
  // A quotient that overflows, as where all scalars are equal, becomes the largest number.
  const double width = std::min(upper - lower, Largest);
  ranges.Scale = std::min(LargestStep / width, Largest);
  // The quotient is rounded; the largest scalar must not lie above the largest step.
  while (width * ranges.Scale > LargestStep)
  {
    ranges.Scale = std::nextafter(ranges.Scale, 0.);
  }
}

} // namespace

MinMaxRanges::Steps MinMaxRanges::GetSteps(double value) const
{
  if (std::isnan(value))
  {
    return { -1, LargestStep + 1 };
  }
  constexpr double Largest = std::numeric_limits<double>::max();
  const double steps = std::clamp(value - this->Offset, -Largest, Largest) * this->Scale;
  const double inside = std::clamp(steps, -1., LargestStep + 1.);
  return { static_cast<std::int32_t>(std::floor(inside)),
    static_cast<std::int32_t>(std::ceil(inside)) };
}

MinMaxRanges MakeMinMaxRanges(const MinMaxTree& tree, const TetrahedralMesh& mesh,
  Span<const double> scalars, int numberOfThreads)
{
  const int threads = CountThreads(numberOfThreads);
  MinMaxRanges ranges;
  SetUnits(ranges, scalars, threads);
  // Rounded once for each point: a cell's corners are read in 4 bytes each then.
  const auto numberOfPoints = static_cast<std::int64_t>(scalars.size());
  const auto points = NewArray<MinMaxTree::Range>(numberOfPoints);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t p = 0; p < numberOfPoints; ++p)
  {
    points[p] = EmptyRange;
    if (std::isfinite(scalars[p]))
    {
      const MinMaxRanges::Steps steps = ranges.GetSteps(scalars[p]);
      points[p] = { static_cast<std::uint16_t>(steps.Down), static_cast<std::uint16_t>(steps.Up) };
    }
  }

  ranges.Nodes.resize(tree.Nodes.size());
  VisitUpward(tree, threads,
    [&](std::int32_t nodeId)
    {
      const MinMaxTree::Node& node = tree.Nodes[nodeId];
      if (node.Count == 0)
      {
        ranges.Nodes[nodeId] = Join(ranges.Nodes[nodeId + 1], ranges.Nodes[node.First]);
        return;
      }
      MinMaxTree::Range range = EmptyRange;
      for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
      {
        const std::int32_t* ids = &mesh.Cells[std::size_t{ 4 } * tree.Cells[i]];
        MinMaxTree::Range cell = points[ids[0]];
        bool isFinite = cell.Least <= cell.Largest;
        for (int corner = 1; corner < 4; ++corner)
        {
          const MinMaxTree::Range point = points[ids[corner]];
          isFinite &= point.Least <= point.Largest;
          cell = Join(cell, point);
        }
        range = isFinite ? Join(range, cell) : range;
      }
      ranges.Nodes[nodeId] = range;
    });
  return ranges;
}

} // namespace tetralux
