// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LengthSamples_h
#define tetralux_LengthSamples_h

// The lengths at which a table computes the closed form, and the interpolation between them.
//
// A channel of a segment is a smooth function of its length l: the integral of tau c l exp(-l T),
// where T is the optical depth of the part of the segment up to some place, per unit of l. Divided
// by l it is interpolated at Chebyshev points of the panels [0, l1], [l1, 2 l1], [2 l1, 4 l1] and
// so on, where l1 is an optical depth of FirstDepth at most. With K points a panel and h half of
// its width, the error is
//
//   on the first panel   l tau c 2 (h tau / 2)^K / K!     <= 2e-8 of colours up to 1,
//   on the others        2 (l / l1') (h / 2 l1')^K        <= 3e-7, l1' the panel's begin.
//
// The first follows from the K-th derivative of exp(-l T), at most tau^K. The second follows from
// its integral over T, at most K! / l1'^(K + 1). Both hold for every segment, since all they ask
// for is the largest attenuation.

#include "PreIntegration/PreIntegrationTable.h"

#include <vector>

namespace tetralux
{

/// The lengths, in fractions of the longest, and how the texels of a table follow from values
/// there.
struct LengthSamples
{
  static constexpr int PointsPerPanel = 12;
  static constexpr double FirstDepth = 4;

  struct Panel
  {
    int FirstRow, EndRow;       ///< texels along the length
    int FirstPoint;             ///< index of its first point
    std::vector<float> Weights; ///< PointsPerPanel for each row
  };

  std::vector<float> Lengths; ///< padded to a multiple of LaneCount
  std::vector<Panel> Panels;  ///< empty: point k is texel k + 1 itself

  /// largestDepth: no segment of the table has a larger optical depth.
  LengthSamples(const LengthAxisMap& axis, double largestDepth);

  /// How often the longest segment is halved until its optical depth is at most FirstDepth. Equal
  /// numbers mean equal panels.
  static int GetHalvings(double largestDepth);

private:
  /// The panel from begin to end, for the rows from firstRow up to end, or to the last one. Returns
  /// the first row behind it.
  int AddPanel(
    const LengthAxisMap& axis, double longest, double begin, double end, int firstRow, bool last);
};

} // namespace tetralux

#endif
