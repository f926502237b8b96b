// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OrderedPictures_h
#define tetralux_OrderedPictures_h

#include "Compositing/PartialPicture.h"

#include <array>
#include <cstddef>
#include <vector>

class vtkMultiProcessController;

namespace tetralux
{

struct OrderedPictures
{
  PartialPicture Whole;  ///< in the process that shows it; empty in the others
  std::size_t Bytes = 0; ///< that all processes sent for it together
};

/// Composites the pictures of all processes in float. To be called by all of them at once.
///
/// order: the processes, the nearest one first. shower: the process that shows the whole. origin:
/// where the origin of this process's frame buffer is, in pixels from a point that is common to
/// all; they differ by whole pixels.
OrderedPictures CompositePictures(vtkMultiProcessController* controller,
  const std::vector<int>& order, int shower, const PartialPicture& mine,
  const std::array<double, 2>& origin);

} // namespace tetralux

#endif
