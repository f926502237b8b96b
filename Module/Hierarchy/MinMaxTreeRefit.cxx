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

float RoundDown(double x)
{
  const auto rounded = static_cast<float>(x);
  return rounded > x ? std::nextafter(rounded, std::numeric_limits<float>::lowest()) : rounded;
}

float RoundUp(double x)
{
  const auto rounded = static_cast<float>(x);
  return rounded < x ? std::nextafter(rounded, std::numeric_limits<float>::max()) : rounded;
}

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
