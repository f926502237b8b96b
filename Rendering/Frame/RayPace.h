// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayPace_h
#define tetralux_RayPace_h

#include "TetraluxRenderingModule.h"

#include <array>

namespace tetralux
{

/// Distances from ray to ray, in pixels.
struct RayDistances
{
  bool Automatic = true; ///< by the time that the renderer allocates
  double Fixed = 1;      ///< where it is not automatic
  double Minimum = 1;    ///< of the automatic one
  double Maximum = 10;
};

/// What a frame has to do, and how long it may take.
struct FrameDemand
{
  double Pixels = 0;        ///< of the viewport
  double Seconds = 0;       ///< that the renderer allocates
  bool Interactive = false; ///< further frames of a movement follow
};

/// How long the last frames took, from which the distance of rays follows.
class TETRALUXRENDERING_EXPORT RayPace
{
public:
  /// The distance by which a frame takes no longer than it may, or the nearest one of the range. In
  /// an interaction the last distance is kept as long as it is not much larger than that: pictures
  /// of changing sizes flicker. Other frames have the distance that follows.
  double ChooseDistance(const RayDistances& distances, const FrameDemand& demand);

  /// Whether samples at edges fit into the time of a frame, too; unknown before the first of them.
  bool HasTimeForEdges(const FrameDemand& demand);

  /// Of the last frame. raySeconds: of what grows with the number of rays. fixedSeconds: of what
  /// every frame takes besides.
  void Record(double rays, double raySeconds, double fixedSeconds);
  void RecordEdges(double seconds) { this->EdgeSeconds = seconds; }

private:
  /// The middle one of the last three: a frame that something else held up changes nothing.
  double GetSecondsPerRay() const;

  std::array<double, 3> SecondsPerRay = { 0, 0, 0 }; ///< the last one first
  int Frames = 0;                                    ///< that are known
  double FixedSeconds = 0;
  double EdgeSeconds = 0;
  double Last = 0; ///< distance in the interaction; 0: there is none
  bool LastEdges = true;
};

} // namespace tetralux

#endif
