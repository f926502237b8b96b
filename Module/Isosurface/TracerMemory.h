// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TracerMemory_h
#define tetralux_TracerMemory_h

#include "Base/Tile.h"
#include "Isosurface/IsosurfaceKernel.h"

#include <vector>

namespace tetralux
{

/// What a thread writes while it traces.
struct TracerMemory
{
  IsosurfaceScratch Scratch;
  IsosurfaceCounts Counts;
  std::vector<float> Visible;
  Tile Covered{ 0, 0, 0, 0 };
};

} // namespace tetralux

#endif
