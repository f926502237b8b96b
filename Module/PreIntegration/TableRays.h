// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TableRays_h
#define tetralux_TableRays_h

// What lookups in a table do to rays: beside the closed form in double precision.

#include "Integral/RayIntegral.h"
#include "Integral/RaySegments.h"
#include "Optics/TransferFunction.h"
#include "PreIntegration/PreIntegrationTable.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tetralux
{

/// How much worse the worst of the rays of a picture is than the worst of a sample, at most in
/// nearly all scenes (Documentation/Benchmarks.md).
constexpr double WorseInPictures = 4;

/// What a camera anywhere on a ray sees of it, by table: back to front, so that each segment may be
/// the first one.
struct SeenByTable
{
  double Color[3] = { 0, 0, 0 };
  double Transmittance = 1;

  void AddInFront(const float rgba[4])
  {
    const double transmittance = 1 - static_cast<double>(rgba[3]);
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] = static_cast<double>(rgba[c]) + transmittance * this->Color[c];
    }
    this->Transmittance *= transmittance;
  }

  double GetError(const SegmentRadiance& exact) const
  {
    double error = std::abs(exact.Transmittance - this->Transmittance);
    for (int c = 0; c < 3; ++c)
    {
      error = std::max(error, std::abs(exact.Color[c] - this->Color[c]));
    }
    return error;
  }
};

/// A sample's rays, and what a camera at the front of each of their segments sees.
class TableRays
{
public:
  TableRays(const TransferFunction& function, const RaySample& sample);

  /// What pictures by a table are expected to be wrong by, see EstimatePictureError; infinity where
  /// it is more than is allowed.
  double Estimate(const PreIntegrationTable& table, double allowed) const;

  /// Whether it may be no more, as a few rays tell; lookUp as for Measure.
  template <class LookUp>
  bool MayBeRight(double allowed, const LookUp& lookUp) const
  {
    constexpr std::size_t FewRays = 32;
    return this->Measure(FewRays, allowed / WorseInPictures, lookUp) <= allowed;
  }

private:
  /// Largest error of a channel that any camera on the first rays sees, or infinity where it is
  /// more than is allowed; lookUp(front, back, length, rgba).
  template <class LookUp>
  double Measure(std::size_t count, double allowed, const LookUp& lookUp) const
  {
    double largest = 0;
    bool tooLarge = false;
    const auto n = static_cast<std::ptrdiff_t>(std::min(count, this->Rays.size()));
#pragma omp parallel for schedule(dynamic, 4) reduction(max : largest) shared(tooLarge)
    for (std::ptrdiff_t i = 0; i < n; ++i)
    {
      bool isDecided;
#pragma omp atomic read
      isDecided = tooLarge;
      if (isDecided)
      {
        continue;
      }
      largest = std::max(largest, this->MeasureRay(i, allowed, lookUp));
      if (largest > allowed)
      {
#pragma omp atomic write
        tooLarge = true;
      }
    }
    return tooLarge ? std::numeric_limits<double>::infinity() : largest;
  }

  /// No further than to a segment that is more wrong than is allowed.
  template <class LookUp>
  double MeasureRay(std::size_t i, double allowed, const LookUp& lookUp) const
  {
    double largest = 0;
    SeenByTable seen;
    for (std::size_t k = this->Rays[i].size(); k-- > 0 && largest <= allowed;)
    {
      const RaySegment& segment = this->Rays[i][k];
      float rgba[4];
      lookUp(segment.Front, segment.Back, segment.Length, rgba);
      seen.AddInFront(rgba);
      largest = std::max(largest, seen.GetError(this->Seen[i][k]));
    }
    return largest;
  }

  double LargestColor;
  std::vector<std::vector<RaySegment>> Rays;      ///< those on nodes first
  std::vector<std::vector<SegmentRadiance>> Seen; ///< from the front of each segment
};

} // namespace tetralux

#endif
