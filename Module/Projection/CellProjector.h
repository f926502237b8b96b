// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellProjector_h
#define tetralux_CellProjector_h

#include "Projection/LocalCell.h"
#include "Projection/ProjectedCell.h"
#include "Projection/ProjectionSettings.h"
#include "Projection/ScreenFrame.h"

#include <array>
#include <optional>

namespace tetralux
{

/// Projects one cell after the other.
class CellProjector
{
public:
  CellProjector(const ScreenFrame& frame, const ProjectionSettings& settings)
    : Frame(frame)
    , Settings(settings)
  {
  }

  /// See ProjectCell. What follows is of the last cell, one that is seen.
  int Project(const ScreenPoint* const (&points)[4], ProjectedCell& result);

  /// The faces that are the base, Face0, Face1 and Face2, each by the point opposite to it.
  const std::array<int, 4>& GetFaces() const { return this->Faces; }

  /// The scalar at the eye, of the field in the cell; infinite in a parallel view: the end that
  /// rays come from.
  double GetEyeScalar() const { return this->EyeScalar; }

  /// From gradients at its points.
  ProjectedGradient Project(const double gradients[4][3]) const;

private:
  const ScreenFrame& Frame;
  const ProjectionSettings& Settings;
  std::optional<LocalCell> Cell;
  Linear Base = { 0, 0, 0 };
  double EyeScalar = 0;
  double Sign = 1; ///< 1 where the base is a front face, else -1
  std::array<int, 4> Faces = { 0, 1, 2, 3 };
};

} // namespace tetralux

#endif
