// SPDX-License-Identifier: BSD-3-Clause
#include "AnyMapperScene.h"

#include "Statistics.h"

#include "vtkCamera.h"
#include "vtkContourValues.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTetrahedraVolumeMapper.h"
#include "vtkTriangleCasterMapper.h"
#include "vtkWindowToImageFilter.h"

#include <cmath>
#include <stdexcept>

const std::vector<std::string>& GetMapperClasses()
{
  static const std::vector<std::string> classes = { "vtkTetrahedraRayCastMapper",
    "vtkTetrahedraGPURayCastMapper", "vtkTetrahedraProjectionMapper",
    "vtkTetrahedraIsosurfaceMapper", "vtkTriangleCasterMapper" };
  return classes;
}

vtkSmartPointer<vtkAbstractVolumeMapper> MakeMapper(const std::string& className)
{
  if (className == "vtkTetrahedraRayCastMapper")
  {
    return vtkSmartPointer<vtkTetrahedraRayCastMapper>::New();
  }
  if (className == "vtkTetrahedraGPURayCastMapper")
  {
    return vtkSmartPointer<vtkTetrahedraGPURayCastMapper>::New();
  }
  if (className == "vtkTetrahedraProjectionMapper")
  {
    return vtkSmartPointer<vtkTetrahedraProjectionMapper>::New();
  }
  if (className == "vtkTetrahedraIsosurfaceMapper")
  {
    return vtkSmartPointer<vtkTetrahedraIsosurfaceMapper>::New();
  }
  if (className == "vtkTriangleCasterMapper")
  {
    return vtkSmartPointer<vtkTriangleCasterMapper>::New();
  }
  throw std::invalid_argument(className + " is no mapper");
}

vtkImageData* GetOutputImage(vtkAbstractVolumeMapper* mapper)
{
  auto* ofCells = vtkTetrahedraVolumeMapper::SafeDownCast(mapper);
  return ofCells ? ofCells->GetOutputImage()
                 : vtkTriangleCasterMapper::SafeDownCast(mapper)->GetOutputImage();
}

std::string GetStatistics(vtkAbstractVolumeMapper* mapper)
{
  auto* ofCells = vtkTetrahedraVolumeMapper::SafeDownCast(mapper);
  return ofCells ? ofCells->GetStatistics()
                 : vtkTriangleCasterMapper::SafeDownCast(mapper)->GetStatistics();
}

vtkSmartPointer<vtkImageData> MakeField()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(6, 5, 4);
  vtkNew<vtkFloatArray> scalars;
  scalars->SetName("field");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const double* x = image->GetPoint(id);
    scalars->InsertNextValue(static_cast<float>(std::sin(x[0]) * std::cos(1.3 * x[1] + x[2])));
  }
  image->GetPointData()->SetScalars(scalars);
  return image;
}

AnyMapperScene::AnyMapperScene(vtkAbstractVolumeMapper* mapper, int width, int height)
{
  this->Color->AddRGBPoint(-1, 0.1, 0.2, 0.9);
  this->Color->AddRGBPoint(0, 0.2, 0.9, 0.5);
  this->Color->AddRGBPoint(1, 1, 0.2, 0);
  this->Opacity->AddPoint(-1, 0.1);
  this->Opacity->AddPoint(1, 0.6);
  this->Volume->GetProperty()->SetColor(this->Color);
  this->Volume->GetProperty()->SetScalarOpacity(this->Opacity);
  this->Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 0.2);
  this->Renderer->AddVolume(this->Volume);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  if (!mapper->GetDataObjectInput())
  {
    mapper->SetInputDataObject(MakeField());
  }
  this->Use(mapper);
  this->Renderer->GetActiveCamera()->Azimuth(30);
  this->Renderer->GetActiveCamera()->Elevation(20);
  this->Renderer->ResetCamera();
}

void AnyMapperScene::Use(vtkAbstractVolumeMapper* mapper)
{
  this->Mapper = mapper;
  this->Volume->SetMapper(mapper);
}

std::vector<float> AnyMapperScene::Render()
{
  this->Window->Render();
  return GetPicture(this->Mapper);
}

std::vector<float> GetPicture(vtkAbstractVolumeMapper* mapper)
{
  std::vector<float> picture;
  vtkPointData* pointData = GetOutputImage(mapper)->GetPointData();
  for (const char* name : { "RGBA", "Depth" })
  {
    if (auto* array = vtkFloatArray::SafeDownCast(pointData->GetArray(name)))
    {
      picture.insert(
        picture.end(), array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
    }
  }
  return picture;
}

std::vector<int> AnyMapperScene::Grab()
{
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(this->Window);
  grab->ShouldRerenderOff();
  grab->ReadFrontBufferOff();
  grab->Update();
  const auto* bytes = static_cast<const unsigned char*>(grab->GetOutput()->GetScalarPointer());
  return { bytes, bytes + 3 * grab->GetOutput()->GetNumberOfPoints() };
}

std::string AnyMapperScene::Get(const std::string& name) const
{
  return GetStatistic(GetStatistics(this->Mapper), name);
}

std::string NameAnyMapperTest(const testing::TestParamInfo<std::string>& info)
{
  return info.param.substr(3); // behind "vtk"
}
