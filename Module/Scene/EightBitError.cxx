// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/EightBitError.h"

#include "Integral/RayIntegral.h"
#include "Scene/WorstOfPicture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

constexpr double Steps = 255;

/// Red, green, blue and opacity.
using Channels = std::array<double, 4>;

double RoundToNearest(double value)
{
  return std::floor(Steps * std::clamp(value, 0., 1.) + 0.5) / Steps;
}

/// Up as often as the rest asks for.
double RoundAtRandom(double value, double random)
{
  const double steps = Steps * value;
  return (std::floor(steps) + (steps - std::floor(steps) > random ? 1 : 0)) / Steps;
}

Channels Integrate(const RaySegment& segment, double lengthScale, const TransferFunction& function,
  OpticalModel model)
{
  const double length = lengthScale * segment.Length;
  SegmentRadiance radiance;
  switch (model)
  {
    case OpticalModel::EmissionAbsorption:
      radiance = IntegrateEmissionAbsorption(function, segment.Front, segment.Back, length);
      break;
    case OpticalModel::EmissionOnly:
      radiance = IntegrateEmissionOnly(function, segment.Front, segment.Back, length);
      break;
    default:
      radiance = IntegrateAbsorptionOnly(function, segment.Front, segment.Back, length);
  }
  return { radiance.Color[0], radiance.Color[1], radiance.Color[2], radiance.Opacity };
}

/// What blending puts in front of what is there.
template <class Round>
void Blend(Channels& picture, const Channels& added, const Round& round)
{
  const double transmittance = 1 - added[3];
  for (int c = 0; c < 4; ++c)
  {
    picture[c] = round(added[c] + transmittance * picture[c]);
  }
}

Channels DitherCell(Channels color, OpticalModel model, std::mt19937& generator)
{
  const auto draw = [&generator] { return static_cast<double>(generator()) / 4294967296.; };
  if (model == OpticalModel::EmissionOnly)
  {
    for (int c = 0; c < 3; ++c)
    {
      color[c] = RoundAtRandom(color[c], draw());
    }
  }
  else if (color[3] > 0)
  {
    const double scale = RoundAtRandom(color[3], draw()) / color[3];
    for (double& channel : color)
    {
      channel *= scale;
    }
  }
  return color;
}

/// How a ray's picture is rounded: to the nearest, or at random, differently by several pixels that
/// are seen as one.
constexpr int Pixels = 8;
constexpr int Pictures = 1 + Pixels;

/// Of both ways to round, what a ray's picture is off by.
struct RayErrors
{
  double Largest[2] = { 0, 0 };
  double Squares[2] = { 0, 0 };
};

RayErrors CompositeRay(const std::vector<RaySegment>& ray, double lengthScale,
  const TransferFunction& function, OpticalModel model, std::uint32_t seed)
{
  std::mt19937 generator(seed);
  Channels exact = {};
  Channels rounded[Pictures] = {};
  for (auto segment = ray.rbegin(); segment != ray.rend(); ++segment)
  {
    const Channels added = Integrate(*segment, lengthScale, function, model);
    Blend(exact, added, [](double value) { return value; });
    for (int i = 0; i < Pictures; ++i)
    {
      Channels share = i == 0 ? added : DitherCell(added, model, generator);
      std::transform(share.begin(), share.end(), share.begin(), RoundToNearest);
      Blend(rounded[i], share, RoundToNearest);
    }
  }
  RayErrors errors;
  for (int c = 0; c < 4; ++c)
  {
    const double right = std::min(exact[c], 1.); // where a picture of 8 bits ends
    double mean = 0;
    for (int i = 0; i < Pictures; ++i)
    {
      const double error = rounded[i][c] - right;
      const int way = i == 0 ? 0 : 1;
      errors.Largest[way] = std::max(errors.Largest[way], std::abs(error));
      mean += i == 0 ? 0 : error / Pixels;
    }
    errors.Squares[0] += (rounded[0][c] - right) * (rounded[0][c] - right) / 4;
    errors.Squares[1] += mean * mean / 4;
  }
  return errors;
}

EightBitError Summarize(const std::vector<RayErrors>& rays, const RaySample& sample, int way)
{
  EightBitError result;
  std::vector<double> largest;
  double sum = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    const double weight = sample.Weights.empty() ? 1 : sample.Weights[i];
    result.MeanSquare += weight * rays[i].Squares[way];
    sum += weight;
    largest.push_back(rays[i].Largest[way]);
  }
  result.MeanSquare /= sum > 0 ? sum : 1;
  std::vector<double> weights = sample.Weights;
  weights.resize(rays.size(), 1);
  result.Largest = std::min(1., WorstOfPicture * FindOneInThousand(largest, weights));
  return result;
}

} // namespace

EightBitErrors EstimateEightBitErrors(
  const RaySample& rays, double lengthScale, const TransferFunction& function, OpticalModel model)
{
  if (model != OpticalModel::EmissionAbsorption && model != OpticalModel::EmissionOnly &&
    model != OpticalModel::AbsorptionOnly)
  {
    throw std::invalid_argument("only emission and absorption are composited cell by cell");
  }
  std::vector<RayErrors> errors(rays.Rays.size());
  const auto n = static_cast<std::ptrdiff_t>(rays.Rays.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::ptrdiff_t i = 0; i < n; ++i)
  {
    errors[i] =
      CompositeRay(rays.Rays[i], lengthScale, function, model, static_cast<std::uint32_t>(i));
  }
  return { Summarize(errors, rays, 0), Summarize(errors, rays, 1) };
}

} // namespace tetralux
