// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_StabilitySuite_h
#define tetralux_StabilitySuite_h

#include "Base/Span.h"
#include "Stability/StabilityCases.h"
#include "Stability/StabilityForms.h"

#include <string>
#include <vector>

namespace tetralux
{

/// How wrong one form is over the cases of one group, against quadrature in extended precision.
///
/// Errors are those of the three colour channels, premultiplied, and of the opacity. The colours of
/// all cases are in 0..1.
struct StabilityRow
{
  std::string Form;
  std::string Group;
  int NumberOfCases = 0; ///< that the form took

  /// Largest error over the exact opacity (over the optical depth where only light is emitted); of
  /// segments with an opacity above SmallestOpacity.
  double RelativeError = 0;

  double AbsoluteError = 0; ///< largest error

  /// Largest error over what the form promises for the case: above 1 the promise is broken.
  double ShareOfPromise = 0;

  /// Number of results that are never right: with a channel that is not a number or infinite, with
  /// one below 0, with an opacity above 1.
  ///@{
  int NotFinite = 0;
  int Negative = 0;
  int AboveOne = 0;
  ///@}

  bool IsKept() const
  {
    return this->ShareOfPromise <= 1 && this->NotFinite + this->Negative + this->AboveOne == 0;
  }
};

/// Opacities below this lose digits of their own: numbers of double precision do below 1e-308,
/// those of single precision below 1e-38.
constexpr double SmallestOpacity = 1e-30;

/// A row for each form and group, in the order of both.
std::vector<StabilityRow> MeasureStability(
  Span<const StabilityGroup> groups, Span<const StabilityForm> forms);

} // namespace tetralux

#endif
