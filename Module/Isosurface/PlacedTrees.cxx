// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/PlacedTrees.h"

#include <algorithm>

namespace tetralux
{
namespace
{

/// Bytes that the trees of a picture may take: those of some lights, or of the samples of one.
constexpr std::size_t LargestBytes = std::size_t{ 256 } << 20;

/// Nodes that a thread takes at a time: enough work beside what it costs to hand them out.
constexpr std::int64_t NodesOfTask = 256;

/// Fits the bounds of inner nodes to those of leaves.
void FitInnerNodes(const TraceTree& tree, std::size_t nodes, PlacedBounds* bounds)
{
  // Children come after their parents.
  for (std::size_t id = nodes; id-- > 0;)
  {
    const MinMaxTree::Node& node = tree.Nodes[id];
    for (int i = 0; node.Count == 0 && i < 8; ++i)
    {
      bounds[id].Values[i] = std::min(bounds[id + 1].Values[i], bounds[node.First].Values[i]);
    }
  }
}

} // namespace

void PlacedTrees::Start(const ActiveTree& active)
{
  this->Count = 0;
  this->Nodes = active.Nodes.size();
  this->Polygons = active.Polygons.size();
}

const PlacedTree* PlacedTrees::Add(
  const RayFrame& frame, const TraceLimits& limits, const double (&bounds)[4])
{
  const std::size_t bytes =
    this->Nodes * sizeof(PlacedBounds) + this->Polygons * (sizeof(PlacedBounds) + sizeof(Room));
  if ((this->Count + 1) * bytes > LargestBytes)
  {
    return nullptr;
  }
  if (this->Count == this->Entries.size())
  {
    this->Entries.emplace_back();
  }
  Entry& entry = this->Entries[this->Count++];
  entry.Frame = &frame;
  entry.Limits = &limits;
  std::copy_n(bounds, 4, entry.Bounds);
  return &entry.Tree;
}

void PlacedTrees::Fill(const TraceTree& tree, PlaceKernel kernel, int threads)
{
  this->Entries.resize(this->Count);
  const auto count = static_cast<std::int64_t>(this->Count);
  for (std::int64_t t = 0; t < count; ++t)
  {
    Entry& entry = this->Entries[t];
    entry.BoundsOfNodes.resize(this->Nodes);
    entry.BoundsOfPolygons.resize(this->Polygons);
    entry.Polygons.resize(this->Polygons);
    entry.Tree = { entry.BoundsOfNodes.data(), entry.BoundsOfPolygons.data(),
      entry.Polygons.data() };
  }
  const auto numberOfNodes = static_cast<std::int64_t>(this->Nodes);
  const std::int64_t tasks = (numberOfNodes + NodesOfTask - 1) / NodesOfTask;
#pragma omp parallel num_threads(threads)
  {
#pragma omp for schedule(dynamic)
    for (std::int64_t task = 0; task < count * tasks; ++task)
    {
      const Entry& entry = this->Entries[task / tasks];
      const std::int64_t first = task % tasks * NodesOfTask;
      const std::int64_t end = std::min(first + NodesOfTask, numberOfNodes);
      kernel(tree, *entry.Frame, *entry.Limits, entry.Bounds, static_cast<std::int32_t>(first),
        static_cast<std::int32_t>(end), entry.Tree);
    }
#pragma omp for schedule(dynamic)
    for (std::int64_t t = 0; t < count; ++t)
    {
      FitInnerNodes(tree, this->Nodes, this->Entries[t].Tree.Nodes);
    }
  }
}

} // namespace tetralux
