// SPDX-License-Identifier: BSD-3-Clause

// Whole pictures against the brute-force reference: within 1e-4 in at least 99.9 % of the covered
// pixels, and nowhere off by more than 1/255 but where a silhouette is grazed.

#include "Generate/GeneratedMeshes.h"
#include "ImageComparison.h"
#include "Intake/ScalarExtraction.h"
#include "Intake/TetrahedraIntake.h"
#include "RayCast/RayCaster.h"
#include "ReferenceGrazing.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"
#include "Walk/WalkMesh.h"

#include <vtkAbstractMapper.h>
#include <vtkDataObject.h>
#include <vtkExodusIIReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiBlockPLOT3DReader.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

/// Pixels along an edge of a picture; smaller where the reference takes long over each.
constexpr int ImageSize = 512;
constexpr int SmallImageSize = 160;

/// Largest error of a channel that is promised in WantedShare of the covered pixels.
constexpr double WantedError = 1e-4;
constexpr double WantedShare = 0.999;

struct Scene
{
  TetrahedralMesh Mesh;
  std::vector<double> Scalars;
  bool CellScalars = false;
  TransferFunction Function;
  RayGrid Grid;
  RayLimits Limits;
};

/// Centre and radius of the points that cells use.
void GetBall(const TetrahedralMesh& mesh, Vector& center, double& radius)
{
  Vector lo, hi;
  lo.fill(std::numeric_limits<double>::max());
  hi.fill(std::numeric_limits<double>::lowest());
  for (std::int32_t p : mesh.Cells)
  {
    for (int a = 0; a < 3; ++a)
    {
      lo[a] = std::min(lo[a], mesh.Points[3 * static_cast<std::size_t>(p) + a]);
      hi[a] = std::max(hi[a], mesh.Points[3 * static_cast<std::size_t>(p) + a]);
    }
  }
  radius = 0;
  for (int a = 0; a < 3; ++a)
  {
    center[a] = lo[a] + 0.5 * (hi[a] - lo[a]);
    radius = std::hypot(radius, 0.5 * (hi[a] - lo[a]));
  }
}

/// Blue to red with a green peak, and as much opacity that the middle of the mesh is half seen.
TransferFunction MakeFunction(const std::vector<double>& scalars, double radius, double density)
{
  double lo = std::numeric_limits<double>::max();
  double hi = std::numeric_limits<double>::lowest();
  for (double s : scalars)
  {
    if (std::isfinite(s))
    {
      lo = std::min(lo, s);
      hi = std::max(hi, s);
    }
  }
  const double d = density / radius;
  const auto at = [&](double f) { return lo + f * (hi - lo); };
  return MakeLinearFunction({ { at(0), 0, 0, 1, 0 }, { at(0.15), 0, 1, 1, 0.1 * d },
    { at(0.3), 0, 1, 0, 2 * d }, { at(0.45), 1, 1, 0, 0.2 * d }, { at(1), 1, 0, 0, 4 * d } });
}

/// Sees the whole mesh from a direction that lies along nothing.
void LookAtAll(Scene& scene, int size = ImageSize)
{
  Vector center;
  double radius;
  GetBall(scene.Mesh, center, radius);
  const Vector position = { center[0] + 2.1 * radius, center[1] + 1.6 * radius,
    center[2] + 2.6 * radius };
  scene.Grid = MakePerspectiveGrid(position, center, { 0, 1, 0 }, 30, size, size);
}

/// Sees the whole mesh by the transfer function of its scalars.
void ShowAll(Scene& scene, double density)
{
  Vector center;
  double radius;
  GetBall(scene.Mesh, center, radius);
  scene.Function = MakeFunction(scene.Scalars, radius, density);
  LookAtAll(scene);
}

void CompareScene(const std::string& name, const Scene& scene)
{
  // Without the ids of the input, the tables lead back to the scene's own points and tetrahedra.
  TetrahedralMesh anonymous;
  anonymous.Points = scene.Mesh.Points;
  anonymous.Cells = scene.Mesh.Cells;
  auto mesh = std::make_shared<WalkMesh>(std::move(anonymous));
  std::vector<double> scalars;
  for (std::int64_t id :
    scene.CellScalars ? mesh->GetMesh().OriginalCells : mesh->GetMesh().OriginalPoints)
  {
    scalars.push_back(scene.Scalars[id]);
  }
  VolumeScene volume;
  volume.Mesh.SetMesh(mesh);
  if (scene.CellScalars)
  {
    volume.Mesh.SetCellScalars(scalars);
  }
  else
  {
    volume.Mesh.SetPointScalars(scalars);
  }
  volume.Optics.SetTransferFunction(scene.Function);
  const std::size_t pixels = static_cast<std::size_t>(scene.Grid.Width) * scene.Grid.Height;
  std::vector<float> colors(4 * pixels);
  std::vector<float> depths(pixels);
  const RayCastStatistics statistics =
    CastRays(volume, scene.Grid, scene.Limits, RayCastOptions(), colors, depths);

  const ReferenceMesh reference{ scene.Mesh.Points, scene.Mesh.Cells, scene.Scalars,
    scene.CellScalars };
  const ReferenceImage image = RenderReference(reference, scene.Function, scene.Grid, scene.Limits);
  // Whether a silhouette is grazed matters only where the picture is off.
  std::vector<std::uint8_t> off(pixels);
  bool any = false;
  for (std::size_t i = 0; i < pixels; ++i)
  {
    for (int c = 0; c < 4; ++c)
    {
      if (!(std::abs(colors[4 * i + c] - image.Rgba[4 * i + c]) <= WantedError))
      {
        off[i] = 1;
        any = true;
      }
    }
  }
  std::vector<double> grazing(pixels, 0.);
  if (any)
  {
    grazing = MeasureGrazing(reference, scene.Function, scene.Grid, scene.Limits, image, off);
  }
  const ImageComparison comparison = CompareWithReference(colors, image.Rgba, grazing);
  const ImageErrors& covered = comparison.Covered;
  const ImageErrors& ungrazed = comparison.Ungrazed;
  std::printf("%-34s %7zu tetrahedra  %s  covered %6zu  largest %.1e  rms %.1e  above 1e-4 "
              "%.4f %%  ungrazed largest %.1e  estimate %.1e\n",
    name.c_str(), scene.Mesh.GetNumberOfCells(), statistics.DoublePrecision ? "double" : "single",
    covered.NumberOfPixels, covered.Maximum, covered.RootMeanSquare, 100 * covered.ShareAbove1e4,
    ungrazed.Maximum, statistics.ErrorEstimate);
  EXPECT_GT(covered.NumberOfPixels, 1000u) << "the scene shows too little to say anything";
  EXPECT_LE(covered.ShareAbove1e4, 1 - WantedShare);
  EXPECT_LE(ungrazed.Maximum, 1. / 255);
}

Scene MakeGenerated(
  const std::string& name, const std::map<std::string, double>& parameters, double density)
{
  GeneratedMesh generated = GenerateMesh(name, parameters);
  Scene scene;
  scene.Mesh = std::move(generated.Mesh);
  scene.Scalars = std::move(generated.Scalars);
  ShowAll(scene, density);
  return scene;
}

class RealData : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const char* folder = std::getenv("TETRALUX_DATA");
    if (!folder)
    {
      GTEST_SKIP() << "TETRALUX_DATA does not name the folder of the data sets";
    }
    this->Folder = folder;
  }

  static Scene TakeIn(vtkDataObject* input, const std::string& array, bool cellData, double density)
  {
    TetrahedraIntake intake = TakeInTetrahedra(input);
    EXPECT_EQ(intake.Error, "");
    ScalarSelection selection;
    selection.ScalarMode =
      cellData ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
    selection.ArrayAccessMode = VTK_GET_ARRAY_BY_NAME;
    selection.ArrayName = array;
    ExtractedScalars scalars = ExtractScalars(input, intake.Mesh, selection);
    EXPECT_EQ(scalars.Error, "");
    Scene scene;
    scene.Mesh = std::move(intake.Mesh);
    scene.Scalars = std::move(scalars.Values);
    scene.CellScalars = cellData;
    ShowAll(scene, density);
    return scene;
  }

  Scene ReadBluntFin(double density) const
  {
    vtkNew<vtkMultiBlockPLOT3DReader> reader;
    reader->SetXYZFileName((this->Folder + "/bluntfinxyz.bin").c_str());
    reader->SetQFileName((this->Folder + "/bluntfinq.bin").c_str());
    reader->SetScalarFunctionNumber(100);
    reader->Update();
    return TakeIn(reader->GetOutput(), "Density", false, density);
  }

  std::string Folder;
};

TEST_F(RealData, BluntFinPerspective)
{
  CompareScene("blunt fin, perspective", this->ReadBluntFin(1));
}

TEST_F(RealData, BluntFinParallel)
{
  Scene scene = this->ReadBluntFin(1);
  scene.Grid =
    MakeParallelGrid({ 30, 25, 35 }, { 3.3, 4.2, 2.9 }, { 0, 1, 0 }, 9, ImageSize, ImageSize);
  CompareScene("blunt fin, parallel", scene);
}

TEST_F(RealData, BluntFinAlongAnAxis)
{
  // The grid's planes of constant z are flat: many faces are seen exactly from the side.
  Scene scene = this->ReadBluntFin(1);
  scene.Grid =
    MakeParallelGrid({ 3, 50, 2.9 }, { 3, 4, 2.9 }, { 0, 0, 1 }, 8, ImageSize, ImageSize);
  CompareScene("blunt fin, along the y axis", scene);
}

TEST_F(RealData, BluntFinFromInside)
{
  Scene scene = this->ReadBluntFin(1);
  const Vector position = { 3.3, 2, 1 };
  const Vector focus = { 5, 3, 5 };
  scene.Grid = MakePerspectiveGrid(position, focus, { 0, 1, 0 }, 70, ImageSize, ImageSize);
  AddClippingRange(scene.Limits, position, focus, 0.01, 1000);
  CompareScene("blunt fin, from inside", scene);
}

TEST_F(RealData, BluntFinOpticalDepth1e6)
{
  Scene scene = this->ReadBluntFin(1e6);
  LookAtAll(scene, SmallImageSize);
  CompareScene("blunt fin, optical depth x 1e6", scene);
}

TEST_F(RealData, ReactorHexahedra)
{
  vtkNew<vtkExodusIIReader> reader;
  reader->SetFileName((this->Folder + "/disk_out_ref.ex2").c_str());
  reader->UpdateInformation();
  reader->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
  reader->Update();
  CompareScene("disk_out_ref, Temp", TakeIn(reader->GetOutput(), "Temp", false, 1));
}

TEST_F(RealData, CanOfCellData)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((this->Folder + "/can.vtu").c_str());
  reader->Update();
  CompareScene("can, EQPS (cell data)", TakeIn(reader->GetOutput(), "EQPS", true, 1));
}

TEST(Generated, StraightAlongGridLines)
{
  // 64 cells over 512 pixels, shifted so that every eighth pixel's ray runs along a grid line; the
  // hull is out of sight, where a ray may count as inside or outside.
  Scene scene;
  scene.Mesh = MakeBox(66, 66, 8, { -1, -1, 0 }, { 65, 65, 8 });
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    const double* x = &scene.Mesh.Points[3 * p];
    scene.Scalars.push_back(std::sin(0.2 * x[0]) * std::cos(0.17 * x[1]) + 0.1 * x[2]);
  }
  scene.Function = MakeFunction(scene.Scalars, 8, 1);
  const double shift = 0.5 / 8;
  scene.Grid = MakeParallelGrid({ 32 - shift, 32 - shift, 50 }, { 32 - shift, 32 - shift, 0 },
    { 0, 1, 0 }, 32, ImageSize, ImageSize);
  CompareScene("rays along grid lines", scene);
}

TEST(Generated, OffsetOf1e4WithCellsOf1e4th)
{
  Scene scene = MakeGenerated("ball", { { "cells", 24 } }, 1);
  Vector center;
  double radius;
  GetBall(scene.Mesh, center, radius);
  const double scale = 1e-4 * 12 / radius; // 24 cells across
  for (std::size_t i = 0; i < scene.Mesh.Points.size(); ++i)
  {
    scene.Mesh.Points[i] = 1e4 + scale * scene.Mesh.Points[i];
  }
  scene.Function = MakeFunction(scene.Scalars, scale * radius, 1);
  LookAtAll(scene);
  CompareScene("offset 1e4, cells of 1e-4", scene);
}

TEST(Generated, BoundaryLayerOfEdgeRatio1e6)
{
  CompareScene("boundary layer, edge ratio 1e6", MakeGenerated("boundary-layer", {}, 1));
}

TEST(Generated, BoundaryLayerThatIsDenseWhereItIsThin)
{
  // So dense that the layers of 1e-6 decide the picture.
  Scene scene = MakeGenerated("boundary-layer", {}, 1e6);
  LookAtAll(scene, SmallImageSize);
  CompareScene("boundary layer, dense", scene);
}

TEST(Generated, Ring) { CompareScene("ring, re-entries", MakeGenerated("ring", {}, 1)); }

TEST(Generated, Cycle) { CompareScene("cyclic visibility", MakeGenerated("cycle", {}, 1)); }

} // namespace
} // namespace tetralux
