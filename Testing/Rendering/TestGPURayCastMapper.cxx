// SPDX-License-Identifier: BSD-3-Clause
// What the mapper on the graphics card does by itself: passes, uploads, windows, errors; and its
// pictures beside those of the mapper on the processor, whose right rays and integrals are
// tested by themselves.
#include "Observer.h"
#include "OpenGLSnapshot.h"
#include "RayCastScene.h"
#include "Statistics.h"

#include "Generate/GeneratedMeshes.h"
#include "ReferenceScenes.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>

namespace
{

// Of a channel (relative, where light adds up beyond 1) and, in sizes of the box, of a distance,
// between both mappers: each has its own roundings.
constexpr double ColorTolerance = 5e-5;
constexpr double DepthTolerance = 1e-5;

// A scene with both mappers; that on the graphics card draws.
class GPUScene : public RayCastScene
{
public:
  template <class... ArgumentsT>
  explicit GPUScene(const ArgumentsT&... arguments)
    : RayCastScene(arguments...)
  {
    this->Use(this->GPUMapper);
  }

  void SetMesh(tetralux::TetrahedralMesh mesh)
  {
    this->Mesh = std::move(mesh);
    this->Scalars = MakeField(this->Mesh, { -1, -1, -1 }, 2);
    this->Grid = MakeGrid(this->Mesh, this->Scalars);
    this->Use(this->GPUMapper);
  }

  std::string GetStatistic(const std::string& name) const
  {
    return ::GetStatistic(this->GetMapper(), name);
  }

  struct Picture
  {
    std::vector<float> Colors;
    std::vector<float> Depths;
  };

  Picture Render()
  {
    this->Window->Render();
    const vtkIdType pixels = this->GetMapper()->GetOutputImage()->GetNumberOfPoints();
    if (pixels == 0)
    {
      return {};
    }
    return { { this->GetColors(), this->GetColors() + 4 * pixels },
      { this->GetDepths(), this->GetDepths() + pixels } };
  }

  Picture RenderByProcessor()
  {
    this->Mapper->SetBlendMode(this->GPUMapper->GetBlendMode());
    this->Mapper->SetMaximumError(this->GPUMapper->GetMaximumError());
    this->Mapper->SetScalarMode(this->GPUMapper->GetScalarMode());
    this->Mapper->SelectScalarArray(this->GPUMapper->GetArrayName());
    this->Mapper->SetIntegration(this->GPUMapper->GetIntegration());
    this->Mapper->SetTableScalarSize(this->GPUMapper->GetTableScalarSize());
    this->Mapper->SetTableLengthSize(this->GPUMapper->GetTableLengthSize());
    this->Mapper->SetTableLengthScale(this->GPUMapper->GetTableLengthScale());
    this->Mapper->SetTableScalarAxis(this->GPUMapper->GetTableScalarAxis());
    this->Mapper->SetSmoothShading(this->GPUMapper->GetSmoothShading());
    this->Mapper->SetPrecisionToDouble();
    this->Use(this->Mapper);
    Picture picture = this->Render();
    this->Use(this->GPUMapper);
    return picture;
  }

  // Both pictures are the same, but for a few pixels, which may hit or miss a silhouette or a step.
  void ExpectProcessorsPicture(std::size_t exceptions = 0)
  {
    const Picture expected = this->RenderByProcessor();
    const Picture picture = this->Render();
    ASSERT_EQ(picture.Colors.size(), expected.Colors.size());
    std::size_t covered = 0;
    std::size_t wrong = 0;
    std::size_t wrongDepths = 0;
    double largest = 0;
    for (std::size_t pixel = 0; pixel < picture.Depths.size(); ++pixel)
    {
      covered += expected.Depths[pixel] != -1;
      double difference = 0;
      for (std::size_t c = 4 * pixel; c < 4 * pixel + 4; ++c)
      {
        const double value = expected.Colors[c];
        difference =
          std::max(difference, std::abs(picture.Colors[c] - value) / std::max(1., std::abs(value)));
      }
      wrong += !(difference <= ColorTolerance);
      largest = std::max(largest, difference);
      wrongDepths +=
        !(std::abs(picture.Depths[pixel] - expected.Depths[pixel]) <= DepthTolerance * this->Size);
    }
    EXPECT_GT(covered, picture.Depths.size() / 20);
    EXPECT_LE(wrong, exceptions) << "largest difference " << largest;
    EXPECT_LE(wrongDepths, exceptions);
  }

  vtkNew<vtkTetrahedraGPURayCastMapper> GPUMapper;
};

tetralux::TetrahedralMesh MakePipe()
{
  return tetralux::GenerateMesh(
    "cylinder-with-hole", { { "across", 2 }, { "around", 20 }, { "along", 6 }, { "hole", 0.5 } })
    .Mesh;
}

void ShowPipe(GPUScene& scene)
{
  scene.SetMesh(MakePipe());
  scene.SetCamera({ 2.5, -3.2, 2.4 }, { 0, 0, 0.9 }, { 0, 0, 1 }, 0.1, 20);
}

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

// What a frame shows, in the window and by the mapper.
struct Shown
{
  GPUScene::Picture Picture;
  std::vector<int> Window;
  bool operator==(const Shown& other) const
  {
    return this->Picture.Colors == other.Picture.Colors &&
      this->Picture.Depths == other.Picture.Depths && this->Window == other.Window;
  }
};

Shown Show(GPUScene& scene)
{
  Shown shown;
  shown.Picture = scene.Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(scene.Window);
  grab->ShouldRerenderOff();
  grab->ReadFrontBufferOff();
  grab->Update();
  const auto* bytes = static_cast<const unsigned char*>(grab->GetOutput()->GetScalarPointer());
  shown.Window.assign(bytes, bytes + 3 * grab->GetOutput()->GetNumberOfPoints());
  return shown;
}

// 38 bytes a pixel, or 42 with layers.
constexpr vtkIdType BytesOfRow = 96 * 38;

// In one piece, in bands of up to 17 rows, of which the last one has fewer, and row by row: the
// same, bit for bit.
void ExpectSameInBands(GPUScene& scene, const char* name)
{
  SCOPED_TRACE(name);
  scene.GPUMapper->SetRayMaximumBytes(1 << 30);
  const Shown expected = Show(scene);
  EXPECT_EQ(scene.GetStatistic("bands"), "1");
  EXPECT_GT(*std::max_element(expected.Picture.Depths.begin(), expected.Picture.Depths.end()), 0);
  for (const vtkIdType rows : { 17, 1 })
  {
    scene.GPUMapper->SetRayMaximumBytes(std::max<vtkIdType>(rows * BytesOfRow, 4096));
    EXPECT_TRUE(Show(scene) == expected) << rows;
    EXPECT_EQ(scene.GetStatistic("bands"), rows == 17 ? "5" : "72");
  }
  scene.GPUMapper->SetRayMaximumBytes(1 << 30);
}

TEST(GPURayCastMapper, BandsGiveTheSamePicture)
{
  using Mapper = vtkTetrahedraVolumeMapper;
  GPUScene scene;
  ShowPipe(scene);
  scene.GPUMapper->SetStepsPerPass(5);
  ExpectSameInBands(scene, "plain");
  scene.Renderer->SetViewport(0, 0.25, 1, 1);
  scene.GPUMapper->SetRayMaximumBytes(17 * BytesOfRow);
  const Shown bands = Show(scene);
  EXPECT_EQ(scene.GetStatistic("bands"), "4"); // of 54 rows
  scene.GPUMapper->SetRayMaximumBytes(1 << 30);
  EXPECT_TRUE(Show(scene) == bands);
  scene.Renderer->SetViewport(0, 0, 1, 1);

  scene.GPUMapper->SetReentryToImaginaryCells();
  ExpectSameInBands(scene, "imaginary cells");
  scene.GPUMapper->SetReentryToAutomatic();
  scene.GPUMapper->CountFragmentsOn();
  ExpectSameInBands(scene, "counted");
  scene.GPUMapper->CountFragmentsOff();

  vtkContourValues* surfaces = scene.Volume->GetProperty()->GetIsoSurfaceValues();
  for (int i = 0; i < 3; ++i)
  {
    surfaces->SetValue(i, -0.4 + 0.3 * i);
  }
  for (const int mode :
    { static_cast<int>(Mapper::ISOSURFACE_BLEND), static_cast<int>(Mapper::MAXIMUM_INTENSITY_BLEND),
      static_cast<int>(Mapper::COMPOSITE_BLEND) })
  {
    scene.GPUMapper->SetBlendMode(mode);
    scene.Volume->GetProperty()->ShadeOff();
    ExpectSameInBands(scene, "unlit");
    scene.Volume->GetProperty()->ShadeOn();
    ExpectSameInBands(scene, "lit");
  }
  scene.Volume->GetProperty()->ShadeOff();

  scene.GPUMapper->CroppingOn();
  scene.GPUMapper->SetCroppingRegionPlanes(-0.5, 0.4, -0.3, 0.5, 0.2, 1);
  scene.GPUMapper->SetCroppingRegionFlagsToFence();
  ExpectSameInBands(scene, "cropped");
  scene.GPUMapper->CroppingOff();

  vtkNew<vtkSphereSource> source;
  source->SetCenter(0.2, -0.4, 1.2);
  source->SetRadius(0.5);
  vtkNew<vtkPolyDataMapper> polyData;
  polyData->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(polyData);
  scene.Renderer->AddActor(actor);
  ExpectSameInBands(scene, "opaque geometry");
}

// Layers keep four bytes a pixel more.
TEST(GPURayCastMapper, BandsOfLayersGiveTheSamePicture)
{
  GPUScene scene;
  ShowPipe(scene);
  scene.GPUMapper->SetReentryToBoundaryLayers();
  const Shown expected = Show(scene);
  EXPECT_EQ(scene.GetStatistic("reentry"), "\"boundary layers\"");
  EXPECT_EQ(scene.GetStatistic("picture_bytes_per_pixel"), "62.0");
  scene.GPUMapper->SetRayMaximumBytes(17 * 96 * 42);
  EXPECT_TRUE(Show(scene) == expected);
  EXPECT_EQ(scene.GetStatistic("bands"), "5");
  scene.GPUMapper->SetRayMaximumBytes(17 * 96 * 42 - 1);
  EXPECT_TRUE(Show(scene) == expected);
  EXPECT_EQ(scene.GetStatistic("rows_per_band"), "15");
}

// What the class header promises.
TEST(GPURayCastMapper, BytesOfAPixel)
{
  GPUScene scene;
  ShowPipe(scene);
  scene.Window->Render();
  EXPECT_EQ(scene.GetStatistic("picture_bytes_per_pixel"), "58.0");
  scene.GPUMapper->SetRayMaximumBytes(9 * BytesOfRow); // an eighth
  scene.Window->Render();
  EXPECT_EQ(scene.GetStatistic("bands"), "8");
  EXPECT_EQ(scene.GetStatistic("picture_bytes_per_pixel"), "24.75");
  scene.GPUMapper->CountFragmentsOn();
  scene.Window->Render();
  EXPECT_EQ(scene.GetStatistic("picture_bytes_per_pixel"), "28.75");
}

TEST(GPURayCastMapper, UploadsWhatChanged)
{
  GPUScene scene;
  scene.Window->Render();
  const std::size_t points = 16 * scene.Mesh.GetNumberOfPoints();
  const std::string cellsAndPoints = std::to_string(32 * scene.Mesh.GetNumberOfCells() + points);
  EXPECT_EQ(scene.GetStatistic("tetrahedra_and_points_bytes"), cellsAndPoints);
  EXPECT_EQ(scene.GetStatistic("uploaded_bytes"), scene.GetStatistic("mesh_bytes"));

  scene.Renderer->GetActiveCamera()->Azimuth(10);
  scene.Window->Render();
  EXPECT_EQ(scene.GetStatistic("uploaded_bytes"), "0");
  scene.Color->AddRGBPoint(0.5, 1, 1, 1);
  scene.Window->Render();
  EXPECT_EQ(scene.GetStatistic("uploaded_bytes"), "0");

  auto* field = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetScalars());
  field->SetValue(0, 0.3);
  field->Modified();
  scene.Scalars[0] = 0.3;
  scene.Window->Render();
  EXPECT_EQ(scene.GetStatistic("uploaded_bytes"), std::to_string(points));
  scene.ExpectProcessorsPicture();

  scene.Grid->GetPoints()->SetPoint(0, -0.1, -0.1, -0.1);
  scene.Grid->GetPoints()->Modified();
  scene.ExpectProcessorsPicture(1); // that passes an edge of the hull closely and is displaced
  const std::size_t faces = 32 * scene.Mesh.GetNumberOfCells();
  const std::size_t mesh = std::stoul(scene.GetStatistic("mesh_bytes"));
  EXPECT_EQ(scene.GetStatistic("uploaded_bytes"), std::to_string(mesh - faces));
}

// After a frame with all that frames may have, after an aborted one, and after one with an error.
TEST(GPURayCastMapper, LeavesOpenGLAsItWas)
{
  GPUScene scene;
  scene.Window->Render(); // makes the context
  OpenGLSnapshot before;
  OpenGLSnapshot after;
  const Observer start(scene.GPUMapper, vtkCommand::VolumeMapperRenderStartEvent,
    [&](const char*) { before = TakeOpenGLSnapshot(scene.Window); });
  const Observer end(scene.GPUMapper, vtkCommand::VolumeMapperRenderEndEvent,
    [&](const char*) { after = TakeOpenGLSnapshot(scene.Window); });
  scene.Renderer->PreserveDepthBufferOn(); // so that depths are read
  scene.GPUMapper->CroppingOn();
  scene.GPUMapper->SetCroppingRegionPlanes(0.2, 0.7, 0.35, 0.8, 0.3, 0.6);
  scene.GPUMapper->SetCroppingRegionFlagsToFence();
  scene.Window->Render();
  EXPECT_EQ(FindDifferences(before, after), "");

  scene.GPUMapper->SetStepsPerPass(1);
  {
    const Observer progress(scene.GPUMapper, vtkCommand::VolumeMapperRenderProgressEvent,
      [&](const char*) { scene.Window->SetAbortRender(1); });
    scene.Window->Render();
  }
  EXPECT_EQ(scene.GetStatistic("aborted"), "true");
  EXPECT_EQ(FindDifferences(before, after), "");
}

TEST(GPURayCastMapper, AbortedFramesAreNotDrawn)
{
  GPUScene scene;
  scene.Renderer->SetBackground(0, 0, 1);
  scene.GPUMapper->SetStepsPerPass(1);
  int events = 0;
  bool abort = true;
  const Observer progress(scene.GPUMapper, vtkCommand::VolumeMapperRenderProgressEvent,
    [&](const char*)
    {
      ++events;
      scene.Window->SetAbortRender(abort);
    });
  scene.Window->Render();
  EXPECT_EQ(events, 1);
  EXPECT_EQ(scene.GetStatistic("aborted"), "true");
  EXPECT_EQ(scene.GPUMapper->GetOutputImage()->GetNumberOfPoints(), 0);
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(scene.Window);
  grab->ShouldRerenderOff();
  grab->ReadFrontBufferOff();
  grab->Update();
  double range[2];
  grab->GetOutput()->GetPointData()->GetScalars()->GetRange(range, 0);
  EXPECT_EQ(range[1], 0);

  // The next frame is complete.
  abort = false;
  scene.ExpectProcessorsPicture();
  EXPECT_EQ(scene.GetStatistic("aborted"), "false");
}

TEST(GPURayCastMapper, ReportsProgress)
{
  GPUScene scene;
  scene.GPUMapper->SetStepsPerPass(2);
  std::vector<double> shares;
  const Observer progress(scene.GPUMapper, vtkCommand::VolumeMapperRenderProgressEvent,
    [&](const char* data)
    {
      double share;
      std::copy_n(data, sizeof(share), reinterpret_cast<char*>(&share));
      shares.push_back(share);
    });
  scene.Window->Render();
  ASSERT_GT(shares.size(), 2u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);

  // In bands of nine rows: every eighth is told of.
  shares.clear();
  scene.GPUMapper->SetRayMaximumBytes(9 * BytesOfRow);
  scene.Window->Render();
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  for (int band = 0; band <= 8; ++band)
  {
    EXPECT_EQ(std::count(shares.begin(), shares.end(), band / 8.) > 0, true) << band;
  }
}

// Between bands, too.
TEST(GPURayCastMapper, AbortedBandsAreNotDrawn)
{
  GPUScene scene;
  scene.GPUMapper->SetRayMaximumBytes(9 * BytesOfRow);
  double last = 0;
  bool abort = true;
  const Observer progress(scene.GPUMapper, vtkCommand::VolumeMapperRenderProgressEvent,
    [&](const char* data)
    {
      std::copy_n(data, sizeof(last), reinterpret_cast<char*>(&last));
      scene.Window->SetAbortRender(abort && last >= 0.5);
    });
  const Shown aborted = Show(scene);
  EXPECT_GE(last, 0.5);
  EXPECT_LT(last, 0.625);
  EXPECT_EQ(scene.GetStatistic("aborted"), "true");
  EXPECT_TRUE(aborted.Picture.Colors.empty());
  EXPECT_EQ(*std::max_element(aborted.Window.begin(), aborted.Window.end()), 0);
  abort = false;
  scene.ExpectProcessorsPicture();
}

// One mapper in two windows, by turns; and in a third one where the others are no more.
TEST(GPURayCastMapper, SeveralWindows)
{
  vtkNew<vtkTetrahedraGPURayCastMapper> mapper;
  GPUScene first;
  const GPUScene::Picture expected = first.Render();
  {
    GPUScene second;
    int turn = 0;
    for (GPUScene* scene : { &first, &second, &first, &second })
    {
      scene->Use(mapper);
      EXPECT_TRUE(scene->Render().Colors == expected.Colors) << "turn " << turn;
      ++turn;
    }
    second.Window->Finalize();
  }
  EXPECT_TRUE(first.Render().Colors == expected.Colors);
  mapper->ReleaseGraphicsResources(first.Window);
  EXPECT_TRUE(first.Render().Colors == expected.Colors);
  first.Window->Finalize();
  GPUScene third;
  third.Use(mapper);
  EXPECT_TRUE(third.Render().Colors == expected.Colors);
}

TEST(GPURayCastMapper, PicturesGoWithTheirWindow)
{
  vtkNew<vtkTetrahedraGPURayCastMapper> mapper;
  for (const bool finalized : { false, true })
  {
    {
      GPUScene scene;
      scene.Use(mapper);
      scene.Window->Render();
      if (finalized)
      {
        scene.Window->Finalize();
      }
    }
    EXPECT_EQ(mapper->GetOutputImage()->GetNumberOfPoints(), 0);
  }
}

// Beside a second volume, and with translucent geometry that VTK peels in layers: as with the
// mapper on the processor.
TEST(GPURayCastMapper, AmongOtherProps)
{
  const auto grab = [](bool byProcessor)
  {
    GPUScene scene(120, 90);
    scene.Renderer->SetUseDepthPeeling(1);
    scene.Renderer->SetMaximumNumberOfPeels(4);
    scene.Renderer->SetBackground(0.2, 0.3, 0.4);
    vtkNew<vtkSphereSource> source;
    source->SetCenter(0.9, 0.6, 1);
    source->SetRadius(0.3);
    vtkNew<vtkPolyDataMapper> polyData;
    polyData->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(polyData);
    actor->GetProperty()->SetOpacity(0.5);
    scene.Renderer->AddActor(actor);
    vtkNew<vtkTetrahedraGPURayCastMapper> otherGPUMapper;
    vtkNew<vtkTetrahedraRayCastMapper> otherMapper;
    otherMapper->AutoAdjustSampleDistancesOff();
    otherGPUMapper->SetInputData(scene.Grid);
    otherMapper->SetInputData(scene.Grid);
    vtkNew<vtkVolume> other;
    other->SetProperty(scene.Volume->GetProperty());
    other->SetPosition(0.4, 0.5, -0.8);
    if (byProcessor)
    {
      other->SetMapper(otherMapper);
      scene.Use(scene.Mapper);
    }
    else
    {
      other->SetMapper(otherGPUMapper);
    }
    scene.Renderer->AddVolume(other);
    vtkNew<vtkWindowToImageFilter> filter;
    filter->SetInput(scene.Window);
    filter->Update();
    vtkNew<vtkImageData> image;
    image->DeepCopy(filter->GetOutput());
    const auto* bytes = static_cast<const unsigned char*>(image->GetScalarPointer());
    return std::vector<int>(bytes, bytes + 3 * image->GetNumberOfPoints());
  };
  const std::vector<int> expected = grab(true);
  const std::vector<int> picture = grab(false);
  ASSERT_EQ(picture.size(), expected.size());
  int largest = 0;
  for (std::size_t k = 0; k < picture.size(); ++k)
  {
    largest = std::max(largest, std::abs(picture[k] - expected[k]));
  }
  EXPECT_LE(largest, 1);
}

TEST(GPURayCastMapper, TellsWhetherItIsSupported)
{
  GPUScene scene;
  EXPECT_FALSE(scene.GPUMapper->IsSupported(nullptr));
  EXPECT_NE(scene.GPUMapper->GetSupportReason(), "");
  // Before the first frame, and with one.
  EXPECT_TRUE(scene.GPUMapper->IsSupported(scene.Window));
  const bool accelerated = scene.GPUMapper->IsAccelerated(scene.Window);
  const std::string reason = scene.GPUMapper->GetSupportReason();
  scene.Window->Render();
  const std::string renderer = scene.GetStatistic("renderer");
  EXPECT_NE(reason.find(renderer.substr(1, renderer.size() - 2)), std::string::npos);
  EXPECT_EQ(accelerated, scene.GetStatistic("software") == "false");
}

TEST(GPURayCastMapper, ErrorsAreOneLine)
{
  GPUScene scene;
  std::vector<std::string> errors;
  const Observer watcher(
    scene.GPUMapper, vtkCommand::ErrorEvent, [&](const char* text) { errors.emplace_back(text); });
  scene.Volume->SetScale(1e-40, 1e-40, 1e-40);
  scene.Window->Render();
  scene.Window->Render();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("single precision"), std::string::npos);
  EXPECT_EQ(scene.GPUMapper->GetOutputImage()->GetNumberOfPoints(), 0);
  scene.Volume->SetScale(1, 1, 1);
  scene.ExpectReference();
}

TEST(GPURayCastMapper, PrintsItself)
{
  vtkNew<vtkTetrahedraGPURayCastMapper> mapper;
  mapper->SetStepsPerPass(77);
  std::ostringstream text;
  mapper->Print(text);
  EXPECT_NE(text.str().find("StepsPerPass: 77"), std::string::npos);
}

} // namespace
