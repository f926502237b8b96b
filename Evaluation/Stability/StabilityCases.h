// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_StabilityCases_h
#define tetralux_StabilityCases_h

#include "Optics/TransferFunction.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tetralux
{

/// A segment of a ray whose integral is hard to get right, with the scalar running linearly from
/// one end to the other.
struct StabilityCase
{
  TransferFunction Function; ///< colours in 0..1
  double FrontScalar;
  double BackScalar;
  double Length; ///< world units, more than 0
};

/// Cases that are hard for the same reason.
struct StabilityGroup
{
  std::string Name;
  std::vector<StabilityCase> Cases;
};

/// All groups: optical depth per segment from 1e-12 to 1e6; attenuation slopes from -1e6 to 1e6;
/// scalars at both ends equal or nearly so; steps; needle peaks down to 1e-12 of the scalar range;
/// opacity 1; scalar ranges from 1e-300 to 1e300; a constant field; lengths from 1e-9 to 1; and all
/// of it combined at random.
///
/// The same seed gives the same random cases wherever it is run, but for the last bit of std::pow.
std::vector<StabilityGroup> MakeStabilityGroups(std::uint64_t seed, int numberOfRandomCases);

} // namespace tetralux

#endif
