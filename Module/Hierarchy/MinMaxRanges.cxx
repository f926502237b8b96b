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

/// Stands for the step of a scalar that is not finite: above all others.
constexpr std::uint16_t NoStep = MinMaxRanges::LargestStep + 1;

/// No scalar: neutral where ranges are joined.
constexpr MinMaxTree::Range EmptyRange = { NoStep, 0 };

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
#pragma omp parallel num_threads(numberOfThreads)
#pragma omp for schedule(static) reduction(min : lower) reduction(max : upper)
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
  const double width = std::min(upper - lower, Largest);
  // A quotient that would overflow, as where all scalars are equal, is the largest number.
  constexpr double SmallestWidth = MinMaxRanges::LargestStep / Largest;
  ranges.Scale = width > SmallestWidth ? MinMaxRanges::LargestStep / width : Largest;
}

} // namespace

std::int32_t MinMaxRanges::GetStep(double value) const
{
  if (std::isnan(value))
  {
    return -1;
  }
  constexpr double Largest = std::numeric_limits<double>::max();
  const double step = std::clamp(value - this->Offset, -Largest, Largest) * this->Scale;
  return static_cast<std::int32_t>(std::floor(std::clamp(step, -1., LargestStep + 1.)));
}

MinMaxRanges MakeMinMaxRanges(const MinMaxTree& tree, const TetrahedralMesh& mesh,
  Span<const double> scalars, int numberOfThreads)
{
  const int threads = CountThreads(numberOfThreads);
  MinMaxRanges ranges;
  SetUnits(ranges, scalars, threads);
  // Once for each point: a cell's corners are read in two bytes each then.
  const auto numberOfPoints = static_cast<std::int64_t>(scalars.size());
  const auto steps = NewArray<std::uint16_t>(numberOfPoints);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t p = 0; p < numberOfPoints; ++p)
  {
    steps[p] =
      std::isfinite(scalars[p]) ? static_cast<std::uint16_t>(ranges.GetStep(scalars[p])) : NoStep;
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
      PrefetchCells(tree, mesh, node);
      MinMaxTree::Range range = EmptyRange;
      for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
      {
        const std::int32_t* ids = &mesh.Cells[std::size_t{ 4 } * tree.Cells[i]];
        MinMaxTree::Range cell = EmptyRange;
        for (int corner = 0; corner < 4; ++corner)
        {
          const std::uint16_t step = steps[ids[corner]];
          cell = Join(cell, { step, step });
        }
        range = Join(range, cell.Largest == NoStep ? EmptyRange : cell);
      }
      ranges.Nodes[nodeId] = range;
    });
  return ranges;
}

} // namespace tetralux
