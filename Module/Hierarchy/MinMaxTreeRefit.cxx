// SPDX-License-Identifier: BSD-3-Clause
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

/// How far single precision moves a number at most, as a share of it. A little more than half of
/// its epsilon, for what double precision rounds here.
constexpr double Rounding = 0x1p-24 * (1 + 0x1p-20);

/// And where it is not a normal number.
constexpr double SmallestRounding = std::numeric_limits<float>::denorm_min();

/// Single precision at or below a number, at most two steps. Faster than to look for the next one.
float RoundDown(double x)
{
  constexpr double Largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::min(x - (Rounding * std::abs(x) + SmallestRounding), Largest));
}

/// Single precision at or above a number.
float RoundUp(double x) { return -RoundDown(-x); }

} // namespace

void RefitMinMaxTree(MinMaxTree& tree, const TetrahedralMesh& mesh, const double center[3],
  double radius, int numberOfThreads)
{
  VisitUpward(tree, CountThreads(numberOfThreads),
    [&](std::int32_t nodeId)
    {
      MinMaxTree::Node& node = tree.Nodes[nodeId];
      if (node.Count == 0)
      {
        const MinMaxTree::Node& first = tree.Nodes[nodeId + 1];
        const MinMaxTree::Node& second = tree.Nodes[node.First];
        for (int a = 0; a < 3; ++a)
        {
          node.Lower[a] = std::min(first.Lower[a], second.Lower[a]);
          node.Upper[a] = std::max(first.Upper[a], second.Upper[a]);
        }
        return;
      }
      PrefetchCells(tree, mesh, node);
      // Differences and quotients are monotonic: only those of the extremes are needed.
      constexpr double Largest = std::numeric_limits<double>::max();
      double lower[3] = { Largest, Largest, Largest };
      double upper[3] = { -Largest, -Largest, -Largest };
      for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
      {
        const std::int32_t* ids = &mesh.Cells[std::size_t{ 4 } * tree.Cells[i]];
        for (int corner = 0; corner < 4; ++corner)
        {
          const double* x = &mesh.Points[std::size_t{ 3 } * ids[corner]];
          for (int a = 0; a < 3; ++a)
          {
            lower[a] = std::min(lower[a], x[a]);
            upper[a] = std::max(upper[a], x[a]);
          }
        }
      }
      for (int a = 0; a < 3; ++a)
      {
        node.Lower[a] = RoundDown((lower[a] - center[a]) / radius);
        node.Upper[a] = RoundUp((upper[a] - center[a]) / radius);
      }
    });
}

} // namespace tetralux
