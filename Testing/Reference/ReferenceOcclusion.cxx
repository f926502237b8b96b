// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceOcclusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

namespace tetralux
{
namespace
{

using Number = long double;
using Vector = std::array<Number, 3>;

Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Number Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

struct Part
{
  std::int32_t Cell;
  Number Begin, End;
};

Vector GetPoint(const TetrahedralMesh& mesh, std::int32_t point)
{
  const double* x = &mesh.Points[3 * static_cast<std::size_t>(point)];
  return { x[0], x[1], x[2] };
}

/// The part of a ray inside a cell; Begin > End where there is none.
Part Clip(const std::array<Vector, 4>& corners, const Vector& origin, const Vector& direction)
{
  constexpr Number infinity = std::numeric_limits<Number>::infinity();
  Part part = { 0, -infinity, infinity };
  for (int face = 0; face < 4; ++face)
  {
    const Vector& a = corners[(face + 1) % 4];
    const Vector normal = Cross(corners[(face + 2) % 4] - a, corners[(face + 3) % 4] - a);
    const Number side = Dot(normal, corners[face] - a);
    const Number slope = Dot(normal, direction) * side;
    const Number height = Dot(normal, origin - a) * side;
    if (side == 0 || (slope == 0 && height < 0))
    {
      return { 0, infinity, -infinity };
    }
    if (slope > 0)
    {
      part.Begin = std::max(part.Begin, -height / slope);
    }
    else if (slope < 0)
    {
      part.End = std::min(part.End, -height / slope);
    }
  }
  return part;
}

/// The smallest distance of a corner from the opposite face; 0 of a cell without volume.
Number GetHeight(const std::array<Vector, 4>& corners)
{
  Number height = std::numeric_limits<Number>::infinity();
  for (int face = 0; face < 4; ++face)
  {
    const Vector& a = corners[(face + 1) % 4];
    const Vector normal = Cross(corners[(face + 2) % 4] - a, corners[(face + 3) % 4] - a);
    const Number volume = std::abs(Dot(normal, corners[face] - a));
    height = std::min(height, volume > 0 ? volume / std::sqrt(Dot(normal, normal)) : 0);
  }
  return height;
}

} // namespace

//----------------------------------------------------------------------------
std::vector<OccludedPair> FindOccludedPairs(const TetrahedralMesh& mesh, const VisibilityView& view,
  int raysPerCell, std::uint64_t seed, double shortestPart)
{
  const std::int32_t numberOfCells = static_cast<std::int32_t>(mesh.GetNumberOfCells());
  Number lo[3] = { 1e30L, 1e30L, 1e30L }, hi[3] = { -1e30L, -1e30L, -1e30L };
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    lo[i % 3] = std::min<Number>(lo[i % 3], mesh.Points[i]);
    hi[i % 3] = std::max<Number>(hi[i % 3], mesh.Points[i]);
  }
  const Number shortest = shortestPart * std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
  std::vector<std::array<Vector, 4>> cells(numberOfCells);
  std::vector<Number> squaredRadii(numberOfCells); // about the first corners
  for (std::int32_t cell = 0; cell < numberOfCells; ++cell)
  {
    for (int i = 0; i < 4; ++i)
    {
      cells[cell][i] = GetPoint(mesh, mesh.Cells[4 * static_cast<std::size_t>(cell) + i]);
      const Vector edge = cells[cell][i] - cells[cell][0];
      squaredRadii[cell] = std::max(squaredRadii[cell], Dot(edge, edge));
    }
  }
  const Vector eye = { view.Eye[0], view.Eye[1], view.Eye[2] };
  std::vector<OccludedPair> pairs;
#pragma omp parallel for schedule(dynamic, 8)
  for (std::int32_t through = 0; through < numberOfCells; ++through)
  {
    if (GetHeight(cells[through]) <= shortest)
    {
      continue;
    }
    std::mt19937_64 random(seed + through);
    std::exponential_distribution<double> draw;
    std::vector<OccludedPair> found;
    std::vector<Part> parts;
    const std::array<Vector, 4>& corners = cells[through];
    for (int ray = 0; ray < raysPerCell; ++ray)
    {
      // Evenly distributed in the cell.
      Number weights[4], sum = 0;
      for (Number& weight : weights)
      {
        weight = draw(random);
        sum += weight;
      }
      Vector target = { 0, 0, 0 };
      for (int axis = 0; axis < 3; ++axis)
      {
        for (int i = 0; i < 4; ++i)
        {
          target[axis] += weights[i] / sum * corners[i][axis];
        }
      }
      Vector direction = target - eye;
      if (view.Parallel)
      {
        direction = { view.Direction[0], view.Direction[1], view.Direction[2] };
      }
      const Number length = std::sqrt(Dot(direction, direction));
      if (length == 0)
      {
        continue;
      }
      parts.clear();
      const Vector along = { direction[0] / length, direction[1] / length, direction[2] / length };
      for (std::int32_t cell = 0; cell < numberOfCells; ++cell)
      {
        // Far away from the ray.
        const Vector across = Cross(cells[cell][0] - target, along);
        if (Dot(across, across) > 1.01L * squaredRadii[cell])
        {
          continue;
        }
        Part part = Clip(cells[cell], view.Parallel ? target : eye, direction);
        part.Begin = view.Parallel ? part.Begin : std::max<Number>(part.Begin, 0);
        if ((part.End - part.Begin) * length > shortest)
        {
          parts.push_back({ cell, part.Begin, part.End });
        }
      }
      for (const Part& a : parts)
      {
        for (const Part& b : parts)
        {
          if (a.Begin < b.Begin && (a.End - b.Begin) * length < shortest)
          {
            found.push_back({ a.Cell, b.Cell });
          }
        }
      }
    }
#pragma omp critical
    pairs.insert(pairs.end(), found.begin(), found.end());
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

//----------------------------------------------------------------------------
std::vector<OccludedPair> FindWrongPairs(
  const std::vector<OccludedPair>& pairs, Span<const std::int32_t> order)
{
  std::int32_t largest = -1;
  for (const std::int32_t cell : order)
  {
    largest = std::max(largest, cell);
  }
  std::vector<std::size_t> places(largest + 1);
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    places[order[place]] = place;
  }
  std::vector<OccludedPair> wrong;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(wrong),
    [&](const OccludedPair& pair) { return places.at(pair.Front) > places.at(pair.Back); });
  return wrong;
}

} // namespace tetralux
