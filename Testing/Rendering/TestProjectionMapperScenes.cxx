// SPDX-License-Identifier: BSD-3-Clause
// Whole pictures of the projection mapper in best quality against the ray caster in double precision,
// which is right to 1e-6 (Testing/Accuracy): within 1/255 at every pixel, and 99.9 % within a quarter
// of that.
#include "RayCastScene.h"

#include "GeneratedMeshes.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
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

  void Expect()
  {
    vtkNew<vtkTetrahedraRayCastMapper> reference;
    reference->SetPrecisionToDouble();
    reference->SetMaximumError(1e-6);
    reference->AutoAdjustSampleDistancesOff();
    const std::vector<float> expected = this->Render(reference);
    vtkNew<vtkTetrahedraProjectionMapper> mapper;
    const std::vector<float> found = this->Render(mapper);
    ASSERT_EQ(found.size(), expected.size());
    std::vector<double> errors;
    for (std::size_t pixel = 0; pixel < expected.size() / 4; ++pixel)
    {
      double error = 0;
      bool covered = false;
      for (std::size_t c = 4 * pixel; c < 4 * pixel + 4; ++c)
      {
        covered = covered || expected[c] > 0;
        error = std::max(error, std::abs(static_cast<double>(found[c]) - expected[c]));
      }
      if (covered || error > 0)
      {
        errors.push_back(255 * error);
      }
    }
    ASSERT_GT(errors.size(), 1000u);
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(errors.back(), 1);
    EXPECT_LE(errors[static_cast<std::size_t>(0.999 * static_cast<double>(errors.size()))], 0.25);
    EXPECT_NE(mapper->GetStatistics().find("\"cycles\": 0"), std::string::npos);
  }

  vtkNew<vtkRenderer> Renderer;

private:
  static constexpr int Size = 128;

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
