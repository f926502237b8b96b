// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayPicture_h
#define tetralux_RayPicture_h

#include "Base/Span.h"
#include "OpenGL/FloatTarget.h"
#include "TetraluxRenderingModule.h"

#include <cstddef>
#include <cstdint>
#include <deque>

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace tetralux
{

/// What rays come to, in bands of rows, from the lowest one up: colours, premultiplied, and the
/// distances of the first contributions; 20 bytes a pixel. Belongs to one window's context, the
/// last one.
class TETRALUXRENDERING_EXPORT RayPicture
{
public:
  /// The pictures of a band.
  enum Channel
  {
    Colors,    ///< RGBA
    Distances, ///< one number
    Steps      ///< one number, where they are counted: 4 bytes a pixel more
  };

  /// Makes the bands, unless they are there already; what they show is then undefined. Throws what
  /// FloatTarget::Prepare does.
  void Prepare(
    vtkOpenGLRenderWindow* window, int width, int height, int rowsOfBand, bool countsSteps);

  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  int GetRowsOfBand() const { return this->RowsOfBand; } ///< the last one may have fewer
  int GetNumberOfBands() const { return static_cast<int>(this->Bands.size()); }
  FloatTarget& GetBand(int band) { return this->Bands[static_cast<std::size_t>(band)]; }
  int GetFirstRow(int band) const { return band * this->RowsOfBand; }

  /// Copies a channel of all bands, lower row first.
  void Read(Channel channel, Span<float> values);

  /// Of all rays.
  std::int64_t CountSteps();

  std::size_t GetNumberOfBytes() const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  std::deque<FloatTarget> Bands;
  int Width = 0;
  int Height = 0;
  int RowsOfBand = 1;
};

} // namespace tetralux

#endif
