// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/PictureFile.h"

#include "CommandLine/OptionValues.h"
#include "Files/AtomicOutput.h"
#include "Files/WriteData.h"

#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>

namespace
{

/// Returns the picture over the background, rounded to 8 bit once. A window's frame buffer would
/// round before and after the background is added.
vtkSmartPointer<vtkImageData> PutOverBackground(
  vtkImageData* image, const SceneOptions::Vector& background)
{
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->SetDimensions(image->GetDimensions());
  result->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto colors = vtk::DataArrayTupleRange<4>(image->GetPointData()->GetArray("RGBA"));
  auto pixels = vtk::DataArrayTupleRange<3>(result->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < colors.size(); ++i)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      const double value = colors[i][channel] + (1 - colors[i][3]) * background[channel];
      pixels[i][channel] = std::lround(255 * std::clamp(value, 0.0, 1.0));
    }
  }
  return result;
}

/// Returns the picture as the window shows it.
vtkSmartPointer<vtkImageData> CaptureWindow(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> reader;
  reader->SetInput(window);
  reader->ShouldRerenderOff();
  reader->ReadFrontBufferOff();
  reader->SetInputBufferTypeToRGB();
  reader->Update();
  return reader->GetOutput();
}

} // namespace

void WritePicture(const AtomicOutput& output, vtkImageData* image, vtkRenderWindow* window,
  const SceneOptions::Vector& background)
{
  if (GetExtension(output.GetName()) == ".vti")
  {
    WriteXml(image, output.GetTemporaryName(), output.GetName());
    return;
  }
  const int* dimensions = image->GetDimensions();
  const int* pixels = window->GetSize();
  const bool oneRayPerPixel = dimensions[0] == pixels[0] && dimensions[1] == pixels[1];
  WritePng(oneRayPerPixel ? PutOverBackground(image, background) : CaptureWindow(window),
    output.GetTemporaryName(), output.GetName());
}
