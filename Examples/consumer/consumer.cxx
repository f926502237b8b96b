// SPDX-License-Identifier: BSD-3-Clause
// Renders a sphere without a display: consumer OUTPUT.png
#include "vtkHeadlessRenderWindow.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkWindowToImageFilter.h"

#include <iostream>

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: consumer OUTPUT.png\n";
    return 2;
  }

  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);

  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
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
