// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/ImageError.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tetralux
{
namespace
{

/// Rays along the longer side of the lattice of rays that are compared.
constexpr int LatticeSize = 32;

/// How much shorter the distance is of what a picture is compared with.
constexpr double Refinement = 8;

/// Some rays of a picture.
struct RayLattice
{
  RayLattice(const RayGrid& grid, const RayLimits& limits);

  /// Index of a ray's pixel in the picture.
  std::size_t GetPixel(int i, int j) const
  {
    return static_cast<std::size_t>(this->First[1] + j * this->Step) * this->Width +
      this->First[0] + i * this->Step;
  }
  std::size_t GetNumberOfRays() const
  {
    return static_cast<std::size_t>(this->Grid.Width) * this->Grid.Height;
  }

  RayGrid Grid;
  RayLimits Limits;
  int Step;     ///< pixels from ray to ray
  int First[2]; ///< pixel of the first ray
  int Width;    ///< of the picture

private:
  std::vector<float> Distances; ///< what Limits points to
};

RayLattice::RayLattice(const RayGrid& grid, const RayLimits& limits)
  : Grid(grid)
  , Limits(limits)
  , Step(std::max(1, std::max(grid.Width, grid.Height) / LatticeSize))
  , Width(grid.Width)
{
  const int size[2] = { grid.Width, grid.Height };
  int count[2];
  for (int a = 0; a < 2; ++a)
  {
    this->First[a] = std::min(this->Step / 2, size[a] - 1);
    count[a] = (size[a] - 1 - this->First[a]) / this->Step + 1;
  }
  this->Grid.Width = count[0];
  this->Grid.Height = count[1];
  for (int a = 0; a < 3; ++a)
  {
    this->Grid.Origin[a] +=
      this->First[0] * grid.OriginStepX[a] + this->First[1] * grid.OriginStepY[a];
    this->Grid.Direction[a] +=
      this->First[0] * grid.DirectionStepX[a] + this->First[1] * grid.DirectionStepY[a];
    this->Grid.OriginStepX[a] *= this->Step;
    this->Grid.OriginStepY[a] *= this->Step;
    this->Grid.DirectionStepX[a] *= this->Step;
    this->Grid.DirectionStepY[a] *= this->Step;
  }
  if (limits.MaximumDistances)
  {
    this->Distances.resize(this->GetNumberOfRays());
    for (int j = 0; j < count[1]; ++j)
    {
      for (int i = 0; i < count[0]; ++i)
      {
        this->Distances[static_cast<std::size_t>(j) * count[0] + i] =
          limits.MaximumDistances[this->GetPixel(i, j)];
      }
    }
    this->Limits.MaximumDistances = this->Distances.data();
  }
}

std::vector<float> CastLattice(ImageCaster& caster, const RayLattice& lattice,
  const ImageCasterOptions& options, double distance, double threshold)
{
  ImageCasterOptions fine = options;
  fine.SampleDistance = distance;
  fine.Threshold = threshold;
  fine.Progress = nullptr;
  fine.Hulls = nullptr; // of the picture's tiles
  std::vector<float> colors(4 * lattice.GetNumberOfRays());
  std::vector<float> depths(lattice.GetNumberOfRays());
  caster.Cast(lattice.Grid, lattice.Limits, fine, colors, depths);
  return colors;
}

/// a(ray, channel) and b(ray, channel) of all rays.
template <class A, class B>
ImageError Compare(std::size_t rays, const A& a, const B& b)
{
  ImageError error;
  error.Rays = static_cast<std::int64_t>(rays);
  double sum = 0;
  std::int64_t count = 0;
  for (std::size_t ray = 0; ray < rays; ++ray)
  {
    if (a(ray, 3) == 0 && b(ray, 3) == 0)
    {
      continue;
    }
    for (int c = 0; c < 4; ++c)
    {
      const double difference = std::abs(static_cast<double>(a(ray, c)) - b(ray, c));
      error.Largest = std::max(error.Largest, difference);
      sum += difference;
      ++count;
    }
  }
  error.Mean = count > 0 ? sum / static_cast<double>(count) : 0;
  return error;
}

} // namespace

ImageError EstimateImageError(ImageCaster& caster, const RayGrid& grid, const RayLimits& limits,
  const ImageCasterOptions& options, Span<const float> colors)
{
  const RayLattice lattice(grid, limits);
  // Samples and slabs come to the same, and a table of other slabs would take the place of the one
  // that the next picture needs.
  ImageCasterOptions samples = options;
  samples.PreIntegrated = false;
  const std::vector<float> fine =
    CastLattice(caster, lattice, samples, options.SampleDistance / Refinement, 0);
  const int width = lattice.Grid.Width;
  return Compare(
    lattice.GetNumberOfRays(),
    [&](std::size_t ray, int c)
    {
      const int index = static_cast<int>(ray);
      return colors[4 * lattice.GetPixel(index % width, index / width) + c];
    },
    [&](std::size_t ray, int c) { return fine[4 * ray + c]; });
}

double ChooseSampleDistance(ImageCaster& caster, const RayGrid& grid, const RayLimits& limits,
  const ImageCasterOptions& options, double maximumError)
{
  const RayLattice lattice(grid, limits);
  double distance = options.SampleDistance;
  std::vector<float> coarse = CastLattice(caster, lattice, options, distance, options.Threshold);
  for (int i = 0; i < MostHalvings; ++i)
  {
    std::vector<float> fine =
      CastLattice(caster, lattice, options, distance / 2, options.Threshold);
    const ImageError error = Compare(
      lattice.GetNumberOfRays(), [&](std::size_t ray, int c) { return coarse[4 * ray + c]; },
      [&](std::size_t ray, int c) { return fine[4 * ray + c]; });
    if (error.Largest <= maximumError)
    {
      break;
    }
    distance /= 2;
    coarse = std::move(fine);
  }
  return distance;
}

} // namespace tetralux
