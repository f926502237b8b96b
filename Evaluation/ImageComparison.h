// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageComparison_h
#define tetralux_ImageComparison_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"

#include <cstddef>
#include <iosfwd>

namespace tetralux
{

/// Errors over a set of covered pixels. The error of a pixel is the largest absolute difference of
/// its four channels, premultiplied, 0..1; infinite where the picture is not a number.
struct ImageErrors
{
  std::size_t NumberOfPixels = 0;
  double Maximum = 0;
  double RootMeanSquare = 0; ///< over all channels of the pixels
  double Quantile999 = 0;    ///< at most this in 99.9 % of the pixels
  double ShareAbove1e4 = 0;  ///< share of the pixels with an error above 1e-4
  double ShareAbove1Of255 = 0;
  std::size_t WorstPixel = 0; ///< index of the pixel with the largest error
};

struct ImageComparison
{
  ImageErrors Covered;  ///< pixels where either picture has any alpha
  ImageErrors Ungrazed; ///< those of them that no silhouette grazes; all without a measure of it
};

/// Compares a picture with its reference: four channels for each pixel, premultiplied.
/// grazing: one for each pixel, from MeasureGrazing, or empty; a pixel above grazingThreshold is
/// grazed. Throws std::invalid_argument where the sizes differ.
TETRALUXCORE_EXPORT ImageComparison CompareWithReference(Span<const float> rgba,
  Span<const double> reference, Span<const double> grazing = {}, double grazingThreshold = 2e-5);

/// One line for each of the two sets.
TETRALUXCORE_EXPORT std::ostream& operator<<(
  std::ostream& stream, const ImageComparison& comparison);

} // namespace tetralux

#endif
