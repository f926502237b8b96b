// SPDX-License-Identifier: BSD-3-Clause
// Renders a grid of wedges as a volume, without a display: consumer OUTPUT.png
#include "vtkHeadlessRenderWindow.h"
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkCellType.h"
#include "vtkCellTypeSource.h"
#include "vtkColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkWindowToImageFilter.h"

#include <iostream>

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: consumer OUTPUT.png\n";
    return 2;
  }

  // A cube of 8 units; its point array is the distance to the centre, 0 to 7.
  vtkNew<vtkCellTypeSource> source;
  source->SetCellType(VTK_WEDGE);
  source->SetBlocksDimensions(8, 8, 8);

  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectScalarArray("DistanceToCenter");

  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0, 1.0, 0.9, 0.3);
  color->AddRGBPoint(4, 0.9, 0.2, 0.1);
  color->AddRGBPoint(7, 0.2, 0.4, 1.0);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0, 1.0);
  opacity->AddPoint(4, 0.2);
  opacity->AddPoint(7, 0.0);

  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->SetColor(color);
  volume->GetProperty()->SetScalarOpacity(opacity);

  vtkNew<vtkRenderer> renderer;
  renderer->AddVolume(volume);
  vtkNew<vtkHeadlessRenderWindow> window;
  window->SetSize(400, 300);
  window->AddRenderer(renderer);
  if (!window->SupportsOpenGL())
  {
    return 1;
  }
  window->Render();

  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(argv[1]);
  writer->Write();
  return writer->GetErrorCode() == 0 ? 0 : 1;
}
