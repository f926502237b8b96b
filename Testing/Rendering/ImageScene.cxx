// SPDX-License-Identifier: BSD-3-Clause
#include "ImageScene.h"

#include "Statistics.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkOpenGLGPUVolumeRayCastMapper.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

vtkSmartPointer<vtkImageData> MakeImage(int type)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(ImageSize.data());
  const auto values = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  values->SetName("Field");
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    const double* x = image->GetPoint(p);
    const double wave =
      std::sin(0.5 * x[0]) + std::sin(0.6 * x[1] + 1) + std::cos(0.7 * x[2] + 0.1 * x[0]);
    values->SetTuple1(p, std::round(50 + 50. / 3 * wave));
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

vtkSmartPointer<vtkImageData> MakeConstantImage(double value)
{
  vtkSmartPointer<vtkImageData> image = MakeImage();
  vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars())->FillValue(value);
  return image;
}

ImageScene::ImageScene(int width, int height)
{
  this->Mapper->SetInputData(MakeImage());
  // Pictures do not depend on how fast the machine is.
  this->Mapper->AutoAdjustSampleDistancesOff();
  this->Mapper->SetSampleDistance(0.5);
  this->Volume->SetMapper(this->Mapper);
  this->Color->AddRGBPoint(0, 0.1, 0.2, 0.9);
  this->Color->AddRGBPoint(40, 0.2, 0.9, 0.5);
  this->Color->AddRGBPoint(100, 1, 0.2, 0);
  this->Opacity->AddPoint(30, 0);
  this->Opacity->AddPoint(60, 0.3);
  this->Opacity->AddPoint(100, 0.6);
  vtkVolumeProperty* property = this->Volume->GetProperty();
  property->SetColor(this->Color);
  property->SetScalarOpacity(this->Opacity);
  property->SetScalarOpacityUnitDistance(2);
  property->SetInterpolationTypeToLinear();
  this->Renderer->AddVolume(this->Volume);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(24, 20, 32);
  camera->SetFocalPoint(6.5, 5, 4);
  camera->SetViewUp(0.1, 1, 0);
  camera->SetClippingRange(5, 70);
}

std::vector<float> ImageScene::Render()
{
  this->Window->Render();
  auto* colors =
    vtkFloatArray::SafeDownCast(this->Mapper->GetOutputImage()->GetPointData()->GetArray("RGBA"));
  return colors
    ? std::vector<float>(colors->GetPointer(0), colors->GetPointer(0) + colors->GetNumberOfValues())
    : std::vector<float>();
}

std::vector<float> ImageScene::GetDepths()
{
  auto* depths =
    vtkFloatArray::SafeDownCast(this->Mapper->GetOutputImage()->GetPointData()->GetArray("Depth"));
  return { depths->GetPointer(0), depths->GetPointer(0) + depths->GetNumberOfValues() };
}

std::vector<int> ImageScene::Grab()
{
  const int* size = this->Window->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels, 0);
  return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
}

std::string ImageScene::Get(const std::string& name)
{
  return GetStatistic(this->Mapper->GetStatistics(), name);
}

void ImageScene::AddSphere(double x, double y, double z, double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(x, y, z);
  sphere->SetRadius(radius);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Renderer->AddActor(actor);
}

std::vector<int> GrabOfVTK(ImageScene& scene)
{
  vtkNew<vtkOpenGLGPUVolumeRayCastMapper> other;
  other->SetInputDataObject(scene.Mapper->GetDataObjectInput());
  other->AutoAdjustSampleDistancesOff();
  other->SetSampleDistance(static_cast<float>(scene.Mapper->GetSampleDistance()));
  other->SetBlendMode(scene.Mapper->GetBlendMode());
  other->SetAverageIPScalarRange(scene.Mapper->GetAverageIPScalarRange());
  scene.Volume->SetMapper(other);
  scene.Window->Render();
  std::vector<int> picture = scene.Grab();
  scene.Volume->SetMapper(scene.Mapper);
  return picture;
}

double FindShareAbove(
  const std::vector<int>& picture, const std::vector<int>& expected, int tolerance)
{
  EXPECT_EQ(picture.size(), expected.size());
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 100);
  double count = 0;
  for (std::size_t i = 0; i < std::min(picture.size(), expected.size()); ++i)
  {
    count += std::abs(picture[i] - expected[i]) > tolerance ? 1 : 0;
  }
  return count / static_cast<double>(picture.size());
}

double FindDifference(const std::vector<float>& picture, const std::vector<float>& expected)
{
  EXPECT_EQ(picture.size(), expected.size());
  double largest = 0;
  double covered = 0;
  for (std::size_t i = 0; i < std::min(picture.size(), expected.size()); ++i)
  {
    largest = std::max(largest, std::abs(static_cast<double>(picture[i]) - expected[i]));
    covered = std::max<double>(covered, expected[i]);
  }
  EXPECT_GT(covered, 0.2);
  return largest;
}
