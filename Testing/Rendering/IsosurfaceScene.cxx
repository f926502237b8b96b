// SPDX-License-Identifier: BSD-3-Clause
#include "IsosurfaceScene.h"

#include "Statistics.h"

#include "vtkActor.h"
#include "vtkContourValues.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"

#include <algorithm>

namespace
{

/// Of a channel: what no screen shows.
constexpr double Invisible = 1. / 255;

} // namespace

IsosurfaceScene::IsosurfaceScene(int width, int height)
  : RayCastScene(width, height)
{
  this->Tracer->AutoAdjustSampleDistancesOff();
  this->Use(this->Tracer);
  this->SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 }, 1, 6);
  this->SetSurfaces({ { -0.4, 0.5 }, { 0.3, 1 } });
}

void IsosurfaceScene::SetSurfaces(const std::map<double, double>& surfaces)
{
  this->Opacity->RemoveAllPoints();
  vtkContourValues* values = this->Volume->GetProperty()->GetIsoSurfaceValues();
  values->SetNumberOfContours(static_cast<int>(surfaces.size()));
  int index = 0;
  for (const auto& [value, opacity] : surfaces)
  {
    this->Opacity->AddPoint(value, opacity);
    values->SetValue(index++, value);
  }
}

void IsosurfaceScene::Show(const tetralux::GeneratedMesh& mesh)
{
  const auto [least, largest] = std::minmax_element(mesh.Scalars.begin(), mesh.Scalars.end());
  const auto at = [lo = *least, hi = *largest](double share) { return lo + share * (hi - lo); };
  this->Grid = MakeGrid(mesh.Mesh, mesh.Scalars);
  this->Use(this->Tracer);
  this->SetSurfaces({ { at(0.25), 0.3 }, { at(0.5), 0.6 }, { at(0.75), 1 } });
  this->Color->RemoveAllPoints();
  this->Color->AddRGBPoint(at(0), 0.1, 0.3, 1);
  this->Color->AddRGBPoint(at(1), 1, 0.8, 0.1);
  this->Renderer->ResetCamera();
}

std::vector<float> IsosurfaceScene::Render()
{
  this->Window->Render();
  const vtkIdType size = 4 * this->GetMapper()->GetOutputImage()->GetNumberOfPoints();
  return size == 0 ? std::vector<float>()
                   : std::vector<float>(this->GetColors(), this->GetColors() + size);
}

std::vector<float> IsosurfaceScene::RenderByRays()
{
  this->Use(this->Mapper);
  this->Mapper->SetBlendModeToIsoSurface();
  this->Mapper->SetSmoothShading(this->Tracer->GetSmoothShading());
  this->Mapper->SetClippingPlanes(this->Tracer->GetClippingPlanes());
  this->Mapper->SetCropping(this->Tracer->GetCropping());
  this->Mapper->SetCroppingRegionPlanes(this->Tracer->GetCroppingRegionPlanes());
  this->Mapper->SetCroppingRegionFlags(this->Tracer->GetCroppingRegionFlags());
  std::vector<float> colors = this->Render();
  this->Use(this->Tracer);
  return colors;
}

void IsosurfaceScene::ExpectPictureOfRays(const std::string& name)
{
  ExpectSamePicture(this->Render(), this->RenderByRays(), Invisible, name.c_str());
}

void IsosurfaceScene::AddSphere(const Vector& center, double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(center[0], center[1], center[2]);
  sphere->SetRadius(radius);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Renderer->AddActor(actor);
}

void IsosurfaceScene::SetLight(const Vector& position)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(position[0], position[1], position[2]);
  light->SetFocalPoint(0.5, 0.5, 0.5);
  this->Renderer->RemoveAllLights();
  this->Renderer->AddLight(light);
  this->Volume->GetProperty()->ShadeOn();
}

void IsosurfaceScene::FindPoint(int i, int j, double depth, double (&x)[3])
{
  const int* origin = this->Renderer->GetOrigin();
  double point[4];
  this->Renderer->SetDisplayPoint(origin[0] + i + 0.5, origin[1] + j + 0.5, depth);
  this->Renderer->DisplayToWorld();
  this->Renderer->GetWorldPoint(point);
  for (int c = 0; c < 3; ++c)
  {
    x[c] = point[c] / point[3];
  }
}

bool IsosurfaceScene::FindWindowPoint(int i, int j, double (&x)[3])
{
  const int* origin = this->Renderer->GetOrigin();
  const double depth = this->Renderer->GetZ(origin[0] + i, origin[1] + j);
  this->FindPoint(i, j, depth, x);
  return depth < 1;
}

bool IsosurfaceScene::FindPicturePoint(int i, int j, double (&x)[3])
{
  const int width = this->Tracer->GetOutputImage()->GetDimensions()[0];
  const double distance = this->GetDepths()[width * j + i];
  double nearer[3], farther[3], direction[3], start[3];
  this->FindPoint(i, j, 0, nearer);
  this->FindPoint(i, j, 1, farther);
  vtkMath::Subtract(farther, nearer, direction);
  vtkMath::Normalize(direction);
  this->Renderer->GetActiveCamera()->GetPosition(start);
  if (this->Parallel)
  {
    // From the plane through the camera.
    double offset[3];
    vtkMath::Subtract(nearer, start, offset);
    const double along = vtkMath::Dot(offset, direction);
    for (int c = 0; c < 3; ++c)
    {
      start[c] = nearer[c] - along * direction[c];
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    x[c] = start[c] + distance * direction[c];
  }
  return distance >= 0;
}

std::int64_t IsosurfaceScene::CountWindowDepths()
{
  const int* size = this->Renderer->GetSize();
  std::int64_t count = 0;
  double x[3];
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      count += this->FindWindowPoint(i, j, x);
    }
  }
  return count;
}

std::string IsosurfaceScene::Get(const char* section, const char* name)
{
  return tetralux::Json::parse(this->Tracer->GetStatistics()).at(section).at(name).dump();
}

double FindLargestExcess(const std::vector<float>& a, const std::vector<float>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    largest = std::max(largest, static_cast<double>(a[i]) - b[i]);
  }
  return largest;
}

double Sum(const std::vector<float>& values)
{
  double sum = 0;
  for (const float value : values)
  {
    sum += value;
  }
  return sum;
}
