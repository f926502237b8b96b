// SPDX-License-Identifier: BSD-3-Clause
#include "TestedWindow.h"

#include "vtkActor.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSphereSource.h"

#include <cstdlib>

vtkSmartPointer<vtkRenderWindow> MakeTestedWindow(ImageTester* tester)
{
  if (tester->IsFlagSpecified("--window") || tester->IsInteractiveModeSpecified())
  {
    return vtkSmartPointer<vtkRenderWindow>::New();
  }
  return vtkSmartPointer<vtkHeadlessRenderWindow>::New();
}

void ShowRenderer(vtkRenderWindow* window, vtkRenderer* renderer)
{
  renderer->SetBackground(0.32, 0.34, 0.43);
  window->SetMultiSamples(0);
  window->SetSize(200, 200);
  window->AddRenderer(renderer);
}

void AddSphere(vtkRenderer* renderer, double x, double y, double z, double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(x, y, z);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(48);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

int TestWindow(ImageTester* tester, vtkRenderWindow* window, double threshold)
{
  if (tester->IsInteractiveModeSpecified())
  {
    vtkNew<vtkRenderWindowInteractor> interactor;
    interactor->SetRenderWindow(window);
    interactor->Start();
    return EXIT_SUCCESS;
  }
  tester->SetRenderWindow(window);
  return tester->RegressionTest(threshold) == vtkTesting::PASSED ? EXIT_SUCCESS : EXIT_FAILURE;
}
