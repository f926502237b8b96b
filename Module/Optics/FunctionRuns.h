// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FunctionRuns_h
#define tetralux_FunctionRuns_h

// Runs of intervals of a transfer function that are integrated as one: attenuation is linear along
// a run, and each colour channel is a parabola. What a ray costs then depends on how smooth the
// colours are, and not on how many nodes they have.

#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// How far runs may be off the function.
struct RunTolerance
{
  double Color = 0;            ///< of a channel of the colour, absolute
  double AttenuationShare = 0; ///< of the attenuation, as a share of it

  /// What a channel of a picture is off by, at most, by both.
  double Picture = 0;

  /// Whether there are runs of more than one interval at all.
  bool Allows() const { return this->Picture > 0; }
};

/// The tolerance that keeps pictures within an error. longestPath: of a ray, world units.
///
/// With absorption a ray's radiance is a mean of the colours: it is off by what they are off by at
/// most. An attenuation that is off by a share s changes the optical depth T by s T at most, and a
/// channel of colours up to C by at most C times the integral of (s + s T) exp(-T) dT, which is at
/// most 2 C s. Emission alone adds up attenuation times colour, and is off by as much more as the
/// largest attenuation times longestPath is above 1. Absorption alone has no colours. Of a largest
/// scalar and of isosurfaces the function is looked up once for each ray or surface: it stays as it
/// is.
TETRALUXCORE_EXPORT RunTolerance MakeRunTolerance(
  OpticalModel model, const TransferFunction& function, double error, double longestPath);

/// Intervals between two nodes, taken as one. Colours meet the function at both ends, and in
/// between are linear plus Bulge times 4 w (1 - w), with w from 0 to 1.
struct FunctionRun
{
  std::size_t First; ///< nodes
  std::size_t Last;
  double Bulge[3];
};

struct FunctionRuns
{
  std::vector<FunctionRun> Runs; ///< from the first node to the last one
  std::int64_t Visits = 0;       ///< of intervals while runs were looked for
};

/// Makes runs as long as a tolerance allows, from the first node on. Steps, bends of the
/// attenuation, and every 32,768th node begin runs. Colours count only where there is attenuation.
/// A channel that is nowhere negative stays so. function: one that MakeIntervalTable accepts. Each
/// run is looked for from the length of the one before, by doubled and then by halved steps, so
/// visits are at most in proportion to the nodes times the logarithm of a run's length. Uses all
/// threads; runs do not depend on their number.
TETRALUXCORE_EXPORT FunctionRuns FindFunctionRuns(
  const TransferFunction& function, const RunTolerance& tolerance);

} // namespace tetralux

#endif
