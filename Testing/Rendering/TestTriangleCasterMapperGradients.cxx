// SPDX-License-Identifier: BSD-3-Clause
// Stored gradients, maps of intensities, tables over gradients and depth cues of the mapper of
// image data. The caster itself has tests of its own.
#include "ImageScene.h"
#include "Observer.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkLight.h"
#include "vtkPointData.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace
{

/// Of a channel: gradients that are rounded to 1/127 of the largest component.
constexpr double ByteError = 0.03;

/// Of a channel: light between directions that are a 16th apart on the faces of a cube.
constexpr double MapError = 0.03;

/// What a scene complains of, in one frame.
std::string RenderMessages(ImageScene& scene)
{
  const MessageObserver messages(scene.Mapper);
  scene.Mapper->Render(scene.Renderer, scene.Volume);
  return messages.Text;
}

/// A table that shows scalars of large gradients in another colour.
vtkSmartPointer<vtkImageData> MakeTable(int columns, int rows)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  image->AllocateScalars(VTK_FLOAT, 4);
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    const double x = static_cast<double>(p % columns) / (columns - 1);
    const double y = static_cast<double>(p / columns) / (rows - 1);
    // VTK's mapper takes opacities as they are, however short the distance of samples is.
    image->GetPointData()->GetScalars()->SetTuple4(p, x, 1 - y, 0.2 + 0.8 * y, 0.004 * x * x);
  }
  return image;
}

TEST(TriangleCasterMapperGradients, TableIsThatOfVTK)
{
  constexpr double Distance = 0.02;
  // Of 255 steps. Where no entry depends on gradients it is 1. VTK's gradients at the border are
  // half as long, since its textures repeat their last values there.
  constexpr int Tolerance = 7;
  ImageScene scene;
  scene.Mapper->SetSampleDistance(Distance);
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  property->SetScalarOpacityUnitDistance(Distance);
  property->SetTransferFunctionMode(vtkVolumeProperty::TF_2D);
  property->SetTransferFunction2D(MakeTable(64, 32));
  scene.Window->Render();
  const std::vector<int> picture = scene.Grab();
  const std::vector<int> expected = GrabOfVTK(scene);
  EXPECT_EQ(FindShareAbove(picture, expected, Tolerance), 0);
}

TEST(TriangleCasterMapperGradients, TablesAreOfTheProperty)
{
  ImageScene scene;
  scene.Window->Render();
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  const auto expect = [&](const char* text)
  {
    const std::string message = RenderMessages(scene);
    EXPECT_NE(message.find(text), std::string::npos) << text << ": " << message;
    EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 0);
  };
  property->SetTransferFunctionMode(vtkVolumeProperty::TF_2D);
  expect("no TransferFunction2D");
  property->SetTransferFunction2D(MakeTable(3, 1));
  expect("fewer than 2 columns or rows");
  const vtkSmartPointer<vtkImageData> table = MakeTable(8, 4);
  property->SetTransferFunction2D(table);
  property->SetScalarOpacityUnitDistance(0.02);
  const std::vector<float> before = scene.Render();
  auto* entries = vtkFloatArray::SafeDownCast(table->GetPointData()->GetScalars());
  entries->FillComponent(0, 0);
  table->Modified();
  std::vector<float> expected = before;
  for (std::size_t i = 0; i < expected.size(); i += 4)
  {
    expected[i] = 0;
  }
  EXPECT_EQ(scene.Render(), expected);
  scene.Mapper->SetBlendModeToMaximumIntensity();
  expect("composite blending has only");
}

TEST(TriangleCasterMapperGradients, StoredOnesAreNearToOthers)
{
  ImageScene scene;
  vtkNew<vtkPiecewiseFunction> gradients;
  gradients->AddPoint(0, 0);
  gradients->AddPoint(20, 1);
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  property->SetGradientOpacity(gradients);
  property->ShadeOn();
  const std::vector<float> expected = scene.Render();
  EXPECT_EQ(scene.Get("gradient_source"), "\"on-the-fly\"");
  scene.Mapper->SetGradientSourceToBytes();
  const double difference = FindDifference(scene.Render(), expected);
  EXPECT_EQ(scene.Get("gradient_source"), "\"bytes\"");
  EXPECT_GT(difference, 0);
  EXPECT_LE(difference, ByteError);
}

TEST(TriangleCasterMapperGradients, MapsOfIntensitiesAreNearToSums)
{
  ImageScene scene;
  scene.Volume->GetProperty()->ShadeOn();
  const std::vector<float> expected = scene.Render();
  scene.Mapper->SetLightSumToNearestEntry();
  const double nearest = FindDifference(scene.Render(), expected);
  scene.Mapper->SetLightSumToInterpolated();
  const double interpolated = FindDifference(scene.Render(), expected);
  EXPECT_EQ(scene.Get("light_sum"), "\"interpolated\"");
  EXPECT_GT(interpolated, 0);
  EXPECT_LT(interpolated, nearest);
  EXPECT_LE(nearest, MapError);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetLightTypeToSceneLight();
  scene.Renderer->AddLight(lamp);
  EXPECT_NE(RenderMessages(scene).find("distant lights only"), std::string::npos);
}

TEST(TriangleCasterMapperGradients, DepthCuesAreFactorsOfColours)
{
  constexpr double Rounding = 1e-6; // of a channel
  ImageScene scene(48, 36);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(10);
  camera->SetPosition(6.5, 5, 30);
  camera->SetFocalPoint(6.5, 5, 4);
  camera->SetViewUp(0, 1, 0);
  scene.Mapper->SetInputData(MakeConstantImage(60));
  scene.Mapper->SetMaximumError(0);
  scene.Mapper->SetSampleDistance(8); // one sample, in the middle of the volume
  const std::vector<float> plain = scene.Render();
  const auto expect = [&](const std::array<double, 4>& factors)
  {
    std::vector<float> expected = plain;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      expected[i] *= static_cast<float>(factors[i % 4]);
    }
    EXPECT_LE(FindDifference(scene.Render(), expected), Rounding);
  };
  scene.Mapper->SetNearColor(1, 0.5, 0.25);
  expect({ 1, 0.75, 0.625, 1 });
  scene.Mapper->SetFarColor(0, 0.5, 0.75);
  expect({ 0.5, 0.5, 0.5, 1 });
  scene.Mapper->PreIntegrationOn();
  expect({ 0.5, 0.5, 0.5, 1 });
}

} // namespace
