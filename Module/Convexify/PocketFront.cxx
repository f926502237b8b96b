// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/PocketFront.h"

#include "Base/DisjointSets.h"

#include <algorithm>
#include <tuple>

namespace tetralux
{
namespace
{

/// An edge of a triangle, from its smaller point id to its larger one.
struct FrontEdge
{
  std::int32_t Low, High;
  std::int32_t Apex;
  std::int32_t Triangle;
  bool RunsUp; ///< the triangle runs from Low to High: the empty space is counterclockwise of it
};

/// Sorts the triangles at an edge by their angle around it, from the first one on.
void SortAround(const ExactPoints& points, FrontEdge* begin, FrontEdge* end)
{
  const std::int32_t low = begin->Low;
  const std::int32_t high = begin->High;
  const std::int32_t first = begin->Apex;
  const int axis = points.FindProjection(low, high, first);
  const int firstSide = points.OrientProjected(low, high, first, axis);
  const auto getQuarter = [&](std::int32_t apex)
  {
    const int side = points.Orient(low, high, first, apex);
    if (side != 0)
    {
      return side > 0 ? 1 : 3;
    }
    return points.OrientProjected(low, high, apex, axis) == firstSide ? 0 : 2;
  };
  std::sort(begin, end,
    [&](const FrontEdge& edge0, const FrontEdge& edge1)
    {
      const int quarter0 = getQuarter(edge0.Apex);
      const int quarter1 = getQuarter(edge1.Apex);
      if (quarter0 != quarter1)
      {
        return quarter0 < quarter1;
      }
      return quarter0 % 2 != 0 && points.Orient(low, high, edge0.Apex, edge1.Apex) > 0;
    });
}

/// The volume that a part of a front encloses: negative for an island. Rounded: where that makes an
/// island of a thin pocket, it stays together with its neighbours.
double GetVolume(const ExactPoints& points, const Front& front)
{
  const double* origin = points[front[0][0]];
  double volume = 0;
  for (const Triangle& triangle : front)
  {
    double p[3][3];
    for (int i = 0; i < 3; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        p[i][a] = points[triangle[i]][a] - origin[a];
      }
    }
    volume -= p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
      p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
      p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return volume;
}

} // namespace

//----------------------------------------------------------------------------
std::vector<Front> SplitFront(const ExactPoints& points, const Front& triangles)
{
  std::vector<FrontEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t from = triangles[t][i];
      const std::int32_t to = triangles[t][(i + 1) % 3];
      edges.push_back({ std::min(from, to), std::max(from, to), triangles[t][(i + 2) % 3],
        static_cast<std::int32_t>(t), from < to });
    }
  }
  std::sort(edges.begin(), edges.end(),
    [](const FrontEdge& edge0, const FrontEdge& edge1)
    {
      return std::tie(edge0.Low, edge0.High, edge0.Triangle) <
        std::tie(edge1.Low, edge1.High, edge1.Triangle);
    });

  DisjointSets sets(triangles.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end)
  {
    for (end = begin; end < edges.size() && edges[end].Low == edges[begin].Low &&
         edges[end].High == edges[begin].High;)
    {
      ++end;
    }
    if (end - begin > 2)
    {
      SortAround(points, &edges[begin], &edges[begin] + (end - begin));
    }
    for (std::size_t i = begin; i < end; ++i)
    {
      const FrontEdge& edge = edges[i];
      const FrontEdge& next = edges[i + 1 < end ? i + 1 : begin];
      if (edge.RunsUp == next.RunsUp)
      {
        return {};
      }
      if (edge.RunsUp)
      {
        sets.Unite(edge.Triangle, next.Triangle);
      }
    }
  }

  std::vector<Front> fronts;
  std::vector<std::int32_t> numbers(triangles.size(), -1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    std::int32_t& number = numbers[sets.Find(static_cast<std::int32_t>(t))];
    if (number < 0)
    {
      number = static_cast<std::int32_t>(fronts.size());
      fronts.emplace_back();
    }
    fronts[number].push_back(triangles[t]);
  }
  if (std::any_of(fronts.begin(), fronts.end(),
        [&points](const Front& front) { return GetVolume(points, front) <= 0; }))
  {
    return { triangles };
  }
  return fronts;
}

} // namespace tetralux
