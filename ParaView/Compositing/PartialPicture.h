// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PartialPicture_h
#define tetralux_PartialPicture_h

#include "Frame/DrawnViewport.h"

#include <vector>

namespace tetralux
{

/// What a process shows of a volume: premultiplied colours and opacity of a rectangle of pixels,
/// lower row first, four numbers a pixel. The opacity of a pixel that shows opaque geometry of the
/// process behind the volume has the negative sign, also where it is zero: nothing that lies behind
/// that geometry is seen.
struct PartialPicture
{
  PixelRectangle Rectangle; ///< of the frame buffer; empty where Width is 0
  std::vector<float> Colors;
};

} // namespace tetralux

#endif
