// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OwnedCrossings_h
#define tetralux_OwnedCrossings_h

#include "RayCast/RayCastKernel.h"

#include <vector>

namespace tetralux
{

/// A CrossingBuffer that owns its memory.
struct OwnedCrossings : CrossingBuffer
{
  std::vector<FaceCrossing> Storage;

  OwnedCrossings()
  {
    this->Capacity = 16;
    this->Grow = &OwnedCrossings::Double;
    Double(*this);
  }

  static void Double(CrossingBuffer& buffer)
  {
    auto& self = static_cast<OwnedCrossings&>(buffer);
    self.Capacity *= 2;
    self.Storage.resize(static_cast<std::size_t>(self.Capacity));
    self.Crossings = self.Storage.data();
  }
};

} // namespace tetralux

#endif
