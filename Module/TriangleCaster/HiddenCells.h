// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_HiddenCells_h
#define tetralux_HiddenCells_h

#include "TriangleCaster/ImageVolume.h"

#include <vector>

namespace tetralux
{

/// For the first point of each cell whether the cell is hidden, by its flags or those of a point of
/// it: 1, or else 0; for other points 0. Empty if no cell is hidden. threads: at least 1.
std::vector<unsigned char> FindHiddenCells(const ImageVolume& volume, int threads);

} // namespace tetralux

#endif
