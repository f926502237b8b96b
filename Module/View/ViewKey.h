// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ViewKey_h
#define tetralux_ViewKey_h

// What pictures follow from, for the keys of what is kept. KeyT: CacheKey.

#include "View/RayGrid.h"
#include "View/RayLimits.h"

namespace tetralux
{

template <class KeyT, class NumbersT>
void AddNumbersTo(KeyT& key, const NumbersT& numbers)
{
  for (const auto number : numbers)
  {
    key.Add(number);
  }
}

template <class KeyT>
void AddRaysTo(KeyT& key, const RayGrid& grid)
{
  key.Add(grid.Width);
  key.Add(grid.Height);
  AddNumbersTo(key, grid.Origin);
  AddNumbersTo(key, grid.OriginStepX);
  AddNumbersTo(key, grid.OriginStepY);
  AddNumbersTo(key, grid.Direction);
  AddNumbersTo(key, grid.DirectionStepX);
  AddNumbersTo(key, grid.DirectionStepY);
  for (const auto& row : grid.MeshFromWorld)
  {
    AddNumbersTo(key, row);
  }
}

/// All but MaximumDistances.
template <class KeyT>
void AddLimitsTo(KeyT& key, const RayLimits& limits)
{
  key.Add(limits.NumberOfCameraPlanes);
  key.Add(limits.Planes.size());
  for (const auto& plane : limits.Planes)
  {
    AddNumbersTo(key, plane);
  }
  key.Add(limits.Cropping);
  AddNumbersTo(key, limits.CroppingPlanes);
  key.Add(limits.CroppingFlags);
}

} // namespace tetralux

#endif
