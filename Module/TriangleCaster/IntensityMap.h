// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntensityMap_h
#define tetralux_IntensityMap_h

#include "Base/Cached.h"
#include "Lighting/KernelLighting.h"
#include "View/RayGrid.h"

#include <vector>

namespace tetralux
{

/// What distant lights make of a colour, over the directions of gradients, for the viewing
/// direction of the picture's centre (Knittel 1999, section 7, equation 6).
///
/// Gradients are scaled so that their largest component is 1. Of the paper's map of 5 bits a
/// component, those meet three faces of a cube only, and no others exist: lit by both sides,
/// opposite gradients are the same.
class IntensityMap
{
public:
  /// Directions along the edge of a face: 5 bits. The first and last one are at -1 and 1.
  static constexpr int Size = 32;
  /// The entry of what has no gradient, and of all behind it.
  static constexpr int NoGradient = 3 * Size * Size;

  /// The colour times Scale plus Add is lit.
  struct alignas(16) Entry
  {
    float Scale[3], Unused0;
    float Add[3], Unused1;
  };

  /// Makes the map unless it was made of the same lights and view. Throws std::invalid_argument,
  /// with one line, if a light is positional. threads: at least 1.
  void Update(const KernelLighting& lighting, const RayGrid& grid, int threads);

  /// The entry of a gradient g with component a of 1, and u and v the two components that follow it
  /// cyclically, is (a Size + v) Size + u, with u and v counted from 0 to Size - 1. Behind
  /// NoGradient there are so many copies of it that its neighbours exist as well.
  const std::vector<Entry>& GetEntries() const { return this->Entries.Get(); }

private:
  Cached<std::vector<Entry>> Entries;
};

} // namespace tetralux

#endif
