// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayIntegral_h
#define tetralux_RayIntegral_h

#include "Base/Span.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

#include <cstddef>

namespace tetralux
{

// What a segment of a ray adds to a picture, in double precision, for each optical model (Weiler et
// al. 2003, sections 3.3 and 4): the scalar runs linearly from sf at the front end to sb at the
// back end, and the segment is cut where it passes a node of the transfer function, so that
// attenuation and colour are linear on each piece and the integral has a closed form (see
// SegmentIntegral.h for its derivation).
//
// All functions take
// * function: one that MakeIntervalTable accepts; it is not checked again here.
// * sf, sb: in the units of the scalars. A segment with one that is not finite contributes nothing.
// * length: in world units, finite, at least 0.
//
// A constant scalar at a step takes the value from larger scalars, as in Evaluate. Cost: a binary
// search, and one closed form for each piece.
//
// Nothing here is parallel or vectorised. Every function may be called from any thread.

/// Largest error of a colour channel and of the opacity, relative to the opacity (and for a channel
/// to the largest absolute value of that channel's colour on the segment): tested against
/// quadrature in extended precision. Absolute below an opacity of 1e-295, where numbers lose
/// digits.
constexpr double RayIntegralError = 1e-12;

/// What a segment adds, in front of nothing.
struct SegmentRadiance
{
  double Color[3] = { 0, 0, 0 }; ///< red, green, blue, premultiplied
  double Opacity = 0;            ///< 0..1, with its relative accuracy where it is small
  double Transmittance = 1;      ///< 1 - Opacity, with its relative accuracy where it is small

  /// Adds what is behind everything that was added so far.
  TETRALUXCORE_EXPORT void AddBehind(const SegmentRadiance& behind);
};

/// OpticalModel::EmissionAbsorption.
TETRALUXCORE_EXPORT SegmentRadiance IntegrateEmissionAbsorption(
  const TransferFunction& function, double sf, double sb, double length);

/// OpticalModel::EmissionOnly: the integral of tau c, which may exceed 1; opacity 0. On each piece
/// the integrand is quadratic: L (tau0 c0 / 3 + (tau0 c1 + tau1 c0) / 6 + tau1 c1 / 3).
TETRALUXCORE_EXPORT SegmentRadiance IntegrateEmissionOnly(
  const TransferFunction& function, double sf, double sb, double length);

/// OpticalModel::AbsorptionOnly: colour 0.
TETRALUXCORE_EXPORT SegmentRadiance IntegrateAbsorptionOnly(
  const TransferFunction& function, double sf, double sb, double length);

/// OpticalModel::MaximumIntensity: colour and opacity at the largest scalar of a whole ray, which
/// is at one of the ends of its segments. The attenuation is taken for the opacity itself, and held
/// to 0..1.
TETRALUXCORE_EXPORT SegmentRadiance ClassifyMaximum(
  const TransferFunction& function, double largestScalar);

/// OpticalModel::Isosurfaces: the surfaces that the segment crosses, flat, front to back. surfaces:
/// strictly ascending in Value.
TETRALUXCORE_EXPORT SegmentRadiance IntegrateIsosurfaces(
  Span<const Isosurface> surfaces, double sf, double sb);

/// Calls visit(index, w) for each surface that the segment crosses, front to back, with w its place
/// along the segment, 0..1. surfaces: strictly ascending in Value.
///
/// A value is crossed where the scalar is below it at one end and not below it at the other: along
/// a chain of segments each crossing is met once, also one at an end of a segment.
template <class Visit>
void ForEachCrossing(Span<const Isosurface> surfaces, double sf, double sb, const Visit& visit)
{
  const bool rising = sf < sb;
  for (std::size_t k = 0; k < surfaces.size(); ++k)
  {
    const std::size_t index = rising ? k : surfaces.size() - 1 - k;
    const double value = surfaces[index].Value;
    if ((sf < value) != (sb < value))
    {
      // By halves, which cannot overflow.
      visit(index, (0.5 * value - 0.5 * sf) / (0.5 * sb - 0.5 * sf));
    }
  }
}

} // namespace tetralux

#endif
