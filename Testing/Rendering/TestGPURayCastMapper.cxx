// SPDX-License-Identifier: BSD-3-Clause

// Pictures of the mapper on the graphics card, against the processor's.

#include "GPUScene.h"

#include "ReferenceScenes.h"

#include "vtkCellData.h"
#include "vtkContourValues.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkProperty.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace
{

TEST(GPURayCastMapper, PictureDoesNotDependOnStepsPerPass)
{
  GPUScene scene;
  ShowPipe(scene);
  scene.GPUMapper->CountFragmentsOn();
  const GPUScene::Picture expected = scene.Render();
  const std::string segments = scene.GetStatistic("segments");
  for (const int steps : { 1, 5, 65535 })
  {
    scene.GPUMapper->SetStepsPerPass(steps);
    const GPUScene::Picture picture = scene.Render();
    EXPECT_EQ(scene.GetStatistic("segments"), segments);
    for (std::size_t k = 0; k < expected.Colors.size(); ++k)
    {
      ASSERT_NEAR(picture.Colors[k], expected.Colors[k], 1e-6) << steps;
    }
  }
}

TEST(GPURayCastMapper, ReentryGivesTheSamePicture)
{
  GPUScene scene;
  ShowPipe(scene);
  scene.ExpectProcessorsPicture();
  EXPECT_EQ(scene.GetStatistic("reentry"), "\"boundary hierarchy\"");
  scene.GPUMapper->SetReentryToImaginaryCells();
  scene.ExpectProcessorsPicture();
  EXPECT_EQ(scene.GetStatistic("reentry"), "\"imaginary cells\"");

  scene.GPUMapper->SetReentryToBoundaryLayers();
  scene.ExpectProcessorsPicture();
  EXPECT_EQ(scene.GetStatistic("reentry"), "\"boundary layers\"");
  scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
  scene.Renderer->GetActiveCamera()->SetParallelScale(1.5);
  scene.ExpectProcessorsPicture();
  EXPECT_EQ(scene.GetStatistic("reentry"), "\"boundary layers\"");

  // Layers that reach through the plane of the eye have no bounds in the picture.
  scene.Renderer->GetActiveCamera()->ParallelProjectionOff();
  scene.SetCamera({ 0.7, -0.1, 0.4 }, { 0.1, 0.3, 1 }, { 0, 0, 1 }, 0.001, 10);
  scene.ExpectProcessorsPicture();
  EXPECT_EQ(scene.GetStatistic("reentry"), "\"boundary hierarchy\"");

  // A box is convex.
  GPUScene box;
  for (const int reentry : { vtkTetrahedraGPURayCastMapper::NO_REENTRY,
         vtkTetrahedraGPURayCastMapper::IMAGINARY_CELLS_REENTRY,
         vtkTetrahedraGPURayCastMapper::AUTOMATIC_REENTRY })
  {
    box.GPUMapper->SetReentry(reentry);
    box.ExpectProcessorsPicture();
    EXPECT_EQ(box.GetStatistic("reentry"), "\"none\"");
  }
}

// Cells turned inside out, and parts that overlap.
TEST(GPURayCastMapper, InvertedAndOverlappingCells)
{
  GPUScene scene;
  scene.SetMesh(tetralux::MakeBox(6, 5, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.6, 3));
  scene.ExpectProcessorsPicture(20);
}

// A ring of cells that comes back mirrored: no orientation tells where rays come in.
TEST(GPURayCastMapper, CellsThatCannotBeOriented)
{
  // Consecutive points make a cell; the last three are the first three in another order.
  tetralux::TetrahedralMesh mesh;
  constexpr int Length = 30;
  std::vector<std::int32_t> strip;
  for (int p = 0; p < Length; ++p)
  {
    const double angle = 2 * vtkMath::Pi() * p / Length;
    const double turn = 3.1 * p;
    const double radius = 0.6 + 0.25 * std::cos(turn);
    mesh.Points.insert(mesh.Points.end(),
      { radius * std::cos(angle), radius * std::sin(angle), 0.25 * std::sin(turn) });
    strip.push_back(p);
  }
  strip.insert(strip.end(), { 0, 2, 1 });
  for (int p = 0; p < Length; ++p)
  {
    mesh.Cells.insert(mesh.Cells.end(), &strip[p], &strip[p] + 4);
  }
  GPUScene scene(200, 150);
  scene.SetMesh(mesh);
  for (const int mode : { static_cast<int>(vtkTetrahedraVolumeMapper::COMPOSITE_BLEND),
         static_cast<int>(vtkTetrahedraVolumeMapper::MAXIMUM_INTENSITY_BLEND) })
  {
    scene.GPUMapper->SetBlendMode(mode);
    for (const int steps : { 1, 64 })
    {
      SCOPED_TRACE(std::to_string(mode) + " " + std::to_string(steps));
      scene.GPUMapper->SetStepsPerPass(steps);
      for (const Vector& position : { Vector{ 0.3, 0.5, 2.4 }, Vector{ 2, 0.5, 0.4 } })
      {
        scene.SetCamera(position, { 0, 0, 0 }, { 0, 1, 0 });
        scene.ExpectProcessorsPicture();
      }
      scene.GPUMapper->CroppingOn();
      scene.GPUMapper->SetCroppingRegionPlanes(-0.5, 0.4, -0.3, 0.5, -0.2, 0.2);
      scene.GPUMapper->SetCroppingRegionFlags(0x5f7ffdf);
      scene.Mapper->CroppingOn();
      scene.Mapper->SetCroppingRegionPlanes(scene.GPUMapper->GetCroppingRegionPlanes());
      scene.Mapper->SetCroppingRegionFlags(scene.GPUMapper->GetCroppingRegionFlags());
      scene.ExpectProcessorsPicture();
      scene.GPUMapper->CroppingOff();
      scene.Mapper->CroppingOff();
    }
    EXPECT_NE(scene.GetStatistic("shader_variant").find("PAIRED"), std::string::npos);
  }
}

TEST(GPURayCastMapper, OpticalModels)
{
  GPUScene scene;
  ShowPipe(scene);
  vtkNew<vtkDoubleArray> ofCells;
  ofCells->SetName("OfCells");
  for (std::size_t cell = 0; cell < scene.Mesh.GetNumberOfCells(); ++cell)
  {
    ofCells->InsertNextValue(std::sin(1.7 * static_cast<double>(cell)));
  }
  scene.Grid->GetCellData()->AddArray(ofCells);
  vtkContourValues* surfaces = scene.Volume->GetProperty()->GetIsoSurfaceValues();
  for (int i = 0; i < 3; ++i)
  {
    surfaces->SetValue(i, -0.4 + 0.3 * i);
  }
  using Mapper = vtkTetrahedraVolumeMapper;
  for (const int mode :
    { static_cast<int>(Mapper::COMPOSITE_BLEND), static_cast<int>(Mapper::MAXIMUM_INTENSITY_BLEND),
      static_cast<int>(Mapper::ADDITIVE_BLEND), static_cast<int>(Mapper::ISOSURFACE_BLEND),
      static_cast<int>(Mapper::ABSORPTION_BLEND) })
  {
    SCOPED_TRACE(mode);
    scene.GPUMapper->SetBlendMode(mode);
    scene.GPUMapper->SetScalarModeToUsePointFieldData();
    scene.GPUMapper->SelectScalarArray("Field");
    scene.ExpectProcessorsPicture(mode == Mapper::ISOSURFACE_BLEND ? 3 : 0);
    if (mode != Mapper::ISOSURFACE_BLEND)
    {
      scene.GPUMapper->SetScalarModeToUseCellFieldData();
      scene.GPUMapper->SelectScalarArray("OfCells");
      scene.ExpectProcessorsPicture(mode == Mapper::MAXIMUM_INTENSITY_BLEND ? 3 : 0);
    }
  }
}

// Volumes and isosurfaces, by gradients of points and of cells.
TEST(GPURayCastMapper, Lit)
{
  GPUScene scene;
  ShowPipe(scene);
  scene.Volume->GetProperty()->ShadeOn();
  scene.Volume->GetProperty()->SetSpecular(0.4);
  scene.Volume->SetScale(1, 0.8, 1.2);
  vtkContourValues* surfaces = scene.Volume->GetProperty()->GetIsoSurfaceValues();
  for (int i = 0; i < 3; ++i)
  {
    surfaces->SetValue(i, -0.4 + 0.3 * i);
  }
  for (const bool smooth : { true, false })
  {
    for (const int mode : { static_cast<int>(vtkTetrahedraVolumeMapper::COMPOSITE_BLEND),
           static_cast<int>(vtkTetrahedraVolumeMapper::ISOSURFACE_BLEND) })
    {
      SCOPED_TRACE(std::to_string(mode) + (smooth ? " smooth" : " of cells"));
      scene.GPUMapper->SetSmoothShading(smooth);
      scene.GPUMapper->SetBlendMode(mode);
      scene.ExpectProcessorsPicture(3);
      EXPECT_NE(scene.GetStatistic("shader_variant").find("LIT"), std::string::npos);
    }
  }
}

// By table, of both axes and scales.
TEST(GPURayCastMapper, Tables)
{
  GPUScene scene;
  ShowPipe(scene);
  scene.GPUMapper->SetIntegrationToTable();
  using Mapper = vtkTetrahedraVolumeMapper;
  for (const int axis :
    { static_cast<int>(Mapper::UNIFORM_AXIS), static_cast<int>(Mapper::NODES_AXIS) })
  {
    for (const int scale :
      { static_cast<int>(Mapper::LINEAR_SCALE), static_cast<int>(Mapper::LOGARITHMIC_SCALE) })
    {
      scene.GPUMapper->SetTableScalarAxis(axis);
      scene.GPUMapper->SetTableLengthScale(scale);
      scene.GPUMapper->SetTableScalarSize(128);
      scene.GPUMapper->SetTableLengthSize(64);
      scene.ExpectProcessorsPicture();
      EXPECT_EQ(scene.GetStatistic("integration"), "\"table\"");
    }
  }
}

// The first contribution is where the function begins to contribute, within a cell; and transparent
// cells are left out.
TEST(GPURayCastMapper, TransparentCells)
{
  GPUScene scene;
  ShowPipe(scene);
  scene.Opacity->RemoveAllPoints();
  scene.Opacity->AddPoint(0.1, 0);
  scene.Opacity->AddPoint(0.7, 0.9);
  scene.ExpectProcessorsPicture(3);
  EXPECT_NE(
    scene.GetMapper()->GetStatistics().find("\"transparent tetrahedra\""), std::string::npos);
}

// Rays through vertices, along edges and in faces, in single precision: none is lost.
class GPURayCastMapperReentry : public testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(Modes, GPURayCastMapperReentry,
  testing::Values(vtkTetrahedraGPURayCastMapper::BOUNDARY_HIERARCHY_REENTRY,
    vtkTetrahedraGPURayCastMapper::BOUNDARY_LAYERS_REENTRY,
    vtkTetrahedraGPURayCastMapper::NO_REENTRY));

TEST_P(GPURayCastMapperReentry, RaysAlongTheLattice)
{
  GPUScene scene(64, 64);
  scene.GPUMapper->SetReentry(this->GetParam());
  scene.SetMesh(tetralux::MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }));
  scene.Parallel = true;
  scene.ParallelScale = 1;
  // A pixel is 1 / 32; rays go through the lattice's points, but for the hull.
  const double shift = 1. / 64;
  for (const Vector& direction : { Vector{ 0, 0, 1 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, 1, 1 },
         { 1, 0, -1 }, { 1, 1, 1 }, { 1, 2, 0 } })
  {
    SCOPED_TRACE(testing::PrintToString(direction));
    const Vector up = direction[2] == 0 ? Vector{ 0, 0, 1 } : Vector{ 1, 0, 0 };
    const Vector point{ 0.5 + shift, 0.5 + shift, 0.5 + shift };
    scene.SetCamera(
      { point[0] + 3 * direction[0], point[1] + 3 * direction[1], point[2] + 3 * direction[2] },
      point, up);
    scene.ExpectReference();
  }
  // From a point of the lattice, and from one on an edge.
  scene.Parallel = false;
  scene.ViewAngle = 90;
  scene.SetCamera({ 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 1e-3, 10);
  scene.ExpectReference();
  scene.SetCamera({ 0.5, 0.25, 0.6 }, { 1, 0.75, 0.6 }, { 0, 0, 1 }, 1e-3, 10);
  scene.ExpectReference();
}

// The middle of each picture is seen through two points of the mesh, one behind the other.
TEST(GPURayCastMapper, RaysThroughPoints)
{
  GPUScene scene(33, 33);
  tetralux::TetrahedralMesh mesh = tetralux::MakeBox(5, 4, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.3, 5);
  for (double& x : mesh.Points)
  {
    x = std::round(64 * x) / 64; // exact in single precision, and many points in line with others
  }
  const std::vector<double> points = mesh.Points;
  scene.SetMesh(std::move(mesh));
  scene.ViewAngle = 12;
  const std::size_t numberOfPoints = points.size() / 3;
  for (std::size_t k = 0; k < 12; ++k)
  {
    SCOPED_TRACE(k);
    const std::size_t a = 7 * k % numberOfPoints;
    const std::size_t b = (31 * k + 40) % numberOfPoints;
    Vector eye;
    Vector focus;
    for (int c = 0; c < 3; ++c)
    {
      focus[c] = points[3 * a + c];
      eye[c] = focus[c] + 4 * (points[3 * b + c] - focus[c]);
    }
    ASSERT_NE(eye, focus);
    scene.SetCamera(eye, focus, { 0.1, 0.3, 1 }, 0.01, 50);
    scene.GPUMapper->SetReentry(k % 2 == 0
        ? vtkTetrahedraGPURayCastMapper::BOUNDARY_HIERARCHY_REENTRY
        : vtkTetrahedraGPURayCastMapper::BOUNDARY_LAYERS_REENTRY);
    scene.ExpectProcessorsPicture(4); // that graze the hull
  }
}

// Thin and thick cells together, the thin ones a millionth as thick; and attenuation so high that
// rays end in a few of them.
TEST(GPURayCastMapper, BoundaryLayers)
{
  GPUScene scene;
  tetralux::TetrahedralMesh mesh = tetralux::MakeBox(5, 5, 12, { 0, 0, 0 }, { 1, 1, 1 });
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    // Heights 1, 1 / 4, 1 / 16 and so on, down to 2.4e-7 at the bottom.
    double& height = mesh.Points[3 * p + 2];
    height = height == 0 ? 0 : std::pow(4, 12 * height - 12);
  }
  scene.SetMesh(std::move(mesh));
  scene.SetCamera({ 1.6, 1.3, 1.9 }, { 0.5, 0.5, 0.4 }, { 0, 0, 1 });
  scene.ExpectReference();
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(2.5e-3);
  for (auto& node : scene.Function.Nodes)
  {
    node.Left.Attenuation *= 100;
    node.Right.Attenuation *= 100;
  }
  scene.GPUMapper->SetMaximumError(1e-5);
  scene.ExpectProcessorsPicture(2);
}

} // namespace
