// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/WalkTexels.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tetralux
{

WalkTexels MakeWalkTexels(const WalkTables& tables, Span<const std::uint8_t> positive)
{
  if (tables.Entries.size() > std::numeric_limits<std::int32_t>::max() / 8)
  {
    throw std::length_error("the mesh has more boundary faces than a graphics card can be told of");
  }
  WalkTexels texels;
  texels.Entries.reserve(4 * tables.Entries.size());
  for (const std::int32_t entryId : tables.Bvh.Triangles)
  {
    const WalkEntry& entry = tables.Entries[entryId];
    const int face = (entry.Opposite > entry.Points[0]) + (entry.Opposite > entry.Points[1]) +
      (entry.Opposite > entry.Points[2]);
    std::int32_t first = entry.Points[0];
    std::int32_t second = entry.Points[1];
    // From the ascending points of the cell to those of the face, the opposite one behind them, the
    // orientation turns once for each point that the opposite one is moved past.
    if (!positive.empty() && (positive[entry.Cell] ^ ((3 - face) & 1)) == 0)
    {
      std::swap(first, second);
    }
    texels.Entries.insert(
      texels.Entries.end(), { first, second, entry.Points[2], 4 * entry.Cell + face });
  }
  texels.Boxes.reserve(8 * tables.Bvh.Nodes.size());
  for (const BoundaryBvh::Node& node : tables.Bvh.Nodes)
  {
    texels.Boxes.insert(texels.Boxes.end(),
      { node.Center[0], node.Center[1], node.Center[2], node.Half[0], node.Half[1], node.Half[2],
        0.f, 0.f });
  }
  texels.Links.reserve(2 * tables.Bvh.Nodes.size());
  for (const BoundaryBvh::Node& node : tables.Bvh.Nodes)
  {
    const bool leaf = node.Count > 0;
    texels.Links.push_back(leaf ? 0 : node.First);
    texels.Links.push_back(leaf ? 8 * node.First + node.Count : 0);
  }
  return texels;
}

} // namespace tetralux
