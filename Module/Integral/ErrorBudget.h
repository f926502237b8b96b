// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ErrorBudget_h
#define tetralux_ErrorBudget_h

#include <algorithm>

namespace tetralux
{

/// What a frame spends of the error that is allowed, on top of what every frame spends.
struct ErrorSpending
{
  bool EndsEarly = false;    ///< rays end where little is left to see
  bool Tabulated = false;    ///< segments are looked up in a table
  bool Buffered = false;     ///< colours are composited in a buffer of less than single precision
  bool Approximated = false; ///< others stand for functions of the property
  bool LightVaries = false;  ///< on a ray's way through a cell
  bool Sliced = false;       ///< the distance of slices follows from the error
};

/// How MaximumError is divided: the shares add up to it. Each choice that trades error for time
/// stays within its own share, so the picture stays within MaximumError.
struct ErrorBudget
{
  // Of every frame.
  double Geometry = 0; ///< single precision coordinates and scalars; more takes double precision
  double Rounding = 0; ///< weights of segments, and adding them up

  // Of frames that spend it, else 0.
  double Functions = 0;   ///< approximating functions
  double Termination = 0; ///< ending rays early
  double Table = 0;       ///< looking segments up
  double Buffer = 0;      ///< rounding what is in the frame buffer
  double Light = 0;       ///< light that varies in cells
  double Slices = 0;      ///< what is between slices

  /// For a method whose geometry has an error above its share and no other arithmetic: ending rays
  /// early gives up what is missing, but for an eighth of its own share.
  void CoverGeometry(double error)
  {
    const double missing = std::max(0., error - this->Geometry);
    const double given = std::min(missing, 0.875 * this->Termination);
    this->Termination -= given;
    this->Geometry += given;
  }
};

/// Rounding takes an eighth, and geometry three. Of the other half a table, or light, and a buffer
/// take a quarter of all each, and slices three eighths. Ending rays early takes what they leave.
/// Functions that are approximated take a quarter of all (an eighth beside slices, or light that
/// varies): one eighth from geometry, and the other one from the other half, or if that is all
/// taken from geometry, too.
inline ErrorBudget MakeErrorBudget(double maximumError, const ErrorSpending& spending)
{
  ErrorBudget budget;
  const double eighth = 0.125 * maximumError;
  budget.Rounding = eighth;
  budget.Geometry = 3 * eighth;
  budget.Table = spending.Tabulated ? 2 * eighth : 0;
  budget.Buffer = spending.Buffered ? 2 * eighth : 0;
  budget.Light = spending.LightVaries ? 2 * eighth : 0;
  budget.Slices = spending.Sliced ? 3 * eighth : 0;
  double left = 4 * eighth - budget.Table - budget.Buffer - budget.Light - budget.Slices;
  if (spending.Approximated)
  {
    const bool least = spending.Sliced || spending.LightVaries;
    budget.Functions = (least ? 1 : 2) * eighth;
    budget.Geometry -= eighth;
    if (!least)
    {
      (left > 0 ? left : budget.Geometry) -= eighth;
    }
  }
  budget.Termination = spending.EndsEarly ? left : 0;
  return budget;
}

} // namespace tetralux

#endif
