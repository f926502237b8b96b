// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntervalTable_h
#define tetralux_IntervalTable_h

#include "Optics/FunctionRuns.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// A transfer function as the kernels read it: one entry for each interval on which it is linear,
/// or for each of its FunctionRuns, over scalars mapped to x = (s - Offset) / Scale: nodes are in
/// [-1, 1].
struct IntervalTable
{
  /// Sixteen floats, loaded as rows of four. On [Lo, Hi], d = x - Reference, the attenuation is
  /// Attenuation + AttenuationSlope d, and the colour Color + ColorSlope d + ColorBend d^2.
  /// Evaluated in single precision what has no bend stays between the values at both ends.
  /// Reference is the end with less attenuation. The first interval reaches down to minus infinity,
  /// the last one up to infinity; both are constant.
  struct alignas(16) Interval
  {
    float Lo, Hi, Reference, Attenuation;
    float AttenuationSlope, Color[3];
    float ColorSlope[3], Unused;
    float ColorBend[3], UnusedToo;
  };

  std::vector<Interval> Intervals;
  bool Curved = false; ///< any interval has a bend
  bool Exact = true;   ///< no interval stands for several of the function
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
/// With a tolerance that allows them, there is an interval for each of FindFunctionRuns; else for
/// each of the function's own.
TETRALUXCORE_EXPORT IntervalTable MakeIntervalTable(
  const TransferFunction& function, const RunTolerance& tolerance = {});

/// Colour and attenuation at a scalar; at a step the value from larger scalars.
TETRALUXCORE_EXPORT TransferFunction::Value Evaluate(
  const TransferFunction& function, double scalar);

} // namespace tetralux

#endif
