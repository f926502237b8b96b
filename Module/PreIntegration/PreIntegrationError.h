// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PreIntegrationError_h
#define tetralux_PreIntegrationError_h

// How wrong a pre-integration table is.
//
// Of a segment. The error of a lookup is at most PreIntegrationError::Segment + Rounding, and at
// most PerLength times the segment's length + Rounding. Each comes as a bound, from the transfer
// function and the axes alone, and as an estimate, measured where interpolation is worst.
//
// Of a picture. A ray is a chain of segments, each weakened by the opacity in front of it. Let e be
// the largest error of a channel of one segment. The colour of the ray is then wrong by at most e
// for the segment's colour, and by e for what its opacity hides of a colour of at most 1, so
// over N segments of a path of length L
//
//   error of the picture <= 2 (min(PerLength L, Segment N) + Rounding N).
//
// It grows with the number of segments, which is why a table has to be more accurate than the
// picture (Kraus et al. 2004, section 3), and it is reached only by rays whose every segment is the
// worst one. What to expect is measured on a sample of rays through the mesh (MeshRays.h).

#include "Integral/RaySegments.h"
#include "PreIntegration/PreIntegrationTable.h"

#include <cstddef>

namespace tetralux
{

/// The bound of a table with these axes (its texels are not looked at).
///
/// Scalars: a texel's cell bounds two windows of scalars; at every place along a segment the
/// attenuation is interpolated within the window there. A bend of slope J makes an error of at most
/// J H / 4 in a window of width H, a step its height, each along that part of the segment whose
/// windows hold it; what the exponential makes of values that differ by d over a cell is at most
/// (l d)^2 / 8 of opacity, and a few times that of colour.
///
/// Lengths: opacity and colour bend along the length l by at most min(M^2, 1.083 / l^2), M the
/// largest attenuation, and a step of h is wrong by h^2 / 8 times that.
///
/// Cost: of the order of the texels along a scalar squared, times the nodes between them.
TETRALUXCORE_EXPORT PreIntegrationError BoundPreIntegrationError(
  const TransferFunction& function, const PreIntegrationTable& table);

/// The largest error found by comparing lookups in the middle of texels' cells, where trilinear
/// interpolation is worst, with the closed form in double precision. Cells are drawn at random,
/// with a fixed seed, and among them all that lie on the diagonal of equal scalars or next to it. A
/// sample, not a bound. samples: about a microsecond each.
TETRALUXCORE_EXPORT PreIntegrationError EstimatePreIntegrationError(
  const TransferFunction& function, const PreIntegrationTable& table, std::size_t samples = 20000);

/// The bound for a picture of the model above. pathLength: longest way of a ray through the volume,
/// world units; segments: most cells on it.
TETRALUXCORE_EXPORT double GetPictureError(
  const PreIntegrationError& error, double pathLength, double segments);

/// What pictures by lookups in a table are expected to be wrong by, at most: four times the
/// largest error of a channel that a camera anywhere on the rays sees. A sample has a thousandth of
/// the rays of a picture, and the worst of it is seldom the worst. Some of its rays are measured
/// once more with scalars that run along a node of the function, where tables are most wrong: next
/// to a step a segment in a million may be wrong by more than all others together. So pictures of
/// nearly all scenes are better, most of them by a factor of two to four
/// (Documentation/Benchmarks.md). Never more than the largest color, or 1. Some 50 milliseconds of
/// one thread for a sample of 100,000 segments; parallel.
TETRALUXCORE_EXPORT double EstimatePictureError(
  const TransferFunction& function, const PreIntegrationTable& table, const RaySample& rays);

} // namespace tetralux

#endif
