// SPDX-License-Identifier: BSD-3-Clause
#include "BaselineImage.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkRenderWindow.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

namespace tetralux
{
namespace
{

std::string WriteOutput(vtkImageData* image, const std::string& name)
{
  const std::string path = std::string(TETRALUX_OUTPUT_DIRECTORY) + "/" + name + ".png";
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->Write();
  return path;
}

struct Comparison
{
  vtkNew<vtkImageData> Difference; ///< absolute, for each channel
  vtkIdType UnequalPixels = 0;
  int LargestDifference = 0;
};

// Both images have three channels of unsigned char and the same dimensions.
void Compare(vtkImageData* image, vtkImageData* baseline, int channelTolerance, Comparison& result)
{
  result.Difference->CopyStructure(image);
  result.Difference->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* a = static_cast<const unsigned char*>(image->GetScalarPointer());
  const auto* b = static_cast<const unsigned char*>(baseline->GetScalarPointer());
  auto* difference = static_cast<unsigned char*>(result.Difference->GetScalarPointer());
  for (vtkIdType pixel = 0; pixel < image->GetNumberOfPoints(); ++pixel)
  {
    int largest = 0;
    for (vtkIdType i = 3 * pixel; i < 3 * pixel + 3; ++i)
    {
      difference[i] = static_cast<unsigned char>(std::abs(a[i] - b[i]));
      largest = std::max<int>(largest, difference[i]);
    }
    result.LargestDifference = std::max(result.LargestDifference, largest);
    result.UnequalPixels += largest > channelTolerance ? 1 : 0;
  }
}

} // namespace

testing::AssertionResult MatchesBaseline(
  vtkRenderWindow* window, const std::string& name, ImageTolerance tolerance)
{
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->Update();
  vtkImageData* image = grab->GetOutput();

  const std::string baselinePath = std::string(TETRALUX_BASELINE_DIRECTORY) + "/" + name + ".png";
  if (!std::ifstream(baselinePath))
  {
    return testing::AssertionFailure()
      << "no baseline " << baselinePath << "; the picture is " << WriteOutput(image, name);
  }
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(baselinePath.c_str());
  reader->Update();
  vtkImageData* baseline = reader->GetOutput();

  std::array<int, 3> size{};
  std::array<int, 3> baselineSize{};
  image->GetDimensions(size.data());
  baseline->GetDimensions(baselineSize.data());
  if (size != baselineSize || baseline->GetNumberOfScalarComponents() != 3 ||
    baseline->GetScalarType() != VTK_UNSIGNED_CHAR)
  {
    return testing::AssertionFailure()
      << baselinePath << " is no RGB picture of " << size[0] << " x " << size[1]
      << " pixels; the picture is " << WriteOutput(image, name);
  }

  Comparison comparison;
  Compare(image, baseline, tolerance.Channel, comparison);
  if (comparison.UnequalPixels > tolerance.Pixels)
  {
    return testing::AssertionFailure()
      << comparison.UnequalPixels << " pixels differ from " << baselinePath << " by more than "
      << tolerance.Channel << " of 255, " << tolerance.Pixels << " may; the largest difference is "
      << comparison.LargestDifference << "; the picture is " << WriteOutput(image, name)
      << ", the difference is " << WriteOutput(comparison.Difference, name + "-difference");
  }
  return testing::AssertionSuccess()
    << comparison.UnequalPixels << " pixels differ by more than " << tolerance.Channel
    << " of 255, the largest difference is " << comparison.LargestDifference;
}

} // namespace tetralux
