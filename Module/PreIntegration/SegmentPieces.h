// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SegmentPieces_h
#define tetralux_SegmentPieces_h

#include "Optics/TransferFunction.h"
#include "PreIntegration/PreIntegrationKernel.h"

#include <cstddef>
#include <vector>

namespace tetralux
{

/// The parts of a table's segments on which the transfer function is linear. Keeps references to
/// the function and to the texels of the axis.
class SegmentPieces
{
public:
  /// longest: length of the longest segment, world units.
  SegmentPieces(const TransferFunction& function, const ScalarAxisMap& axis, double longest);

  /// Replaces pieces by those from one texel's scalar to another's that attenuate, front to back.
  void Find(int front, int back, std::vector<SegmentPiece>& pieces) const;

private:
  /// Adds the piece from s0 to s1, a share of the longest segment, if it attenuates.
  void Add(std::size_t interval, double s0, double s1, double share,
    std::vector<SegmentPiece>& pieces) const;

  /// The function continued from the interval with so many nodes below it.
  TransferFunction::Value Evaluate(std::size_t interval, double s) const;

  const std::vector<TransferFunction::Node>& Nodes;
  const std::vector<double>& Texels;
  double Longest;
  std::vector<std::size_t> Intervals; ///< of each texel: the number of nodes below it
};

} // namespace tetralux

#endif
