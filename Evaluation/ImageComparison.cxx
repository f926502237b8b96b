// SPDX-License-Identifier: BSD-3-Clause
#include "ImageComparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

/// Collects pixels one by one.
class ErrorCollector
{
public:
  void Add(std::size_t pixel, const double channels[4])
  {
    double error = 0;
    for (int channel = 0; channel < 4; ++channel)
    {
      error = std::max(error, channels[channel]);
      this->SumOfSquares += channels[channel] * channels[channel];
    }
    if (this->Pixels.empty() || error > this->Errors.Maximum)
    {
      this->Errors.Maximum = error;
      this->Errors.WorstPixel = pixel;
    }
    this->Above1e4 += error > 1e-4;
    this->Above1Of255 += error > 1.0 / 255;
    this->Pixels.push_back(error);
  }

  ImageErrors Finish()
  {
    const std::size_t count = this->Pixels.size();
    this->Errors.NumberOfPixels = count;
    if (count > 0)
    {
      this->Errors.RootMeanSquare = std::sqrt(this->SumOfSquares / (4.0 * count));
      this->Errors.ShareAbove1e4 = static_cast<double>(this->Above1e4) / count;
      this->Errors.ShareAbove1Of255 = static_cast<double>(this->Above1Of255) / count;
      const auto quantile = this->Pixels.begin() + (count - 1 - count / 1000);
      std::nth_element(this->Pixels.begin(), quantile, this->Pixels.end());
      this->Errors.Quantile999 = *quantile;
    }
    return this->Errors;
  }

private:
  ImageErrors Errors;
  double SumOfSquares = 0;
  std::size_t Above1e4 = 0;
  std::size_t Above1Of255 = 0;
  std::vector<double> Pixels;
};

void Print(std::ostream& stream, const char* name, const ImageErrors& errors)
{
  stream << name << " pixels: " << errors.NumberOfPixels << ", maximum error " << errors.Maximum
         << " at pixel " << errors.WorstPixel << ", RMS " << errors.RootMeanSquare
         << ", 99.9 % quantile " << errors.Quantile999
         << ", above 1e-4: " << 100 * errors.ShareAbove1e4
         << " %, above 1/255: " << 100 * errors.ShareAbove1Of255 << " %\n";
}

} // namespace

ImageComparison CompareWithReference(Span<const float> rgba, Span<const double> reference,
  Span<const double> grazing, double grazingThreshold)
{
  if (rgba.size() != reference.size() || rgba.size() % 4 != 0 ||
    (!grazing.empty() && 4 * grazing.size() != rgba.size()))
  {
    throw std::invalid_argument("CompareWithReference: the pictures differ in size");
  }
  ErrorCollector covered;
  ErrorCollector ungrazed;
  for (std::size_t pixel = 0; pixel < rgba.size() / 4; ++pixel)
  {
    double differences[4];
    bool finite = true;
    for (std::size_t channel = 0; channel < 4; ++channel)
    {
      const float value = rgba[4 * pixel + channel];
      finite = finite && std::isfinite(value);
      differences[channel] = std::isfinite(value) ? std::abs(value - reference[4 * pixel + channel])
                                                  : std::numeric_limits<double>::infinity();
    }
    if (finite && rgba[4 * pixel + 3] == 0 && reference[4 * pixel + 3] == 0 &&
      *std::max_element(differences, differences + 3) == 0)
    {
      continue;
    }
    covered.Add(pixel, differences);
    if (grazing.empty() || !(grazing[pixel] > grazingThreshold))
    {
      ungrazed.Add(pixel, differences);
    }
  }
  return { covered.Finish(), ungrazed.Finish() };
}

std::ostream& operator<<(std::ostream& stream, const ImageComparison& comparison)
{
  Print(stream, "covered", comparison.Covered);
  Print(stream, "ungrazed", comparison.Ungrazed);
  return stream;
}

} // namespace tetralux
