// SPDX-License-Identifier: BSD-3-Clause
// An image test as VTK has them: image_test --mapper vtk|ray-cast|gpu-ray-cast|projection
//   [--headless] -T OUTPUT_FOLDER -B BASELINE_FOLDER -V BASELINE.png
// The same scene with VTK's own mapper and with each of Tetralux; all match the same baseline.
#include "vtkHeadlessRenderWindow.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkCamera.h"
#include "vtkCellType.h"
#include "vtkCellTypeSource.h"
#include "vtkColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGridVolumeRayCastMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <iostream>
#include <string>

namespace
{

vtkSmartPointer<vtkUnstructuredGridVolumeMapper> MakeMapper(const std::string& name)
{
  if (name == "vtk")
  {
    // It draws with fewer rays where frames take long; Tetralux does so too.
    auto mapper = vtkSmartPointer<vtkUnstructuredGridVolumeRayCastMapper>::New();
    mapper->AutoAdjustSampleDistancesOff();
    return mapper;
  }
  if (name == "ray-cast")
  {
    auto mapper = vtkSmartPointer<vtkTetrahedraRayCastMapper>::New();
    mapper->AutoAdjustSampleDistancesOff();
    return mapper;
  }
  if (name == "gpu-ray-cast")
  {
    return vtkSmartPointer<vtkTetrahedraGPURayCastMapper>::New();
  }
  if (name == "projection")
  {
    return vtkSmartPointer<vtkTetrahedraProjectionMapper>::New();
  }
  return nullptr;
}

} // namespace

int main(int argc, char* argv[])
{
  vtkSmartPointer<vtkUnstructuredGridVolumeMapper> mapper;
  bool headless = false;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    headless = headless || argument == "--headless";
    if (argument == "--mapper" && i + 1 < argc)
    {
      mapper = MakeMapper(argv[i + 1]);
    }
  }
  if (!mapper)
  {
    std::cerr << "--mapper is vtk, ray-cast, gpu-ray-cast or projection\n";
    return 2;
  }

  // A cube of 8 units; its point array is the distance to the centre, 0 to 7.
  vtkNew<vtkCellTypeSource> source;
  source->SetCellType(VTK_TETRA);
  source->SetBlocksDimensions(8, 8, 8);
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
  renderer->GetActiveCamera()->SetPosition(3, 2, 5);
  renderer->SetBackground(0.32, 0.34, 0.43);
  renderer->ResetCamera();
  // Out of the mesh's symmetry: VTK's mapper loses rays that run along faces of cells.
  renderer->GetActiveCamera()->Roll(10);
  renderer->GetActiveCamera()->Yaw(1);
  vtkSmartPointer<vtkRenderWindow> window = headless
    ? vtkSmartPointer<vtkRenderWindow>(vtkSmartPointer<vtkHeadlessRenderWindow>::New())
    : vtkSmartPointer<vtkRenderWindow>::New();
  window->SetMultiSamples(0);
  window->SetSize(200, 200);
  window->AddRenderer(renderer);

  const int result = vtkRegressionTestImage(window);
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    vtkNew<vtkRenderWindowInteractor> interactor;
    interactor->SetRenderWindow(window);
    interactor->Start();
  }
  return result == vtkRegressionTester::FAILED ? 1 : 0;
}
