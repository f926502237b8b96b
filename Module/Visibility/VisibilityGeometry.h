// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibilityGeometry_h
#define tetralux_VisibilityGeometry_h

#include "Base/Span.h"
#include "Walk/WalkTables.h"

#include <array>
#include <cstdint>

namespace tetralux
{

/// What a visibility order is made from: the cells of a mesh and the imaginary cells
/// behind them, with four ascending point ids each; the points in double precision; and
/// what lies behind each face.
struct VisibilityGeometry
{
  Span<const double> Points;
  Span<const double> SteinerPoints; ///< behind Points
  Span<const std::int32_t> Cells;
  Span<const std::int32_t> ImaginaryCells; ///< behind Cells
  Span<const WalkFace> Faces;              ///< of both

  const WalkTables* Boundary = nullptr; ///< of the cells without imaginary ones

  /// All points in single precision, relative to Center in units of Radius.
  const WalkPoint<float>* RelativePoints = nullptr;
  std::array<double, 3> Center = { 0, 0, 0 };
  double Radius = 1;

  std::int64_t GetNumberOfCells() const
  {
    return static_cast<std::int64_t>((this->Cells.size() + this->ImaginaryCells.size()) / 4);
  }

  const double* GetPoint(std::int32_t point) const
  {
    const std::size_t first = 3 * static_cast<std::size_t>(point);
    return first < this->Points.size() ? this->Points.data() + first
                                       : this->SteinerPoints.data() + (first - this->Points.size());
  }

  const std::int32_t* GetPointIds(std::int64_t cell) const
  {
    const std::size_t first = 4 * static_cast<std::size_t>(cell);
    return first < this->Cells.size() ? this->Cells.data() + first
                                      : this->ImaginaryCells.data() + (first - this->Cells.size());
  }

  std::array<const double*, 4> GetCorners(std::int64_t cell) const
  {
    const std::int32_t* ids = this->GetPointIds(cell);
    return { this->GetPoint(ids[0]), this->GetPoint(ids[1]), this->GetPoint(ids[2]),
      this->GetPoint(ids[3]) };
  }
};

} // namespace tetralux

#endif
