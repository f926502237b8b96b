// SPDX-License-Identifier: BSD-3-Clause
// The pictures of mappers against the reference renderer, which derives its rays from the camera's
// parameters and knows nothing of VTK.
#include "RayCastScene.h"

#include "ReferenceScenes.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <cmath>
#include <string>

namespace
{

enum class Method
{
  RayCast,
  GPURayCast,
  Projection
};

// A scene that a method renders.
class ReferenceScene : public RayCastScene
{
public:
  template <class... ArgumentsT>
  explicit ReferenceScene(Method method, const ArgumentsT&... arguments)
    : RayCastScene(arguments...)
  {
    if (method == Method::GPURayCast)
    {
      this->Use(vtkSmartPointer<vtkTetrahedraGPURayCastMapper>::New());
    }
    if (method == Method::Projection)
    {
      this->Use(vtkSmartPointer<vtkTetrahedraProjectionMapper>::New());
    }
  }
};

class MapperReference : public testing::TestWithParam<Method>
{
};

std::string GetName(const testing::TestParamInfo<Method>& info)
{
  return info.param == Method::RayCast ? "RayCast"
    : info.param == Method::GPURayCast ? "GPURayCast"
                                       : "Projection";
}

INSTANTIATE_TEST_SUITE_P(Methods, MapperReference,
  testing::Values(Method::RayCast, Method::GPURayCast, Method::Projection), GetName);

// The keep side of a plane, as the reference wants it.
std::array<double, 4> MakePlane(const Vector& origin, const Vector& normal)
{
  return { normal[0], normal[1], normal[2],
    -(normal[0] * origin[0] + normal[1] * origin[1] + normal[2] * origin[2]) };
}

void AddClippingPlane(RayCastScene& scene, const Vector& origin, const Vector& normal)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetNormal(normal[0], normal[1], normal[2]);
  scene.GetMapper()->AddClippingPlane(plane);
}

// Fills the view with an opaque plane; returns for each ray its distance to it, in exact
// arithmetic.
std::vector<float> AddOpaquePlane(
  RayCastScene& scene, const Vector& center, const Vector& normal, const tetralux::RayGrid& rays)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-20, -20, 0);
  source->SetPoint1(20, -20, 0);
  source->SetPoint2(-20, 20, 0);
  source->SetNormal(normal[0], normal[1], normal[2]);
  source->SetCenter(center[0], center[1], center[2]);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  scene.Renderer->AddActor(actor);

  std::vector<float> distances;
  for (int j = 0; j < rays.Height; ++j)
  {
    for (int i = 0; i < rays.Width; ++i)
    {
      double height = 0;
      double slope = 0;
      double length = 0;
      for (int c = 0; c < 3; ++c)
      {
        const double direction =
          rays.Direction[c] + i * rays.DirectionStepX[c] + j * rays.DirectionStepY[c];
        const double origin = rays.Origin[c] + i * rays.OriginStepX[c] + j * rays.OriginStepY[c];
        height += normal[c] * (center[c] - origin);
        slope += normal[c] * direction;
        length = std::hypot(length, direction);
      }
      distances.push_back(static_cast<float>(height / slope * length));
    }
  }
  return distances;
}

TEST_P(MapperReference, Perspective)
{
  ReferenceScene scene(this->GetParam());
  scene.ExpectReference();
}

TEST_P(MapperReference, HorizontalViewAngle)
{
  ReferenceScene scene(this->GetParam(), 60, 90);
  scene.Renderer->GetActiveCamera()->UseHorizontalViewAngleOn();
  // The vertical angle that makes the horizontal one 30 degrees.
  const double halfWidth = std::tan(std::acos(-1.) / 12);
  scene.ViewAngle = 2 * std::atan(1.5 * halfWidth) * 180 / std::acos(-1.);
  scene.ExpectReference();
}

TEST_P(MapperReference, Parallel)
{
  ReferenceScene scene(this->GetParam(), 72, 96);
  scene.Parallel = true;
  scene.SetCamera({ 1.9, -0.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 });
  scene.ExpectReference();
}

TEST_P(MapperReference, CameraInside)
{
  ReferenceScene scene(this->GetParam());
  scene.ViewAngle = 80;
  scene.SetCamera({ 0.5, 0.4, 0.6 }, { 0.1, 0.3, 0 }, { 0.1, 1, 0 }, 1e-3, 10);
  scene.ExpectReference();
}

TEST_P(MapperReference, ParallelPlaneInside)
{
  ReferenceScene scene(this->GetParam());
  scene.Parallel = true;
  scene.SetCamera({ 0.5, 0.4, 0.6 }, { 0.1, 0.3, 0 }, { 0.1, 1, 0 }, 0, 10);
  scene.ExpectReference();
}

TEST_P(MapperReference, NearAndFarPlanesCut)
{
  ReferenceScene scene(this->GetParam());
  scene.SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 }, 2.3, 2.8);
  scene.ExpectReference();
}

TEST_P(MapperReference, AlongGridLines)
{
  ReferenceScene scene(this->GetParam(), 64, 64);
  scene.Mesh = tetralux::MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 });
  scene.Scalars = MakeField(scene.Mesh, { 0, 0, 0 }, 1);
  scene.Grid = MakeGrid(scene.Mesh, scene.Scalars);
  scene.GetMapper()->SetInputData(scene.Grid);
  scene.Parallel = true;
  scene.ParallelScale = 0.5;
  scene.SetCamera(
    { 0.5 + 1. / 128, 0.5 + 1. / 128, 3 }, { 0.5 + 1. / 128, 0.5 + 1. / 128, 0 }, { 0, 1, 0 });
  scene.ExpectReference();
}

TEST_P(MapperReference, FarFromTheOrigin)
{
  ReferenceScene scene(this->GetParam(), 96, 72, Vector{ 1e7, -1e7, 3e6 }, 0.01);
  scene.ExpectReference();
  scene.Parallel = true;
  scene.SetCamera({ 1.9, -0.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 });
  scene.ExpectReference();
}

TEST_P(MapperReference, Viewports)
{
  ReferenceScene scene(this->GetParam(), 160, 100);
  scene.Renderer->SetViewport(0.25, 0.1, 0.85, 0.9);
  scene.ExpectReference(scene.MakeReferenceRays(96, 80), scene.MakeReferenceLimits());
}

TEST_P(MapperReference, OffAxis)
{
  ReferenceScene scene(this->GetParam());
  scene.Renderer->GetActiveCamera()->SetWindowCenter(0.25, -0.5);
  // The window's centre is a quarter of half its width to the right, and half its height down.
  const tetralux::RayGrid rays =
    tetralux::MakeTile(scene.MakeReferenceRays(96, 72), 12, -18, 96, 72);
  scene.ExpectReference(rays, scene.MakeReferenceLimits());
}

TEST_P(MapperReference, ExplicitProjection)
{
  ReferenceScene scene(this->GetParam());
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> projection;
  projection->DeepCopy(camera->GetProjectionTransformMatrix(96. / 72, -1, 1));
  camera->SetExplicitProjectionTransformMatrix(projection);
  camera->UseExplicitProjectionTransformMatrixOn();
  camera->SetViewAngle(77); // of no effect
  scene.ExpectReference();
}

TEST_P(MapperReference, VolumeTransform)
{
  ReferenceScene scene(this->GetParam());
  scene.Volume->SetOrigin(0.5, 0.5, 0.5);
  scene.Volume->SetPosition(0.1, -0.2, 0.3);
  scene.Volume->SetOrientation(20, -30, 50);
  scene.Volume->SetScale(1.2, 0.5, -0.8);
  tetralux::RayGrid rays = scene.MakeReferenceRays(96, 72);
  double matrix[3][4];
  std::copy_n(scene.Volume->GetMatrix()->GetData(), 12, &matrix[0][0]);
  tetralux::PlaceMesh(rays, matrix);
  scene.ExpectReference(rays, scene.MakeReferenceLimits());
}

TEST_P(MapperReference, ClippingPlanes)
{
  ReferenceScene scene(this->GetParam());
  AddClippingPlane(scene, { 0.5, 0.5, 0.6 }, { 0, -0.6, -0.8 });
  AddClippingPlane(scene, { 0.3, 0, 0 }, { 1, 0, 0 });
  tetralux::RayLimits limits = scene.MakeReferenceLimits();
  limits.Planes.push_back(MakePlane({ 0.5, 0.5, 0.6 }, { 0, -0.6, -0.8 }));
  limits.Planes.push_back(MakePlane({ 0.3, 0, 0 }, { 1, 0, 0 }));
  scene.ExpectReference(scene.MakeReferenceRays(96, 72), limits);
}

TEST_P(MapperReference, Cropping)
{
  ReferenceScene scene(this->GetParam());
  scene.Volume->SetOrientation(0, 0, 20); // cropping is in coordinates of the data
  tetralux::RayGrid rays = scene.MakeReferenceRays(96, 72);
  double matrix[3][4];
  std::copy_n(scene.Volume->GetMatrix()->GetData(), 12, &matrix[0][0]);
  tetralux::PlaceMesh(rays, matrix);
  scene.GetMapper()->CroppingOn();
  scene.GetMapper()->SetCroppingRegionPlanes(0.2, 0.7, 0.35, 0.8, 0.3, 0.6);
  const auto expect = [&]()
  {
    tetralux::RayLimits limits = scene.MakeReferenceLimits();
    limits.Cropping = true;
    std::copy_n(scene.GetMapper()->GetCroppingRegionPlanes(), 6, limits.CroppingPlanes);
    limits.CroppingFlags = static_cast<std::uint32_t>(scene.GetMapper()->GetCroppingRegionFlags());
    scene.ExpectReference(rays, limits);
  };
  expect();
  scene.GetMapper()->SetCroppingRegionFlagsToFence();
  expect();
  scene.GetMapper()->SetCroppingRegionFlagsToInvertedCross();
  expect();
}

TEST_P(MapperReference, OpaqueGeometryInside)
{
  ReferenceScene scene(this->GetParam());
  scene.SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 }, 0.5, 40);
  const tetralux::RayGrid rays = scene.MakeReferenceRays(96, 72);
  const std::vector<float> distances =
    AddOpaquePlane(scene, { 0.5, 0.5, 0.4 }, { 0.36, 0.48, 0.8 }, rays);
  tetralux::RayLimits limits = scene.MakeReferenceLimits();
  limits.MaximumDistances = distances.data();
  scene.ExpectReference(rays, limits);

  // Off, the plane is behind all.
  scene.GetMapper()->IntermixIntersectingGeometryOff();
  scene.ExpectReference();
}

// Of several depths in a pixel it is not said which one counts: all are the same on a plane across
// the view.
TEST_P(MapperReference, OpaqueGeometryInMultisampledParallelViewport)
{
  ReferenceScene scene(this->GetParam(), 120, 100);
  scene.Window->SetMultiSamples(4);
  scene.Renderer->SetViewport(0.2, 0.2, 1, 1);
  scene.Parallel = true;
  scene.SetCamera({ 1.94, 1.46, 2.9 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 }, 0.5, 40);
  const tetralux::RayGrid rays = scene.MakeReferenceRays(96, 80);
  const double length = std::hypot(1.44, 0.96, 2.4);
  const std::vector<float> distances =
    AddOpaquePlane(scene, { 0.5, 0.5, 0.4 }, { 1.44 / length, 0.96 / length, 2.4 / length }, rays);
  tetralux::RayLimits limits = scene.MakeReferenceLimits();
  limits.MaximumDistances = distances.data();
  scene.ExpectReference(rays, limits);
}

TEST_P(MapperReference, CellData)
{
  ReferenceScene scene(this->GetParam());
  vtkNew<vtkDoubleArray> array;
  array->SetName("OfCells");
  scene.Scalars.resize(scene.Mesh.GetNumberOfCells());
  for (std::size_t cell = 0; cell < scene.Scalars.size(); ++cell)
  {
    scene.Scalars[cell] = std::sin(1.7 * static_cast<double>(cell));
    array->InsertNextValue(scene.Scalars[cell]);
  }
  scene.CellScalars = true;
  scene.Grid->GetCellData()->AddArray(array);
  scene.GetMapper()->SetScalarModeToUseCellFieldData();
  scene.GetMapper()->SelectScalarArray("OfCells");
  scene.ExpectReference();
}

TEST(RayCastMapperReference, Precision)
{
  RayCastScene scene;
  scene.Mapper->SetPrecisionToDouble();
  scene.ExpectReference();
  EXPECT_NE(scene.Mapper->GetStatistics().find("\"precision\": \"double\""), std::string::npos);
  scene.Mapper->SetPrecisionToSingle();
  scene.ExpectReference();
  EXPECT_NE(scene.Mapper->GetStatistics().find("\"precision\": \"single\""), std::string::npos);
}

} // namespace
