// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageOptics_h
#define tetralux_ImageOptics_h

#include "Optics/TransferFunction.h"
#include "TriangleCaster/TransferTable.h"

namespace tetralux
{

/// How the opacity of a step follows from the scalar opacity a of the transfer function, 0..1, and
/// the step's length l in unit distances.
enum class StepOpacity
{
  Power,      ///< 1 - (1 - a)^l: the model of VTK's mappers of image data
  Attenuation ///< 1 - exp(-a l): that of mappers of unstructured grids
};

/// How long a gradient is.
enum class GradientNorm
{
  Euclidean, ///< L2
  Sum        ///< L1, the sum of its components: less to compute (Knittel 1999, section 7)
};

/// What the rays gather in an image volume.
struct ImageOptics
{
  /// Colours, and the scalar opacity a in place of the attenuation: 0..1, or for
  /// StepOpacity::Attenuation at least 0.
  TransferFunction Function;
  StepOpacity Opacity = StepOpacity::Power;
  double UnitDistance = 1; ///< world units, above 0

  /// A factor of the scalar opacity, 0..1, in place of the attenuation, over the length of the
  /// scalar's gradient times GradientLength. Without nodes there is none.
  TransferFunction GradientOpacity;
  double GradientLength = 1; ///< world units, above 0; VTK has the mean spacing of points
  GradientNorm Norm = GradientNorm::Euclidean;

  /// In place of Function and GradientOpacity. Without entries there is none.
  TransferTable Table;
};

} // namespace tetralux

#endif
