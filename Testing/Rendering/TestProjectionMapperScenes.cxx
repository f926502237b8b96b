// SPDX-License-Identifier: BSD-3-Clause
// Whole pictures of the projection mapper in best quality against the ray caster in double
// precision, which is right to 1e-6 (Testing/Accuracy): within 1/255 at every pixel, and 99.9 %
// within a quarter of that; but where cells hide each other in a cycle, which have no right order.
#include "RayCastScene.h"
#include "Statistics.h"

#include "Generate/GeneratedMeshes.h"
#include "ReferenceScenes.h"

#include "vtkCell.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkMeshedPolyhedraVisibilitySort.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiBlockPLOT3DReader.h"
#include "vtkPointData.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace
{

class SceneOfMesh
{
public:
  /// density: attenuation in units of 1 / radius.
  SceneOfMesh(vtkDataSet* grid, const double range[2], double density)
    : Input(grid)
  {
    const auto add = [&](double share, double red, double green, double blue, double attenuation)
    {
      const double scalar = range[0] + share * (range[1] - range[0]);
      this->Color->AddRGBPoint(scalar, red, green, blue);
      this->Opacity->AddPoint(scalar, attenuation / 4);
    };
    add(0, 0, 0, 1, 0);
    add(0.15, 0, 1, 1, 0.1);
    add(0.3, 0, 1, 0, 2);
    add(0.45, 1, 1, 0, 0.2);
    add(1, 1, 0, 0, 4);
    const double radius = 0.5 * grid->GetLength();
    this->Volume->GetProperty()->SetColor(this->Color);
    this->Volume->GetProperty()->SetScalarOpacity(this->Opacity);
    this->Volume->GetProperty()->SetScalarOpacityUnitDistance(radius / (4 * density));
    this->Renderer->AddVolume(this->Volume);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
    const double* center = grid->GetCenter();
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(center);
    camera->SetPosition(
      center[0] + 2.1 * radius, center[1] + 1.6 * radius, center[2] + 2.6 * radius);
    camera->SetViewAngle(30);
  }

  /// The whole picture is right: no cells hide each other in a cycle.
  void Expect()
  {
    const Picture picture = this->RenderAndCompare();
    ExpectPromised(picture.Errors);
    EXPECT_EQ(picture.NumberOfCycles, 0);
  }

  /// The picture is right but where cells of one cycle are seen through each other, and there it is
  /// a picture still. The mesh is of tetrahedra. Returns the largest error in the cycles.
  double ExpectCycles()
  {
    const Picture picture = this->RenderAndCompare();
    vtkNew<vtkMeshedPolyhedraVisibilitySort> sort;
    sort->SetInput(this->Input);
    sort->SetCamera(this->Renderer->GetActiveCamera());
    sort->SetModelTransform(this->Volume->GetMatrix());
    sort->InitTraversal();
    EXPECT_GE(picture.NumberOfCycles, 1);
    EXPECT_EQ(picture.NumberOfCycles, sort->GetNumberOfCycles());

    const std::vector<bool> inCycle = this->FindPixelsOfCycles(sort);
    std::vector<double> outside;
    double largest = 0;
    for (std::size_t pixel = 0; pixel < inCycle.size(); ++pixel)
    {
      if (!inCycle[pixel])
      {
        outside.push_back(picture.Errors[pixel]);
        continue;
      }
      largest = std::max(largest, picture.Errors[pixel]);
      for (std::size_t c = 4 * pixel; c < 4 * pixel + 4; ++c)
      {
        EXPECT_TRUE(0 <= picture.Colors[c] && picture.Colors[c] <= 1) << picture.Colors[c];
      }
    }
    ExpectPromised(outside);
    return largest;
  }

  vtkNew<vtkRenderer> Renderer;

private:
  static constexpr int Size = 128;
  static constexpr double Uncovered = -1;

  struct Picture
  {
    std::vector<float> Colors;
    std::vector<double> Errors; ///< of each pixel's worst channel, 1/255; Uncovered: both empty
    vtkIdType NumberOfCycles = 0;
  };

  Picture RenderAndCompare()
  {
    vtkNew<vtkTetrahedraRayCastMapper> reference;
    reference->SetPrecisionToDouble();
    reference->SetMaximumError(1e-6);
    reference->AutoAdjustSampleDistancesOff();
    const std::vector<float> expected = this->Render(reference);
    vtkNew<vtkTetrahedraProjectionMapper> mapper;
    Picture picture;
    picture.Colors = this->Render(mapper);
    EXPECT_EQ(picture.Colors.size(), expected.size());
    for (std::size_t pixel = 0; pixel < expected.size() / 4; ++pixel)
    {
      double error = 0;
      bool covered = false;
      for (std::size_t c = 4 * pixel; c < 4 * pixel + 4; ++c)
      {
        covered = covered || expected[c] > 0;
        error = std::max(error, std::abs(static_cast<double>(picture.Colors[c]) - expected[c]));
      }
      picture.Errors.push_back(covered || error > 0 ? 255 * error : Uncovered);
    }
    picture.NumberOfCycles = std::stoi(GetStatistic(mapper, "cycles"));
    return picture;
  }

  static void ExpectPromised(std::vector<double> errors)
  {
    errors.erase(std::remove(errors.begin(), errors.end(), Uncovered), errors.end());
    ASSERT_GT(errors.size(), 1000u);
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(errors.back(), 1);
    EXPECT_LE(errors[static_cast<std::size_t>(0.999 * static_cast<double>(errors.size()))], 0.25);
  }

  /// Where at least two cells of the same cycle are: what lies within one cell has no order.
  std::vector<bool> FindPixelsOfCycles(vtkMeshedPolyhedraVisibilitySort* sort)
  {
    std::vector<bool> found(Size * Size, false);
    vtkNew<vtkIdList> cells;
    for (vtkIdType cycle = 0; cycle < sort->GetNumberOfCycles(); ++cycle)
    {
      sort->GetCycle(cycle, cells);
      std::vector<int> covers(found.size(), 0);
      for (vtkIdType i = 0; i < cells->GetNumberOfIds(); ++i)
      {
        this->CountPixels(cells->GetId(i), covers);
      }
      for (std::size_t pixel = 0; pixel < found.size(); ++pixel)
      {
        found[pixel] = found[pixel] || covers[pixel] >= 2;
      }
    }
    return found;
  }

  /// Adds one to each pixel whose center is in a cell's shadow on the screen.
  void CountPixels(vtkIdType cell, std::vector<int>& covers)
  {
    vtkMatrix4x4* project =
      this->Renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(1, -1, 1);
    vtkPoints* points = this->Input->GetCell(cell)->GetPoints();
    double corners[4][2];
    for (int corner = 0; corner < 4; ++corner)
    {
      double x[4] = { 0, 0, 0, 1 };
      points->GetPoint(corner, x);
      project->MultiplyPoint(x, x);
      ASSERT_GT(x[3], 0); // in front of the camera
      corners[corner][0] = Size * (0.5 + 0.5 * x[0] / x[3]) - 0.5;
      corners[corner][1] = Size * (0.5 + 0.5 * x[1] / x[3]) - 0.5;
    }
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const double p[2] = { static_cast<double>(pixel % Size), static_cast<double>(pixel / Size) };
      const auto isInFace = [&](int dropped)
      {
        int sides[2] = { 0, 0 };
        for (int k = 0; k < 3; ++k)
        {
          const double* a = corners[(dropped + 1 + k) % 4];
          const double* b = corners[(dropped + 1 + (k + 1) % 3) % 4];
          ++sides[(a[0] - p[0]) * (b[1] - p[1]) > (a[1] - p[1]) * (b[0] - p[0])];
        }
        return sides[0] == 0 || sides[1] == 0;
      };
      covers[pixel] += isInFace(0) || isInFace(1) || isInFace(2) || isInFace(3);
    }
  }

  std::vector<float> Render(vtkTetrahedraVolumeMapper* mapper)
  {
    mapper->SetInputData(this->Input);
    this->Volume->SetMapper(mapper);
    this->Renderer->ResetCameraClippingRange();
    this->Window->Render();
    auto* colors =
      vtkFloatArray::SafeDownCast(mapper->GetOutputImage()->GetPointData()->GetArray("RGBA"));
    return { colors->GetPointer(0), colors->GetPointer(0) + colors->GetNumberOfValues() };
  }

  vtkSmartPointer<vtkDataSet> Input;
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkHeadlessRenderWindow> Window;
};

void ExpectGenerated(
  const std::string& name, const std::map<std::string, double>& parameters, double density)
{
  const tetralux::GeneratedMesh generated = tetralux::GenerateMesh(name, parameters);
  const auto [lo, hi] = std::minmax_element(generated.Scalars.begin(), generated.Scalars.end());
  const double range[2] = { *lo, *hi };
  SceneOfMesh scene(MakeGrid(generated.Mesh, generated.Scalars), range, density);
  scene.Expect();
}

TEST(ProjectionMapperScenes, Ring)
{
  ExpectGenerated("ring", { { "around", 60 }, { "across", 6 } }, 1);
}

TEST(ProjectionMapperScenes, HeatSink)
{
  ExpectGenerated("heat-sink", { { "fins", 5 }, { "cells", 2 } }, 1);
}

TEST(ProjectionMapperScenes, BoundaryLayerOfEdgeRatio1e6)
{
  ExpectGenerated("boundary-layer", { { "cells", 12 }, { "layers", 24 } }, 1);
}

TEST(ProjectionMapperScenes, BoundaryLayerThatIsDenseWhereItIsThin)
{
  ExpectGenerated("boundary-layer", { { "cells", 12 }, { "layers", 24 } }, 1e6);
}

TEST(ProjectionMapperScenes, CellsThatHideEachOtherInACycle)
{
  // Nearly opaque, each of a color of its own, and behind them, all over the picture, cells that
  // hide nothing of them.
  tetralux::TetrahedralMesh mesh = tetralux::MakeCyclicTetrahedra(3);
  std::vector<double> scalars;
  for (const double scalar : { 0.3, 0.65, 1. })
  {
    scalars.insert(scalars.end(), 4, scalar);
  }
  const tetralux::TetrahedralMesh box =
    tetralux::MakeBox(8, 8, 2, { -4, -4, -3 }, { 4, 4, -2 }, 0.1);
  const auto firstPoint = static_cast<std::int32_t>(mesh.GetNumberOfPoints());
  for (const std::int32_t point : box.Cells)
  {
    mesh.Cells.push_back(firstPoint + point);
  }
  mesh.Points.insert(mesh.Points.end(), box.Points.begin(), box.Points.end());
  for (std::size_t point = 0; point < box.GetNumberOfPoints(); ++point)
  {
    scalars.push_back(0.125 * (box.Points[3 * point] + 4));
  }

  const double range[2] = { 0, 1 };
  SceneOfMesh scene(MakeGrid(mesh, scalars), range, 60);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  double largest = 0;
  for (const bool parallel : { false, true })
  {
    camera->SetParallelProjection(parallel);
    camera->SetParallelScale(2.2);
    for (const Vector& position : { Vector{ 0.01, 0.02, 9 }, Vector{ 0.5, -0.4, 8 } })
    {
      camera->SetPosition(position.data());
      largest = std::max(largest, scene.ExpectCycles());
    }
  }
  // Else the test would prove nothing.
  EXPECT_GT(largest, 64);
}

TEST(ProjectionMapperScenes, BluntFin)
{
  const char* folder = std::getenv("TETRALUX_DATA");
  if (!folder)
  {
    GTEST_SKIP() << "TETRALUX_DATA does not name the folder of the data sets";
  }
  vtkNew<vtkMultiBlockPLOT3DReader> reader;
  reader->SetXYZFileName((std::string(folder) + "/bluntfinxyz.bin").c_str());
  reader->SetQFileName((std::string(folder) + "/bluntfinq.bin").c_str());
  reader->SetScalarFunctionNumber(100);
  reader->Update();
  auto* grid = vtkDataSet::SafeDownCast(reader->GetOutput()->GetBlock(0));
  grid->GetPointData()->SetActiveScalars("Density");
  double range[2];
  grid->GetPointData()->GetArray("Density")->GetRange(range);
  SceneOfMesh scene(grid, range, 1);
  scene.Expect();

  // From inside, and along an axis, where many faces are seen exactly from the side.
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(3.3, 2, 1);
  camera->SetFocalPoint(5, 3, 5);
  camera->SetViewAngle(70);
  scene.Expect();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(8);
  camera->SetPosition(3, 50, 2.9);
  camera->SetFocalPoint(3, 4, 2.9);
  camera->SetViewUp(0, 0, 1);
  scene.Expect();
}

} // namespace
