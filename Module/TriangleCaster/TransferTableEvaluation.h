// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TransferTableEvaluation_h
#define tetralux_TransferTableEvaluation_h

#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"
#include "TriangleCaster/TransferTable.h"

namespace tetralux
{

/// Throws std::invalid_argument, with one line, unless the table has 2 columns and rows or more, as
/// many entries as those say, ranges that ascend, colours that are finite and opacities that are
/// not negative.
TETRALUXCORE_EXPORT void CheckTable(const TransferTable& table);

/// What a table has at a scalar and a gradient length.
TETRALUXCORE_EXPORT TransferTable::Entry Evaluate(
  const TransferTable& table, double scalar, double length);

/// A table over the same ranges with other numbers of entries, each at least 2: reduced precision,
/// such as the 5 bits a side of section 7.
TETRALUXCORE_EXPORT TransferTable Resample(const TransferTable& table, int columns, int rows);

/// Where a table has any opacity for any gradient: an attenuation of 1, else of 0. Its first and
/// last node are at the first and last column.
TETRALUXCORE_EXPORT TransferFunction FindVisibleScalars(const TransferTable& table);

} // namespace tetralux

#endif
