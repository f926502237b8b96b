// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_WorstOfPicture_h
#define tetralux_WorstOfPicture_h

#include "TetraluxCoreModule.h"

#include <vector>

namespace tetralux
{

/// How much worse the worst ray of a picture is than one in a thousand: with this factor no
/// estimate of 264 pictures of 256 x 256 was below the error, grazing pixels included
/// (Documentation/Benchmarks.md).
constexpr double WorstOfPicture = 5;

/// What one ray in a thousand exceeds. errors, weights: of each ray of a sample, as in
/// RaySample::Weights.
TETRALUXCORE_EXPORT double FindOneInThousand(
  const std::vector<double>& errors, const std::vector<double>& weights);

} // namespace tetralux

#endif
