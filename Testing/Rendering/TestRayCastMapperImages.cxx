// SPDX-License-Identifier: BSD-3-Clause
// Pictures as a user sees them, with what VTK draws around the volume.
#include "BaselineImage.h"
#include "RayCastScene.h"

#include "Generate/GeneratedMeshes.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkContourValues.h"
#include "vtkDoubleArray.h"
#include "vtkOutlineSource.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <cmath>
#include <string>

namespace
{

// Volumes may differ in the last bit of a channel with the processor's instruction set, rims of
// spheres and lines with the driver.
constexpr tetralux::ImageTolerance Tolerance{ 2, 60 };

// A pipe with a field on it: not convex, so that rays enter it twice.
class PipeScene
{
public:
  PipeScene()
  {
    const tetralux::GeneratedMesh pipe = tetralux::GenerateMesh("cylinder-with-hole",
      { { "across", 4 }, { "around", 40 }, { "along", 16 }, { "hole", 0.5 } });
    this->Grid = MakeGrid(pipe.Mesh, MakeField(pipe.Mesh, { -1, -1, 0 }, 2));
    this->Mapper->SetInputData(this->Grid);
    this->Mapper->AutoAdjustSampleDistancesOff();
    this->Color->AddRGBPoint(-0.9, 0.1, 0.2, 0.9);
    this->Color->AddRGBPoint(-0.1, 0.2, 0.8, 0.6);
    this->Color->AddRGBPoint(0.2, 1, 0.9, 0.2);
    this->Color->AddRGBPoint(0.8, 0.9, 0.1, 0);
    this->Opacity->AddPoint(-0.8, 0.4);
    this->Opacity->AddPoint(0, 0);
    this->Opacity->AddPoint(0.2, 0.02);
    this->Opacity->AddPoint(0.9, 0.9);
    this->Volume->SetMapper(this->Mapper);
    this->Volume->GetProperty()->SetColor(this->Color);
    this->Volume->GetProperty()->SetScalarOpacity(this->Opacity);
    this->Volume->GetProperty()->SetScalarOpacityUnitDistance(0.3);
    this->Renderer->AddVolume(this->Volume);
    this->Renderer->SetBackground(0.32, 0.34, 0.43);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(200, 200);
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(2.5, -3.2, 4.4);
    camera->SetFocalPoint(0, 0, 0.9);
    camera->SetViewUp(0, 0, 1);
    camera->SetClippingRange(0.1, 20);
  }

  void AddSphere(double x, double y, double z, double radius)
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
    this->Renderer->AddActor(actor);
  }

  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  vtkNew<vtkTetrahedraRayCastMapper> Mapper;
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkHeadlessRenderWindow> Window;
};

// The mapper on the graphics card makes the same pictures.
void UseGPU(PipeScene& scene)
{
  vtkNew<vtkTetrahedraGPURayCastMapper> mapper;
  mapper->SetInputData(scene.Grid);
  scene.Volume->SetMapper(mapper);
}

// So does the one that projects tetrahedra.
void UseProjection(PipeScene& scene)
{
  vtkNew<vtkTetrahedraProjectionMapper> mapper;
  mapper->SetInputData(scene.Grid);
  mapper->SetBlendMode(scene.Mapper->GetBlendMode());
  mapper->SetClippingPlanes(scene.Mapper->GetClippingPlanes());
  mapper->SetCropping(scene.Mapper->GetCropping());
  mapper->SetCroppingRegionPlanes(scene.Mapper->GetCroppingRegionPlanes());
  mapper->SetCroppingRegionFlags(scene.Mapper->GetCroppingRegionFlags());
  scene.Volume->SetMapper(mapper);
}

TEST(RayCastMapperImages, PerspectiveWithGeometry)
{
  PipeScene scene;
  scene.AddSphere(1.3, -1.7, 2.2, 0.2);   // in front
  scene.AddSphere(-0.6, -0.47, 1.3, 0.4); // half inside of the wall
  scene.AddSphere(0, 0, 1.8, 0.25);       // in the hole
  scene.AddSphere(-0.9, 1.9, 0.6, 0.45);  // behind
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastGeometry", Tolerance));
  UseGPU(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastGeometry", Tolerance));
  UseProjection(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastGeometry", Tolerance));
}

TEST(RayCastMapperImages, Parallel)
{
  PipeScene scene;
  scene.AddSphere(-0.6, -0.47, 1.3, 0.4);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.5);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastParallel", Tolerance));
}

TEST(RayCastMapperImages, CameraInside)
{
  PipeScene scene;
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(0.7, -0.1, 0.4);
  camera->SetFocalPoint(0.1, 0.3, 1);
  camera->SetViewAngle(90);
  camera->SetClippingRange(0.001, 10);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastInside", Tolerance));
  UseGPU(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastInside", Tolerance));
  UseProjection(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastInside", Tolerance));
}

// One mapper to each: the left one seen from above, and a background of its own.
TEST(RayCastMapperImages, TwoViewports)
{
  PipeScene scene;
  scene.Renderer->SetViewport(0.4, 0.1, 1, 1);
  vtkNew<vtkRenderer> left;
  left->SetViewport(0, 0, 0.4, 0.7);
  left->SetBackground(0.1, 0.3, 0.1);
  left->AddVolume(scene.Volume);
  left->GetActiveCamera()->SetPosition(0, 0, 8);
  left->GetActiveCamera()->SetClippingRange(0.1, 20);
  scene.Window->AddRenderer(left);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastViewports", Tolerance));
  UseProjection(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastViewports", Tolerance));
}

TEST(RayCastMapperImages, ClippingAndCropping)
{
  PipeScene scene;
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, 1.6);
  plane->SetNormal(-0.3, 0, -1);
  scene.Mapper->AddClippingPlane(plane);
  scene.Mapper->CroppingOn();
  scene.Mapper->SetCroppingRegionPlanes(-0.2, 2, -2, 0.2, 0.6, 3);
  scene.Mapper->SetCroppingRegionFlags(0x7ffffff & ~0x2000); // all but the middle
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastClippingCropping", Tolerance));
  UseProjection(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastClippingCropping", Tolerance));
}

TEST(RayCastMapperImages, CellData)
{
  PipeScene scene;
  vtkDataArray* field = scene.Grid->GetPointData()->GetScalars();
  vtkNew<vtkDoubleArray> means;
  means->SetName("Means");
  for (vtkIdType cell = 0; cell < scene.Grid->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* points;
    scene.Grid->GetCellPoints(cell, size, points);
    double sum = 0;
    for (vtkIdType i = 0; i < size; ++i)
    {
      sum += field->GetTuple1(points[i]);
    }
    means->InsertNextValue(sum / static_cast<double>(size));
  }
  scene.Grid->GetCellData()->SetScalars(means);
  scene.Mapper->SetScalarModeToUseCellData();
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastCellData", Tolerance));
}

TEST(RayCastMapperImages, HsvColors)
{
  PipeScene scene;
  scene.Color->RemoveAllPoints();
  scene.Color->AddRGBPoint(-0.9, 0, 0, 1);
  scene.Color->AddRGBPoint(0.9, 1, 0, 0);
  scene.Color->SetColorSpaceToHSV();
  scene.Color->HSVWrapOff();
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastHsv", Tolerance));
}

TEST(RayCastMapperImages, Transform)
{
  PipeScene scene;
  scene.Volume->SetOrigin(0, 0, 1);
  scene.Volume->SetOrientation(70, 0, 20);
  scene.Volume->SetScale(1.3, 0.6, 0.8);
  // What VTK makes of the same transform.
  vtkNew<vtkOutlineSource> box;
  box->SetBounds(-1, 1, -1, 1, 0, 2);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(box->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetUserMatrix(scene.Volume->GetMatrix());
  scene.Renderer->AddActor(actor);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastTransform", Tolerance));
}

// Rays four pixels apart, interpolated between.
TEST(RayCastMapperImages, CoarseRays)
{
  PipeScene scene;
  scene.Mapper->SetImageSampleDistance(4);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastCoarse", Tolerance));
}

// The optical models beside emission and absorption.
TEST(RayCastMapperImages, MaximumIntensity)
{
  PipeScene scene;
  scene.Mapper->SetBlendModeToMaximumIntensity();
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastMaximum", Tolerance));
  UseProjection(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastMaximum", Tolerance));
}

TEST(RayCastMapperImages, Additive)
{
  PipeScene scene;
  scene.Mapper->SetBlendModeToAdditive();
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(2);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastAdditive", Tolerance));
}

TEST(RayCastMapperImages, Absorption)
{
  PipeScene scene;
  scene.Mapper->SetBlendModeToAbsorption();
  scene.AddSphere(0, 0, 0.5, 0.4);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastAbsorption", Tolerance));
}

TEST(RayCastMapperImages, ShadedIsosurfaces)
{
  PipeScene scene;
  scene.Mapper->SetBlendModeToIsoSurface();
  scene.Opacity->RemoveAllPoints();
  scene.Opacity->AddPoint(-1, 0.3);
  scene.Opacity->AddPoint(1, 1);
  vtkContourValues* values = scene.Volume->GetProperty()->GetIsoSurfaceValues();
  values->SetValue(0, -0.5);
  values->SetValue(1, 0.1);
  values->SetValue(2, 0.6);
  scene.Volume->GetProperty()->ShadeOn();
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastIsosurfaces", Tolerance));
  UseProjection(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastIsosurfaces", Tolerance));
}

TEST(RayCastMapperImages, LitVolume)
{
  PipeScene scene;
  scene.Volume->GetProperty()->ShadeOn();
  scene.Volume->GetProperty()->SetSpecularPower(30);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastLit", Tolerance));
  UseProjection(scene);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastLit", Tolerance));
}

// The same picture as that of Parallel but for the error that is asked for.
TEST(RayCastMapperImages, Table)
{
  PipeScene scene;
  scene.AddSphere(-0.6, -0.47, 1.3, 0.4);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.5);
  scene.Mapper->SetIntegrationToTable();
  scene.Mapper->SetMaximumError(1e-2);
  EXPECT_TRUE(tetralux::MatchesBaseline(scene.Window, "RayCastParallel", Tolerance));
  EXPECT_NE(scene.Mapper->GetStatistics().find("\"integration\": \"table\""), std::string::npos);
}

} // namespace
