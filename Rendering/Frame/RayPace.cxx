// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/RayPace.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// How much larger than needed a distance may be before it changes: frames of one view take times
/// that differ by about a third on a busy machine, and a distance changes by the root of that.
constexpr double LargestExcess = 1.3;

/// A new distance is in the middle of those that are kept.
constexpr double FreshExcess = 1.14;

/// Of what every frame takes: fewer rays than can be cast in this share of it save little.
constexpr double SmallestRayShare = 0.25;

} // namespace

double RayPace::ChooseDistance(const RayDistances& distances, const FrameDemand& demand)
{
  if (!distances.Automatic)
  {
    return distances.Fixed;
  }
  const double raySeconds =
    std::max(demand.Seconds - this->FixedSeconds, SmallestRayShare * this->FixedSeconds);
  const auto clamp = [&distances](double distance)
  { return std::max(std::min(distance, distances.Maximum), distances.Minimum); };
  const double needed =
    raySeconds > 0 ? std::sqrt(this->GetSecondsPerRay() * demand.Pixels / raySeconds) : 0;
  if (!demand.Interactive)
  {
    this->Last = 0;
    return clamp(needed);
  }
  if (this->Last == 0)
  {
    this->Last = clamp(needed);
  }
  else if (clamp(needed) > this->Last || LargestExcess * needed < this->Last)
  {
    this->Last = clamp(FreshExcess * needed);
  }
  return clamp(this->Last);
}

bool RayPace::HasTimeForEdges(const FrameDemand& demand)
{
  const double seconds =
    this->FixedSeconds + this->GetSecondsPerRay() * demand.Pixels + this->EdgeSeconds;
  this->LastEdges = !demand.Interactive ||
    seconds <= (this->LastEdges ? demand.Seconds : demand.Seconds / LargestExcess);
  return this->LastEdges;
}

void RayPace::Record(double rays, double raySeconds, double fixedSeconds)
{
  std::rotate(
    this->SecondsPerRay.begin(), this->SecondsPerRay.end() - 1, this->SecondsPerRay.end());
  this->SecondsPerRay.front() = raySeconds / rays;
  this->Frames = std::min(this->Frames + 1, static_cast<int>(this->SecondsPerRay.size()));
  this->FixedSeconds = fixedSeconds;
}

double RayPace::GetSecondsPerRay() const
{
  const auto& [first, second, third] = this->SecondsPerRay;
  return this->Frames < 3
    ? first
    : std::max(std::min(first, second), std::min(std::max(first, second), third));
}

} // namespace tetralux
