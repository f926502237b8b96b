// SPDX-License-Identifier: BSD-3-Clause
// Image data by the triangle caster, with opaque spheres in front of, inside and behind them:
// [--window], and vtkTesting's command line. Without --window or -I, the window needs no display.
#include "TestedWindow.h"

#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleCasterMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <cmath>

namespace
{

// In whole pixels, see ImageTester. As for the processor's mapper of cells: OpenGL draws only the
// spheres, whose rims may fall on other pixels.
constexpr double Threshold = 1;

/// A ball of waves, in voxels that are longer than wide.
vtkSmartPointer<vtkImageData> MakeImage()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(41, 41, 21);
  image->SetOrigin(-1, -1, -1);
  image->SetSpacing(0.05, 0.05, 0.1);
  vtkNew<vtkFloatArray> values;
  values->SetName("Waves");
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    double x[3];
    image->GetPoint(point, x);
    const double waves = std::sin(5 * x[0] + 1) * std::sin(4 * x[1]) * std::sin(3 * x[2] - 1);
    values->InsertNextValue(static_cast<float>(1.1 - std::hypot(x[0], x[1], x[2]) + 0.4 * waves));
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

vtkSmartPointer<vtkVolume> MakeVolume(vtkVolumeMapper* mapper)
{
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0.2, 0.1, 0.2, 0.9);
  color->AddRGBPoint(0.5, 0.2, 0.8, 0.6);
  color->AddRGBPoint(0.8, 1, 0.9, 0.2);
  color->AddRGBPoint(1.2, 0.9, 0.1, 0);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.2, 0);
  opacity->AddPoint(0.3, 0.3);
  opacity->AddPoint(0.5, 0.02);
  opacity->AddPoint(0.9, 0.1);
  opacity->AddPoint(1.1, 0.95);
  auto volume = vtkSmartPointer<vtkVolume>::New();
  volume->SetMapper(mapper);
  volume->GetProperty()->SetColor(color);
  volume->GetProperty()->SetScalarOpacity(opacity);
  volume->GetProperty()->SetScalarOpacityUnitDistance(0.2);
  return volume;
}

} // namespace

int TestImageData(int argc, char* argv[])
{
  vtkNew<ImageTester> tester;
  tester->AddArguments(argc, argv);
  const vtkSmartPointer<vtkRenderWindow> window = MakeTestedWindow(tester);
  vtkNew<vtkTriangleCasterMapper> mapper;
  mapper->SetInputData(MakeImage());
  mapper->AutoAdjustSampleDistancesOff(); // pictures do not depend on how fast the machine is
  vtkNew<vtkRenderer> renderer;
  renderer->AddVolume(MakeVolume(mapper));
  AddSphere(renderer, 0.25, -1.5, 0.5, 0.15); // in front
  AddSphere(renderer, 0.6, -0.2, 0.1, 0.3);   // half inside
  AddSphere(renderer, -0.9, 0.8, -0.6, 0.4);  // behind
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(2.1, -3.1, 2);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetViewUp(0, 0, 1);
  camera->SetClippingRange(0.1, 20);
  ShowRenderer(window, renderer);
  return TestWindow(tester, window, Threshold);
}
