// SPDX-License-Identifier: BSD-3-Clause
#include "ModelRays.h"

#include <algorithm>
#include <random>
#include <vector>

namespace tetralux
{
namespace
{

constexpr int MostSegments = 400;

/// A ray whose scalar and lengths go by steps of given sizes.
std::vector<RaySegment> MakeModelRay(
  const RayModel& model, double scalarStep, double longest, std::mt19937_64& generator)
{
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal(0, 1);
  const double lo = model.ScalarRange[0];
  const double width = model.ScalarRange[1] - lo;
  std::vector<RaySegment> segments;
  double place = unit(generator); // in the range
  // A drift takes slow rays through all of the range, too.
  double drift = place < 0.5 ? 1 : -1;
  double path = 0;
  while (path < model.PathLength && segments.size() < MostSegments)
  {
    double next = place + scalarStep * (drift + normal(generator));
    if (next < 0 || next > 1)
    {
      drift = -drift;
      next = std::clamp(next < 0 ? -next : 2 - next, 0., 1.);
    }
    const double length = longest * (1 - unit(generator));
    segments.push_back({ lo + place * width, lo + next * width, length });
    path += length;
    place = next;
  }
  return segments;
}

} // namespace

RaySample DrawModelRays(const RayModel& model)
{
  RaySample sample;
  std::mt19937_64 generator(1);
  constexpr int RaysOfAKind = 6;
  for (const double scalarStep : { 0.002, 0.02, 0.2 })
  {
    for (const double part : { 1., 1. / 4, 1. / 16 })
    {
      for (int i = 0; i < RaysOfAKind; ++i)
      {
        sample.Rays.push_back(
          MakeModelRay(model, scalarStep, part * model.LongestSegment, generator));
      }
    }
  }
  return sample;
}

} // namespace tetralux
