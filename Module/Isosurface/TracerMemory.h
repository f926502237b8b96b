// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TracerMemory_h
#define tetralux_TracerMemory_h

#include "Base/Tile.h"
#include "Isosurface/IsosurfaceKernel.h"

#include <algorithm>
#include <vector>

namespace tetralux
{

/// BlockMemory with its memory.
class OwningBlockMemory : public BlockMemory
{
public:
  OwningBlockMemory()
  {
    this->Grow = [](BlockMemory& block, int count)
    { static_cast<OwningBlockMemory&>(block).Reserve(count); };
  }
  OwningBlockMemory(const OwningBlockMemory&) = delete;
  OwningBlockMemory& operator=(const OwningBlockMemory&) = delete;

private:
  struct alignas(64) Room
  {
    char Bytes[PlacedPolygonBytes];
  };

  void Reserve(int count)
  {
    this->Capacity = std::max(count, 2 * this->Capacity);
    this->Rooms.resize(this->Capacity);
    this->Polygons = this->Rooms.data();
    float** bounds[4] = { &this->LowU, &this->HighU, &this->LowV, &this->HighV };
    for (int b = 0; b < 4; ++b)
    {
      this->Bounds[b].resize(this->Capacity);
      *bounds[b] = this->Bounds[b].data();
    }
  }

  std::vector<Room> Rooms;
  std::vector<float> Bounds[4];
};

/// What a thread writes while it traces.
struct TracerMemory
{
  IsosurfaceScratch Scratch;
  OwningBlockMemory Block;
  IsosurfaceCounts Counts;
  std::vector<float> Visible;
  Tile Covered{ 0, 0, 0, 0 };
};

} // namespace tetralux

#endif
