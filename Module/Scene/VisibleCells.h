// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibleCells_h
#define tetralux_VisibleCells_h

#include "Base/Span.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// For each cell 1 where the transfer function gives it any attenuation, 0 where it is fully
/// transparent or touches a scalar that is not finite.
/// cells: four point ids each. scalars: one for each point, or for each cell. Parallel.
TETRALUXCORE_EXPORT std::vector<std::uint8_t> FindVisibleCells(const TransferFunction& function,
  Span<const std::int32_t> cells, Span<const double> scalars, bool scalarsOfCells);

/// For each cell 1 where a surface of constant scalar that is not fully transparent goes through it
/// or touches it, else 0. scalars: one for each point. rounding: by how much whoever draws them may
/// move the scalars relative to the surfaces' values; cells that are crossed only then have 1, too.
/// Parallel.
TETRALUXCORE_EXPORT std::vector<std::uint8_t> FindCrossedCells(Span<const Isosurface> surfaces,
  Span<const std::int32_t> cells, Span<const double> scalars, double rounding);

} // namespace tetralux

#endif
