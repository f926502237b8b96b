// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/TableRays.h"

#include "PreIntegration/PreIntegrationError.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tetralux
{
namespace
{

/// Nodes within the scalars of a sample, and the middles between them, where tables on the nodes
/// are most wrong; a part of them, evenly, where they are many.
std::vector<double> FindNodes(
  const TransferFunction& function, const double range[2], std::size_t most)
{
  std::vector<double> nodes;
  const auto add = [&nodes, range](double scalar)
  {
    if (range[0] < scalar && scalar < range[1])
    {
      nodes.push_back(scalar);
    }
  };
  for (std::size_t k = 0; k < function.Nodes.size(); ++k)
  {
    if (k > 0)
    {
      add(0.5 * (function.Nodes[k - 1].Scalar + function.Nodes[k].Scalar));
    }
    add(function.Nodes[k].Scalar);
  }
  const std::size_t step = nodes.size() / std::max<std::size_t>(most, 1) + 1;
  for (std::size_t k = 0; k * step < nodes.size(); ++k)
  {
    nodes[k] = nodes[k * step];
  }
  nodes.resize((nodes.size() + step - 1) / step);
  return nodes;
}

/// Those rays of a sample that come nearest to running along a node of the function, moved onto it:
/// the scalars of a segment get the node in their middle, at their lower end, or at their upper
/// end, by turns. Tables are most wrong next to bends and steps, along which the worst rays of a
/// picture run, and none of a sample by chance. A step is wrong by different parts of its height on
/// both sides.
std::vector<std::vector<RaySegment>> MoveOntoNodes(
  const TransferFunction& function, const RaySample& sample)
{
  double range[2] = { std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  for (const std::vector<RaySegment>& ray : sample.Rays)
  {
    for (const RaySegment& segment : ray)
    {
      range[0] = std::min({ range[0], segment.Front, segment.Back });
      range[1] = std::max({ range[1], segment.Front, segment.Back });
    }
  }
  // A quarter of the sample, as many rays for each node.
  const std::size_t most = sample.Rays.size() / 4;
  const std::vector<double> nodes = FindNodes(function, range, most);
  const std::size_t count = nodes.empty() ? 0 : std::max<std::size_t>(most / nodes.size(), 1);
  std::vector<std::vector<RaySegment>> moved(count * nodes.size());
  // All rays are searched for each of a few nodes, a part of them for each of many.
  constexpr std::size_t FewNodes = 32;
  const std::size_t step = nodes.size() / FewNodes + 1;
  struct Near
  {
    double Distance; ///< of the farther end from the node, scalars for each unit of length
    std::size_t Ray, Segment;
  };
  const auto n = static_cast<std::ptrdiff_t>(nodes.size());
#pragma omp parallel for schedule(dynamic)
  for (std::ptrdiff_t k = 0; k < n; ++k)
  {
    // The nearest segment of each ray, and of those the nearest.
    std::vector<Near> nearest;
    for (std::size_t i = static_cast<std::size_t>(k) % step; i < sample.Rays.size(); i += step)
    {
      Near near{ std::numeric_limits<double>::infinity(), i, 0 };
      for (std::size_t j = 0; j < sample.Rays[i].size(); ++j)
      {
        const RaySegment& segment = sample.Rays[i][j];
        const double distance =
          std::max(std::abs(segment.Front - nodes[k]), std::abs(segment.Back - nodes[k])) /
          segment.Length;
        near = distance < near.Distance ? Near{ distance, i, j } : near;
      }
      if (!sample.Rays[i].empty())
      {
        nearest.push_back(near);
      }
    }
    const std::size_t found = std::min(count, nearest.size());
    std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(found),
      nearest.end(), [](const Near& a, const Near& b) { return a.Distance < b.Distance; });
    for (std::size_t i = 0; i < found; ++i)
    {
      // The nearest ones of all nodes first: the worst should come early.
      std::vector<RaySegment>& ray = moved[i * nodes.size() + static_cast<std::size_t>(k)];
      ray = sample.Rays[nearest[i].Ray];
      const RaySegment& segment = ray[nearest[i].Segment];
      const double places[] = { 0.5 * (segment.Front + segment.Back),
        std::min(segment.Front, segment.Back), std::max(segment.Front, segment.Back) };
      const double shift = nodes[k] - places[i % 3];
      for (RaySegment& s : ray)
      {
        s.Front = std::clamp(s.Front + shift, range[0], range[1]);
        s.Back = std::clamp(s.Back + shift, range[0], range[1]);
      }
    }
  }
  return moved;
}

} // namespace

TableRays::TableRays(const TransferFunction& function, const RaySample& sample)
  : LargestColor(GetLargestColor(function))
  , Rays(MoveOntoNodes(function, sample))
{
  this->Rays.insert(this->Rays.end(), sample.Rays.begin(), sample.Rays.end());
  this->Seen.resize(this->Rays.size());
  const auto n = static_cast<std::ptrdiff_t>(this->Rays.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::ptrdiff_t i = 0; i < n; ++i)
  {
    const std::vector<RaySegment>& ray = this->Rays[i];
    this->Seen[i].resize(ray.size());
    SegmentRadiance behind;
    for (std::size_t k = ray.size(); k-- > 0;)
    {
      SegmentRadiance seen =
        IntegrateEmissionAbsorption(function, ray[k].Front, ray[k].Back, ray[k].Length);
      seen.AddBehind(behind);
      this->Seen[i][k] = behind = seen;
    }
  }
}

double TableRays::Estimate(const PreIntegrationTable& table, double allowed) const
{
  const double worst = this->Measure(this->Rays.size(), allowed / WorseInPictures,
    [&table](double front, double back, double length, float rgba[4])
    { table.Lookup(front, back, length, rgba); });
  const double estimate = WorseInPictures * worst;
  // More than all of a channel no picture is wrong by.
  return estimate <= allowed ? std::min(estimate, std::max(this->LargestColor, 1.))
                             : std::numeric_limits<double>::infinity();
}

double EstimatePictureError(
  const TransferFunction& function, const PreIntegrationTable& table, const RaySample& rays)
{
  constexpr double Any = std::numeric_limits<double>::infinity();
  return TableRays(function, rays).Estimate(table, Any);
}

} // namespace tetralux
