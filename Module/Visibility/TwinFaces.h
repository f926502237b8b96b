// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TwinFaces_h
#define tetralux_TwinFaces_h

#include "Visibility/VisibilityGeometry.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// For each boundary face the one other that has its three corners at the same places, of cells
/// that touch without sharing points; -1 where there is none, or more than one. Coordinates are
/// compared exactly. Linear time, the same result for any number of threads.
std::vector<std::int32_t> FindTwinFaces(const VisibilityGeometry& geometry);

} // namespace tetralux

#endif
