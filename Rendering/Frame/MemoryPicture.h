// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MemoryPicture_h
#define tetralux_MemoryPicture_h

#include <cstdint>

namespace tetralux
{

/// A picture in the processor's memory, lower row first. It has Colors or Bytes.
struct MemoryPicture
{
  int Width = 0;
  int Height = 0;

  /// Four a pixel, premultiplied.
  const float* Colors = nullptr;

  /// Four a pixel, 0..255. The picture is opaque where its depth is below 1, and empty elsewhere.
  const std::uint8_t* Bytes = nullptr;

  /// One a pixel, what the depth buffer is to hold unless it holds less. Where it is 1 or more, the
  /// buffer stays as it is. nullptr: it does everywhere.
  const float* Depths = nullptr;
};

} // namespace tetralux

#endif
