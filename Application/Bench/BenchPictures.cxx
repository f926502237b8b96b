// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchPictures.h"

#include "vtkBase64Utilities.h"
#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace
{

/// Grey levels of a small difference picture: few enough to take few bytes.
constexpr int SmallLevels = 16;

unsigned char ToByte(double value)
{
  return static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

vtkSmartPointer<vtkImageData> MakeImage(const BenchPicture& picture, int components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(picture.Width, picture.Height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  return image;
}

/// shrinker: takes the mean or the maximum.
vtkSmartPointer<vtkImageData> Shrink(vtkImageShrink3D* shrinker, vtkImageData* image, int size)
{
  const int* dimensions = image->GetDimensions();
  const int factor = (std::max(dimensions[0], dimensions[1]) + size - 1) / size;
  shrinker->SetInputData(image);
  shrinker->SetShrinkFactors(factor, factor, 1);
  shrinker->Update();
  return shrinker->GetOutput();
}

} // namespace

tetralux::ImageErrors MeasureErrors(const BenchPicture& picture, const BenchPicture& reference)
{
  const std::vector<double> expected(reference.Rgba.begin(), reference.Rgba.end());
  return tetralux::CompareWithReference(picture.Rgba, expected).Covered;
}

vtkSmartPointer<vtkImageData> MakeImage(const BenchPicture& picture)
{
  vtkSmartPointer<vtkImageData> image = MakeImage(picture, 3);
  auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  for (std::size_t i = 0; i < picture.Rgba.size(); ++i)
  {
    if (i % 4 < 3)
    {
      *pixels++ = ToByte(picture.Rgba[i]);
    }
  }
  return image;
}

vtkSmartPointer<vtkImageData> MakeDifferenceImage(
  const BenchPicture& picture, const BenchPicture& reference, double amplification)
{
  vtkSmartPointer<vtkImageData> image = MakeImage(picture, 1);
  auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  for (std::size_t pixel = 0; pixel < picture.Rgba.size() / 4; ++pixel)
  {
    double error = 0;
    for (std::size_t i = 4 * pixel; i < 4 * pixel + 4; ++i)
    {
      error = std::max<double>(error, std::abs(picture.Rgba[i] - reference.Rgba[i]));
    }
    pixels[pixel] = ToByte(amplification * error);
  }
  return image;
}

double ChooseAmplification(const tetralux::ImageErrors& errors)
{
  if (!(errors.Quantile999 > 0))
  {
    return 1;
  }
  return std::max(1.0, std::pow(10, std::floor(-std::log10(errors.Quantile999))));
}

vtkSmartPointer<vtkImageData> ShrinkToMean(vtkImageData* image, int size)
{
  vtkNew<vtkImageShrink3D> shrinker;
  shrinker->MeanOn();
  return Shrink(shrinker, image, size);
}

vtkSmartPointer<vtkImageData> ShrinkToMaximum(vtkImageData* image, int size)
{
  vtkNew<vtkImageShrink3D> shrinker;
  shrinker->MaximumOn();
  vtkSmartPointer<vtkImageData> small = Shrink(shrinker, image, size);
  auto* pixels = static_cast<unsigned char*>(small->GetScalarPointer());
  constexpr int step = 255 / (SmallLevels - 1);
  std::transform(pixels, pixels + small->GetNumberOfPoints(), pixels,
    [](int value) { return static_cast<unsigned char>((value + step - 1) / step * step); });
  return small;
}

std::string MakePngUri(vtkImageData* image)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetCompressionLevel(9);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  const auto size = static_cast<unsigned long>(bytes->GetNumberOfValues());
  std::vector<unsigned char> text(2 * size + 4); // four letters for three bytes
  text.resize(vtkBase64Utilities::Encode(bytes->GetPointer(0), size, text.data(), 0));
  return "data:image/png;base64," + std::string(text.begin(), text.end());
}
