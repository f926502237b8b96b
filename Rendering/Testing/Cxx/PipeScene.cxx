// SPDX-License-Identifier: BSD-3-Clause
#include "PipeScene.h"

#include "TestGrid.h"
#include "TestedWindow.h"

#include "Generate/GeneratedMeshes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkContourValues.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkLight.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"

PipeScene::PipeScene(vtkRenderWindow* window, vtkTetrahedraVolumeMapper* mapper)
  : Window(window)
  , Mapper(mapper)
{
  const tetralux::GeneratedMesh pipe = tetralux::GenerateMesh(
    "cylinder-with-hole", { { "across", 4 }, { "around", 40 }, { "along", 16 }, { "hole", 0.5 } });
  this->Grid = MakeGrid(pipe.Mesh, MakeField(pipe.Mesh, { -1, -1, 0 }, 2));
  mapper->SetInputData(this->Grid);
  this->Color->AddRGBPoint(-0.9, 0.1, 0.2, 0.9);
  this->Color->AddRGBPoint(-0.1, 0.2, 0.8, 0.6);
  this->Color->AddRGBPoint(0.2, 1, 0.9, 0.2);
  this->Color->AddRGBPoint(0.8, 0.9, 0.1, 0);
  this->Opacity->AddPoint(-0.8, 0.4);
  this->Opacity->AddPoint(0, 0);
  this->Opacity->AddPoint(0.2, 0.02);
  this->Opacity->AddPoint(0.9, 0.9);
  this->Volume->SetMapper(mapper);
  this->Volume->GetProperty()->SetColor(this->Color);
  this->Volume->GetProperty()->SetScalarOpacity(this->Opacity);
  this->Volume->GetProperty()->SetScalarOpacityUnitDistance(0.3);
  this->Renderer->AddVolume(this->Volume);
  ShowRenderer(window, this->Renderer);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(2.5, -3.2, 4.4);
  camera->SetFocalPoint(0, 0, 0.9);
  camera->SetViewUp(0, 0, 1);
  camera->SetClippingRange(0.1, 20);
}

bool PipeScene::Vary(const std::string& name)
{
  vtkVolumeProperty* property = this->Volume->GetProperty();
  if (name == "Geometry")
  {
    AddSphere(this->Renderer, 1.3, -1.7, 2.2, 0.2);   // in front
    AddSphere(this->Renderer, -0.6, -0.47, 1.3, 0.4); // half inside of the wall
    AddSphere(this->Renderer, 0, 0, 1.8, 0.25);       // in the hole
    AddSphere(this->Renderer, -0.9, 1.9, 0.6, 0.45);  // behind
  }
  else if (name == "Parallel")
  {
    AddSphere(this->Renderer, -0.6, -0.47, 1.3, 0.4);
    this->Renderer->GetActiveCamera()->ParallelProjectionOn();
    this->Renderer->GetActiveCamera()->SetParallelScale(1.5);
  }
  else if (name == "Inside")
  {
    this->LookFromInside();
  }
  else if (name == "Viewports")
  {
    this->AddViewport();
  }
  else if (name == "ClippingCropping")
  {
    this->ClipAndCrop();
  }
  else if (name == "CellData")
  {
    this->UseCellData();
  }
  else if (name == "Hsv")
  {
    this->UseHsvColors();
  }
  else if (name == "Transform")
  {
    this->TransformVolume();
  }
  else if (name == "Maximum")
  {
    this->Mapper->SetBlendModeToMaximumIntensity();
  }
  else if (name == "Additive")
  {
    this->Mapper->SetBlendModeToAdditive();
    property->SetScalarOpacityUnitDistance(2);
  }
  else if (name == "Absorption")
  {
    this->Mapper->SetBlendModeToAbsorption();
    AddSphere(this->Renderer, 0, 0, 0.5, 0.4);
  }
  else if (name == "Isosurfaces")
  {
    this->ShowIsosurfaces();
  }
  else if (name == "Shadows")
  {
    this->CastShadows();
  }
  else if (name == "Lit")
  {
    property->ShadeOn();
    property->SetSpecularPower(30);
  }
  else
  {
    return name == "Volume";
  }
  return true;
}

void PipeScene::LookFromInside()
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0.7, -0.1, 0.4);
  camera->SetFocalPoint(0.1, 0.3, 1);
  camera->SetViewAngle(90);
  camera->SetClippingRange(0.001, 10);
}

// One mapper in both: the left one seen from above, and a background of its own.
void PipeScene::AddViewport()
{
  this->Renderer->SetViewport(0.4, 0.1, 1, 1);
  vtkNew<vtkRenderer> left;
  left->SetViewport(0, 0, 0.4, 0.7);
  left->SetBackground(0.1, 0.3, 0.1);
  left->AddVolume(this->Volume);
  left->GetActiveCamera()->SetPosition(0, 0, 8);
  left->GetActiveCamera()->SetClippingRange(0.1, 20);
  this->Window->AddRenderer(left);
}

void PipeScene::ClipAndCrop()
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, 1.6);
  plane->SetNormal(-0.3, 0, -1);
  this->Mapper->AddClippingPlane(plane);
  this->Mapper->CroppingOn();
  this->Mapper->SetCroppingRegionPlanes(-0.2, 2, -2, 0.2, 0.6, 3);
  this->Mapper->SetCroppingRegionFlags(0x7ffffff & ~0x2000); // all but the middle
}

void PipeScene::UseCellData()
{
  vtkDataArray* field = this->Grid->GetPointData()->GetScalars();
  vtkNew<vtkDoubleArray> means;
  means->SetName("Means");
  for (vtkIdType cell = 0; cell < this->Grid->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* points;
    this->Grid->GetCellPoints(cell, size, points);
    double sum = 0;
    for (vtkIdType i = 0; i < size; ++i)
    {
      sum += field->GetTuple1(points[i]);
    }
    means->InsertNextValue(sum / static_cast<double>(size));
  }
  this->Grid->GetCellData()->SetScalars(means);
  this->Mapper->SetScalarModeToUseCellData();
}

void PipeScene::UseHsvColors()
{
  this->Color->RemoveAllPoints();
  this->Color->AddRGBPoint(-0.9, 0, 0, 1);
  this->Color->AddRGBPoint(0.9, 1, 0, 0);
  this->Color->SetColorSpaceToHSV();
  this->Color->HSVWrapOff();
}

void PipeScene::TransformVolume()
{
  this->Volume->SetOrigin(0, 0, 1);
  this->Volume->SetOrientation(70, 0, 20);
  this->Volume->SetScale(1.3, 0.6, 0.8);
  // What VTK makes of the same transform: the far walls of the box around the pipe. Not its edges,
  // since each OpenGL draws lines over other pixels.
  vtkNew<vtkCubeSource> box;
  box->SetBounds(-1, 1, -1, 1, 0, 2);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(box->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->FrontfaceCullingOn();
  actor->SetUserMatrix(this->Volume->GetMatrix());
  this->Renderer->AddActor(actor);
}

void PipeScene::ShowIsosurfaces()
{
  this->Mapper->SetBlendModeToIsoSurface();
  this->Opacity->RemoveAllPoints();
  this->Opacity->AddPoint(-1, 0.3);
  this->Opacity->AddPoint(1, 1);
  vtkContourValues* values = this->Volume->GetProperty()->GetIsoSurfaceValues();
  values->SetValue(0, -0.5);
  values->SetValue(1, 0.1);
  values->SetValue(2, 0.6);
  this->Volume->GetProperty()->ShadeOn();
}

// Two opaque surfaces, cut open so that light falls in from the side.
void PipeScene::CastShadows()
{
  this->Mapper->SetBlendModeToIsoSurface();
  this->Opacity->RemoveAllPoints();
  this->Opacity->AddPoint(-1, 1);
  this->Opacity->AddPoint(1, 1);
  vtkContourValues* values = this->Volume->GetProperty()->GetIsoSurfaceValues();
  values->SetValue(0, -0.5);
  values->SetValue(1, 0.3);
  this->Volume->GetProperty()->ShadeOn();
  this->Volume->GetProperty()->SetAmbient(0.3);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, 1.7);
  plane->SetNormal(-0.3, 0.2, -1);
  this->Mapper->AddClippingPlane(plane);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(-3, -3, 5);
  light->SetFocalPoint(0, 0, 0.9);
  this->Renderer->AddLight(light);
}
