// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/MeshRays.h"

#include "Walk/MeshLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

/// Adds the segments of a line; lengths times scale. Returns how likely the line is drawn through a
/// place in one of the cells, in any unit.
double AddSegments(
  const std::vector<LinePassage>& passages, double scale, std::vector<RaySegment>& segments)
{
  double density = 0;
  for (const LinePassage& passage : passages)
  {
    const double length = std::abs(passage.End - passage.Begin); // also of inverted cells
    if (length > 0 && std::isfinite(passage.Front) && std::isfinite(passage.Back))
    {
      segments.push_back({ passage.Front, passage.Back, scale * length, passage.Gradient,
        passage.FrontSlope, passage.BackSlope, passage.First, passage.Last });
    }
    if (passage.Volume > 0)
    {
      density += length / passage.Volume;
    }
  }
  return density;
}

// As many as are integrated in some 30 milliseconds of one thread.
constexpr std::size_t EnoughSegments = 100000;
constexpr std::size_t FewestRays = 64;
constexpr std::size_t MostRays = 1024;

} // namespace

RaySample DrawMeshRays(const WalkMesh& mesh, Span<const double> scalars, double scale, bool ofCells)
{
  RaySample sample;
  const std::int32_t numberOfCells = mesh.GetNumberOfCells();
  if (numberOfCells == 0)
  {
    return sample;
  }
  std::mt19937_64 generator(1);
  std::uniform_int_distribution<std::int32_t> anyCell(0, numberOfCells - 1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal(0, 1);
  const auto draw = [&]() -> std::pair<Vector, Vector>
  {
    // Anywhere in a cell: exponentially distributed weights of its corners are evenly distributed.
    const std::int32_t* corners =
      &mesh.GetMesh().Cells[4 * static_cast<std::size_t>(anyCell(generator))];
    Vector point{}, direction{};
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner)
    {
      const WalkPoint<float>& p = mesh.GetPoints<float>()[corners[corner]];
      const double weight = -std::log(1 - unit(generator));
      point = { point[0] + weight * p.X, point[1] + weight * p.Y, point[2] + weight * p.Z };
      sum += weight;
    }
    double length = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] /= sum;
      direction[axis] = normal(generator);
      length = std::hypot(length, direction[axis]);
    }
    return { point, { direction[0] / length, direction[1] / length, direction[2] / length } };
  };
  const auto walk = [&](std::size_t count)
  {
    std::vector<std::pair<Vector, Vector>> lines(count);
    std::generate(lines.begin(), lines.end(), draw);
    const std::size_t first = sample.Rays.size();
    sample.Rays.resize(first + count);
    sample.Weights.resize(first + count);
    const auto n = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for schedule(dynamic, 8)
    for (std::ptrdiff_t i = 0; i < n; ++i)
    {
      const MeshLine<float> line(mesh, scalars, ofCells, lines[i].first, lines[i].second);
      const double density =
        AddSegments(line.Walk(), scale * mesh.GetRadius(), sample.Rays[first + i]);
      sample.Weights[first + i] = density > 0 ? 1 / density : 0;
    }
  };
  walk(FewestRays);
  std::size_t segments = 0;
  for (const std::vector<RaySegment>& ray : sample.Rays)
  {
    segments += ray.size();
  }
  const std::size_t enough = EnoughSegments * FewestRays / std::max<std::size_t>(segments, 1);
  walk(std::clamp(enough, FewestRays, MostRays) - FewestRays);
  return sample;
}

} // namespace tetralux
