// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TableChoice_h
#define tetralux_TableChoice_h

// Which pre-integration table is right enough for pictures, see PreIntegrationError.h.

#include "Integral/RaySegments.h"
#include "Optics/IntervalTable.h"
#include "PreIntegration/PreIntegrationTable.h"

#include <cstddef>
#include <memory>
#include <string>

namespace tetralux
{

/// What a table is chosen for.
struct TableGoal
{
  double MaximumError = 1. / 255; ///< of a picture's channel, absolute, more than 0
  std::size_t MaximumBytes = std::size_t{ 64 } << 20;

  /// What the table has to be right for; not nullptr.
  std::shared_ptr<const RaySample> Rays;

  /// Pieces that the closed form integrates for each segment of the rays, see
  /// CountPiecesPerSegment. 0: those of MakeIntervalTable(function).
  double PiecesPerSegment = 0;

  // What the axes of the table reach to: no scalar or segment of a picture is beyond.
  double ScalarRange[2] = { 0, 1 };
  double LongestSegment = 1; ///< world units

  /// Time of a lookup in units of that of the closed form on one piece. Segments with more pieces
  /// are faster by table. A processor takes about as long for a lookup of a packet of rays as for
  /// LookupCost pieces, see Documentation/Benchmarks.md; a GPU's texture units make it a fraction.
  double LookupCost = 3;

  /// A table also where the closed form would be chosen: the most exact one within the limits,
  /// where none is right enough.
  bool AlwaysTable = false;

  // What is not to be chosen: sizes of 0 are free.
  int ScalarSize = 0;
  int LengthSize = 0;
  bool AnyScale = true;
  LengthScale Scale = LengthScale::Linear;
  bool AnyAxis = true;
  ScalarAxis Axis = ScalarAxis::Nodes;
  bool AnyFormat = true;
  TexelFormat Format = TexelFormat::Float;
};

struct TableChoice
{
  /// nullptr, no table: the closed form is as fast, or no table within the limits is right enough.
  std::shared_ptr<PreIntegrationTable> Table;
  double PictureError = 0; ///< EstimatePictureError of the table; 0 without one
  std::string Reason;      ///< one line
};

/// Pieces that the closed form integrates for each segment of the rays, on average: ends of
/// intervals between its two scalars, and one; 1 of no segments.
TETRALUXCORE_EXPORT double CountPiecesPerSegment(
  const IntervalTable& table, const RaySample& sample);

/// How many rays of a sample, the first ones, are integrated in about a second of one thread: those
/// that tables are measured on.
TETRALUXCORE_EXPORT std::size_t CountTableRays(
  const TransferFunction& function, const RaySample& sample);

/// The smallest table whose EstimatePictureError is at most what is asked for; else none, or with
/// AlwaysTable the one of the least error.
/// The largest tables are tried first, on a few rays: where none of them is right, none is, as with
/// most functions of hundreds of nodes. Then tables of growing size are tried until one is right. A
/// few rays rule most of them out, for which only the texels they look up are computed; what is
/// left is built and measured on all rays. Some 100 milliseconds of one thread, and up to a second
/// where no table is right. Where functions have so many nodes that integrating the rays would take
/// longer, fewer are measured; where these would be too few to tell, no table is tried unless
/// AlwaysTable. Throws as BuildPreIntegrationTable does.
TETRALUXCORE_EXPORT TableChoice ChoosePreIntegrationTable(
  const TransferFunction& function, const TableGoal& goal);

/// Settings of a table for the time of an interaction: of the same range, lengths, scale and
/// format, in at most so many bytes; at most the size asked for, and at least 16 x 16 texels of 8
/// lengths.
TETRALUXCORE_EXPORT PreIntegrationSettings GetCoarseSettings(
  const PreIntegrationSettings& settings, std::size_t bytes);

} // namespace tetralux

#endif
