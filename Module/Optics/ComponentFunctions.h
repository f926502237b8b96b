// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ComponentFunctions_h
#define tetralux_ComponentFunctions_h

#include "Optics/TransferFunction.h"

#include <vector>

namespace tetralux
{

/// Scalars at one place, at most: as many as a volume property of VTK has functions for.
constexpr int MostComponents = 4;

/// How several scalars at one place make attenuation and colour, by a function of each, with
/// attenuations a_j and colours c_j.
///
/// - Independent ones are mixed as clouds of particles: the attenuation is the sum of all a_j, the
///   emission that of all a_j c_j.
/// - Of dependent ones the last one attenuates, and the others colour: the attenuation is that of
///   the last one, the colour the sum of those of the others.
struct ComponentFunctions
{
  std::vector<TransferFunction> Functions; ///< 2 to MostComponents; empty: there is one scalar
  bool Dependent = false;
};

} // namespace tetralux

#endif
