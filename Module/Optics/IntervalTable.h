// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntervalTable_h
#define tetralux_IntervalTable_h

#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A transfer function as the kernels read it: one entry for each interval on which it is linear,
/// over scalars mapped to x = (s - Offset) / Scale, where the nodes lie in [-1, 1].
struct IntervalTable
{
  /// Twelve floats, loaded as three rows of four. On [Lo, Hi] the attenuation is Attenuation +
  /// AttenuationSlope (x - Reference), and the colour likewise; evaluated in single precision they
  /// stay between the values at both ends. Reference is the end with less attenuation. The first
  /// interval reaches down to minus infinity, the last one up to infinity; both are constant.
  struct alignas(16) Interval
  {
    float Lo, Hi, Reference, Attenuation;
    float AttenuationSlope, Color[3];
    float ColorSlope[3], Unused;
  };

  std::vector<Interval> Intervals;
  double Offset = 0;
  double Scale = 1;
  double MaximumAttenuation = 0; ///< largest attenuation anywhere, per world unit

  /// Sum of all changes of the attenuation from the first scalar to the last one, steps included.
  double AttenuationVariation = 0;
};

/// Attenuation and colour of a cell of constant scalar, in one load.
struct alignas(16) CellValue
{
  float Attenuation;
  float Color[3];
};

/// Throws std::invalid_argument, with one line that says what is wrong, unless the function has
/// nodes in strictly ascending order, finite values and attenuations that are not negative.
TETRALUXCORE_EXPORT IntervalTable MakeIntervalTable(const TransferFunction& function);

/// Colour and attenuation at a scalar; at a step the value from larger scalars.
TETRALUXCORE_EXPORT TransferFunction::Value Evaluate(
  const TransferFunction& function, double scalar);

/// Largest change of a premultiplied colour channel or of the attenuation per unit of x, between
/// the steps.
TETRALUXCORE_EXPORT double FindSteepestColor(const IntervalTable& table);

} // namespace tetralux

#endif
