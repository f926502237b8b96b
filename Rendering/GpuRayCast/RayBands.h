// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayBands_h
#define tetralux_RayBands_h

#include "TetraluxRenderingModule.h"

#include <cstdint>
#include <functional>

namespace tetralux
{

/// A picture whose rays are cast in bands of rows, one after the other, so that what rays keep
/// between passes is needed for one band only.
struct RayBandRequest
{
  int Width = 1; ///< of the picture, pixels
  int Height = 1;
  std::int64_t BytesPerPixel = 0; ///< of what rays keep
  std::int64_t MaximumBytes = 0;  ///< of all of that; one row is made in any case
  int LargestSize = 1;            ///< of what OpenGL draws into, pixels in each direction

  bool operator==(const RayBandRequest& other) const
  {
    return this->Width == other.Width && this->Height == other.Height &&
      this->BytesPerPixel == other.BytesPerPixel && this->MaximumBytes == other.MaximumBytes &&
      this->LargestSize == other.LargestSize;
  }
};

/// Rows of a band, of bands that are as few as the request allows and as equal as whole rows are.
/// Throws std::runtime_error, with one line, where the picture is too wide.
TETRALUXRENDERING_EXPORT int FindRowsOfBand(const RayBandRequest& request);

/// Calls make with a number of rows, and with half as many as long as it throws
/// OutOfGraphicsMemory; that of a single row is thrown on. Returns the rows that were made.
TETRALUXRENDERING_EXPORT int HalveRowsUntilMade(
  int rows, const std::function<void(int rows)>& make);

} // namespace tetralux

#endif
