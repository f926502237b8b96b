// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TransferFunctionFromProperty_h
#define tetralux_TransferFunctionFromProperty_h

#include "Optics/TransferFunction.h"
#include "TetraluxRenderingModule.h"

class vtkVolumeProperty;

namespace tetralux
{

/// The least error that a property's functions are approximated to: single precision tables have
/// no less.
constexpr double SmallestFunctionError = 1e-7;

/// A channel that is larger may leave single precision on its way to the picture.
constexpr double LargestColor = 1e20;

struct PropertyTransferFunction
{
  TransferFunction Function;

  /// Error of a colour channel that approximating the property adds, 0 where it is piecewise
  /// linear.
  double Error = 0;
};

/// Colour and scalar opacity of a property's component as VTK's functions define them, with
/// attenuation = opacity / ScalarOpacityUnitDistance (opacities below 0 count as 0, and optical
/// depths along longestPath are 1e15 at most).
///
/// Nodes are at the exact scalars of the property's nodes; steps (duplicated nodes, sharpness 1,
/// clamping off, colours above and below the range) stay steps. Where VTK's function is not linear
/// between nodes - other colour spaces than RGB, sharpness, logarithmic scale - nodes are added
/// until it is, as far as maximumError allows (of a premultiplied channel, more than 0) on rays
/// through the volume of at most longestPath world units. At a step's own scalar the value from
/// larger scalars counts, where VTK takes the one from smaller scalars.
///
/// Added nodes are as many as the curve between two nodes asks for: few where nodes are dense.
/// VTK's functions are evaluated on all threads; the result does not depend on their number.
///
/// Where VTK cuts colours off at white, in Lab and Diverging, as little as 2.4e-5 of that may be
/// missed between two values that are looked at; so may a fifth more than maximumError elsewhere.
///
/// The colour space LabCIEDE2000 costs a tenth of a second an interval, and is represented by 1024
/// colours of each, whose error is not known.
///
/// Throws std::invalid_argument, with one line, where the unit distance is not positive, or a
/// function has values that are not finite, or colours above 1e20.
TETRALUXRENDERING_EXPORT PropertyTransferFunction TransferFunctionFromProperty(
  vtkVolumeProperty* property, double maximumError, double longestPath, int component = 0);

/// Scalar opacities in the place of attenuations: of models in which lengths do not count, or count
/// in another way.
TETRALUXRENDERING_EXPORT void RemoveUnitDistance(TransferFunction& function, double unitDistance);

} // namespace tetralux

#endif
