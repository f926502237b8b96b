// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntegrationPlan_h
#define tetralux_IntegrationPlan_h

// Which table an optical model needs for the transfer function at hand (Weiler et al. 2003, section
// 4), and the small tables: the length of a segment affects what it adds linearly or not at all,
// but in one model.

#include "Base/Span.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

#include <vector>

namespace tetralux
{

/// What a segment is looked up by.
enum class TableShape
{
  None,         ///< no table: a closed form that is cheaper than any lookup
  Scalar,       ///< 1-D, over a scalar
  Scalars,      ///< 2-D, over the scalars at the front and the back
  ScalarsLength ///< 3-D, over both and the length: PreIntegrationTable
};

/// How segments are to be integrated.
struct IntegrationPlan
{
  /// The table that does instead of the closed form, which is exact for every model but costs as
  /// much as a segment has pieces.
  TableShape Table = TableShape::None;

  /// Nothing contributes anywhere in the range of the scalars: there is nothing to cast.
  bool Transparent = false;

  /// Whatever contributes has the same colour, Color: a table needs no colours.
  bool ConstantColor = false;
  double Color[3] = { 0, 0, 0 };

  /// Most pieces of a segment in the range of the scalars, each linear.
  int LargestNumberOfPieces = 1;

  const char* Reason = ""; ///< one line, for statistics
};

/// The plan of a model for scalars in a range (ends included).
///
/// * EmissionAbsorption: no table where the function is one linear ramp. With a constant colour
///   2-D: the mean attenuation, MakeMeanTable; opacity 1 - exp(-length mean), times the colour.
///   Else 3-D.
/// * EmissionOnly: in proportion to the length, so 2-D, MakeMeanTable; none for one ramp.
/// * AbsorptionOnly: the mean attenuation is all it needs, 2-D, MakeMeanTable; none for one ramp.
/// * MaximumIntensity: the transfer function at one scalar, 1-D, MakeTransferTable; none for one
///   ramp.
/// * Isosurfaces (of which the transfer function is not used): 2-D, MakeIsosurfaceTable. Shaded
///   ones, too: all crossings in a cell have its gradient, so each light changes them alike. With
///   one surface no table: two comparisons.
TETRALUXCORE_EXPORT IntegrationPlan MakeIntegrationPlan(OpticalModel model,
  const TransferFunction& function, const double scalarRange[2],
  Span<const Isosurface> surfaces = {});

/// Four channels over one or two scalars, in single precision: equal steps from one end of the
/// range to the other, with a texel's centre at each end. Texel (f, b) begins at 4 (b Size + f),
/// front scalar fastest; in a 1-D table b is 0.
struct ScalarTable
{
  TableShape Shape = TableShape::Scalar;
  int Size = 0; ///< texels along each scalar
  double ScalarRange[2] = { 0, 1 };
  std::vector<float> Texels;

  /// Scalar of a texel's centre.
  double GetScalar(int texel) const
  {
    const double t = static_cast<double>(texel) / (this->Size - 1);
    return (1 - t) * this->ScalarRange[0] + t * this->ScalarRange[1];
  }
};

// Of all of them: scalarRange is finite and ascending, size in 2..4096, or std::invalid_argument is
// thrown with one line that says so. Texels are exact to single precision.

/// 1-D: colour and opacity of each scalar, premultiplied, for MaximumIntensity. To be interpolated.
TETRALUXCORE_EXPORT ScalarTable MakeTransferTable(
  const TransferFunction& function, const double scalarRange[2], int size);

/// 2-D: means of attenuation times colour and of attenuation along a segment from one scalar to
/// another, which are emission and optical depth for each unit of length. Not premultiplied by
/// anything else. To be interpolated.
TETRALUXCORE_EXPORT ScalarTable MakeMeanTable(
  const TransferFunction& function, const double scalarRange[2], int size);

/// 2-D: premultiplied colour and opacity of all flat surfaces that a segment crosses, front to
/// back. Between texels surfaces come and go at once: to be looked up at the nearest texel, which
/// moves them by half a step of the table at most; interpolation fades them over one step.
TETRALUXCORE_EXPORT ScalarTable MakeIsosurfaceTable(
  Span<const Isosurface> surfaces, const double scalarRange[2], int size);

} // namespace tetralux

#endif
