// SPDX-License-Identifier: BSD-3-Clause
// What the mapper of image data rebuilds, how it gets into a window, what it refuses and reports.
#include "ImageScene.h"
#include "Observer.h"
#include "OpenGLSnapshot.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkHardwareSelector.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSelection.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace
{

const char* const Nothing = "[]";
const char* const Scalars = "[\"scalars\"]";
const char* const Function = "[\"transfer function\"]";

std::string RenderAndGetRebuilt(ImageScene& scene)
{
  scene.Window->Render();
  return scene.Get("rebuilt");
}

/// The picture of a part of the scene's image.
std::vector<float> RenderPart(ImageScene& scene, std::array<int, 6> extent)
{
  vtkNew<vtkImageData> part;
  part->DeepCopy(MakeImage());
  part->Crop(extent.data());
  scene.Mapper->SetInputData(part);
  return scene.Render();
}

TEST(TriangleCasterMapperBehavior, PartsCompositeToTheWhole)
{
  constexpr double Largest = 1e-6; // rounding of single precision, some times
  ImageScene scene;
  scene.Mapper->SetSampleDistance(0); // which follows from the number of points
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(40, 12, 14);
  camera->SetFocalPoint(6.5, 5, 4);
  scene.Renderer->ResetCameraClippingRange();
  const std::array<int, 6> all = { 0, ImageSize[0] - 1, 0, ImageSize[1] - 1, 0, ImageSize[2] - 1 };
  const std::vector<float> whole = scene.Render();
  const std::string distance = scene.Get("distance");

  std::array<int, 6> far = all;
  std::array<int, 6> near = all;
  far[1] = near[0] = 6;
  RenderPart(scene, far);
  EXPECT_NE(scene.Get("distance"), distance);
  scene.Mapper->SetWholeExtent(all.data());
  const std::vector<float> behind = RenderPart(scene, far);
  EXPECT_EQ(scene.Get("distance"), distance);
  std::vector<float> sum = RenderPart(scene, near);
  EXPECT_GT(FindDifference(sum, whole), Largest);
  for (std::size_t i = 0; i < sum.size(); i += 4)
  {
    const float transmittance = 1 - sum[i + 3];
    for (std::size_t channel = 0; channel < 4; ++channel)
    {
      sum[i + channel] += transmittance * behind[i + channel];
    }
  }
  EXPECT_LT(FindDifference(sum, whole), Largest);
}

TEST(TriangleCasterMapperBehavior, KeepsTheDistanceThatItChose)
{
  ImageScene scene;
  scene.Mapper->SampleDistanceByErrorOn();
  scene.Mapper->SetMaximumError(1e-2);
  const std::string distance = "[\"distance of slices\"]";
  EXPECT_EQ(
    RenderAndGetRebuilt(scene), "[\"scalars\",\"transfer function\",\"distance of slices\"]");
  const std::string chosen = scene.Get("distance");
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  EXPECT_EQ(scene.Get("distance"), chosen);
  scene.Mapper->SetTileSize(16);
  scene.Mapper->SetNumberOfThreads(2);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);

  scene.Renderer->GetActiveCamera()->Azimuth(10);
  EXPECT_EQ(RenderAndGetRebuilt(scene), distance);
  scene.Mapper->SetMaximumError(1e-3);
  EXPECT_EQ(RenderAndGetRebuilt(scene), distance);
  scene.Mapper->SetSampleDistance(1.5);
  EXPECT_EQ(RenderAndGetRebuilt(scene), distance);
  scene.Mapper->SetFarColor(0.5, 0.5, 0.5);
  EXPECT_EQ(RenderAndGetRebuilt(scene), distance);
  scene.AddSphere(6, 5, 4, 2);
  EXPECT_EQ(RenderAndGetRebuilt(scene), distance);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);

  // What changes while another distance is used.
  scene.Mapper->SampleDistanceByErrorOff();
  scene.Opacity->AddPoint(50, 0.9);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Mapper->SampleDistanceByErrorOn();
  EXPECT_EQ(RenderAndGetRebuilt(scene), distance);
}

TEST(TriangleCasterMapperBehavior, RebuildsWhatChanged)
{
  ImageScene scene;
  const vtkSmartPointer<vtkImageData> image = MakeImage(VTK_DOUBLE);
  scene.Mapper->SetInputData(image);
  EXPECT_EQ(RenderAndGetRebuilt(scene), "[\"scalars\",\"transfer function\"]");

  // Nothing that frames differ in.
  scene.Renderer->GetActiveCamera()->Azimuth(10);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  scene.Volume->SetScale(1.1, 1, 1);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  vtkNew<vtkPlane> plane;
  scene.Mapper->AddClippingPlane(plane);
  scene.Mapper->SetMaximumError(1e-3);
  scene.Mapper->SetSampleDistance(0.7);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  image->SetSpacing(1, 1, 2);
  image->SetOrigin(1, 0, 0);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);

  // Scalars.
  auto* field = vtkDoubleArray::SafeDownCast(image->GetPointData()->GetScalars());
  field->SetValue(0, 70);
  field->Modified();
  EXPECT_EQ(RenderAndGetRebuilt(scene), Scalars);
  vtkNew<vtkDoubleArray> other;
  other->DeepCopy(field);
  other->SetName("Other");
  image->GetPointData()->AddArray(other);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  image->GetPointData()->SetActiveScalars("Other");
  EXPECT_EQ(RenderAndGetRebuilt(scene), Scalars);
  scene.Mapper->SetVectorModeToComponent();
  EXPECT_EQ(RenderAndGetRebuilt(scene), Scalars);
  image->SetExtent(0, ImageSize[0] - 1, 0, ImageSize[2] - 1, 0, ImageSize[1] - 1);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Scalars);

  // Transfer function.
  scene.Opacity->AddPoint(70, 0.2);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Color->AddRGBPoint(70, 1, 1, 1);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(1);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Mapper->SetOpacityModelToAttenuation();
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  vtkNew<vtkPiecewiseFunction> gradients;
  gradients->AddPoint(0, 1);
  scene.Volume->GetProperty()->SetGradientOpacity(gradients);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing); // it changes nothing
  gradients->AddPoint(5, 0.5);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Mapper->SetGradientNormToSum();
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Volume->GetProperty()->ShadeOn();
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  // What has to be approximated follows MaximumError.
  scene.Color->SetColorSpaceToLab();
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Mapper->SetMaximumError(1e-2);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  EXPECT_GT(std::stod(scene.Get("transfer_function")), 0);
}

// Values that are read in place may be replaced behind VTK's back.
TEST(TriangleCasterMapperBehavior, ReadsValuesWhereTheyAre)
{
  ImageScene scene;
  const vtkSmartPointer<vtkImageData> image = MakeImage(VTK_UNSIGNED_CHAR);
  scene.Mapper->SetInputData(image);
  const std::vector<float> before = scene.Render();
  auto* values = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  std::vector<unsigned char> replaced(values->GetNumberOfValues());
  for (std::size_t i = 0; i < replaced.size(); ++i)
  {
    replaced[i] = static_cast<unsigned char>(100 - values->GetValue(static_cast<vtkIdType>(i)));
  }
  values->SetArray(replaced.data(), static_cast<vtkIdType>(replaced.size()), 1);
  const std::vector<float> after = scene.Render();
  EXPECT_GT(FindDifference(after, before), 0.1);
  ImageScene fresh;
  vtkSmartPointer<vtkImageData> copy = MakeImage(VTK_UNSIGNED_CHAR);
  copy->GetPointData()->GetScalars()->DeepCopy(values);
  fresh.Mapper->SetInputData(copy);
  EXPECT_EQ(fresh.Render(), after);
}

TEST(TriangleCasterMapperBehavior, PictureDoesNotDependOnThreads)
{
  ImageScene scene;
  scene.Mapper->SetNumberOfThreads(1);
  const std::vector<float> one = scene.Render();
  const std::vector<float> depths = scene.GetDepths();
  for (const int threads : { 2, 3, 8 })
  {
    scene.Mapper->SetNumberOfThreads(threads);
    const std::vector<float> other = scene.Render();
    EXPECT_EQ(scene.Get("threads"), std::to_string(threads));
    ASSERT_EQ(other.size(), one.size());
    EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(float)), 0);
    EXPECT_EQ(scene.GetDepths(), depths);
  }
}

// The window shows the picture over the background, rounded to 8 bits.
TEST(TriangleCasterMapperBehavior, CompositesOverTheBackground)
{
  ImageScene scene(120, 100);
  scene.Renderer->SetViewport(0.2, 0.2, 0.9, 1);
  const double background[3] = { 0.2, 0.6, 0.4 };
  scene.Renderer->SetBackground(background[0], background[1], background[2]);
  const std::vector<float> picture = scene.Render();
  const std::vector<int> shown = scene.Grab();
  ASSERT_EQ(picture.size(), 4u * 84 * 80);
  double largest = 0;
  for (int j = 0; j < 80; ++j)
  {
    for (int i = 0; i < 84; ++i)
    {
      const float* rgba = picture.data() + 4 * (84 * j + i);
      for (int c = 0; c < 3; ++c)
      {
        const double expected = rgba[c] + (1 - rgba[3]) * std::round(background[c] * 255) / 255;
        const int pixel = shown[3 * (120 * (20 + j) + 24 + i) + c];
        largest = std::max(largest, std::abs(pixel - 255 * expected));
      }
    }
  }
  // Half a step each by rounding what is blended and the result, and as much by blending in 8 bits.
  EXPECT_LE(largest, 1.5);
}

// Two renderers in a window, as stereo in two halves has them, each with a camera of its own.
TEST(TriangleCasterMapperBehavior, SeveralViewports)
{
  ImageScene scene(96, 72);
  ImageScene left(48, 72);
  vtkNew<vtkCamera> camera;
  camera->DeepCopy(scene.Renderer->GetActiveCamera());
  camera->Azimuth(8);
  left.Renderer->SetActiveCamera(camera);
  left.Window->Render();
  const std::vector<int> expected = left.Grab();

  scene.Renderer->SetViewport(0.5, 0, 1, 1);
  vtkNew<vtkRenderer> renderer;
  renderer->SetViewport(0, 0, 0.5, 1);
  renderer->AddVolume(scene.Volume);
  renderer->SetActiveCamera(camera);
  scene.Window->AddRenderer(renderer);
  scene.Window->Render();
  const std::vector<int> both = scene.Grab();
  int largest = 0;
  for (int j = 0; j < 72; ++j)
  {
    for (int i = 0; i < 3 * 48; ++i)
    {
      largest = std::max(largest, std::abs(both[3 * 96 * j + i] - expected[3 * 48 * j + i]));
    }
  }
  EXPECT_LE(largest, 1);
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 100);
}

// The eyes of a stereo pair are those of two cameras beside each other.
TEST(TriangleCasterMapperBehavior, Stereo)
{
  ImageScene scene;
  scene.Window->StereoCapableWindowOn();
  scene.Window->SetStereoTypeToRight();
  const std::vector<float> none = scene.Render();
  scene.Window->StereoRenderOn();
  const std::vector<float> right = scene.Render();
  scene.Window->SetStereoTypeToLeft();
  const std::vector<float> left = scene.Render();
  EXPECT_GT(FindDifference(right, left), 0.01);
  EXPECT_GT(FindDifference(right, none), 0.005);
}

TEST(TriangleCasterMapperBehavior, TilesMakeOnePicture)
{
  ImageScene scene(60, 50);
  scene.Renderer->SetBackground(0.2, 0.3, 0.4);
  vtkNew<vtkWindowToImageFilter> tiles;
  tiles->SetInput(scene.Window);
  tiles->SetScale(2);
  tiles->Update();
  scene.Window->SetSize(120, 100);
  vtkNew<vtkWindowToImageFilter> whole;
  whole->SetInput(scene.Window);
  whole->Update();
  ASSERT_EQ(tiles->GetOutput()->GetNumberOfPoints(), whole->GetOutput()->GetNumberOfPoints());
  const auto* a = static_cast<const unsigned char*>(tiles->GetOutput()->GetScalarPointer());
  const auto* b = static_cast<const unsigned char*>(whole->GetOutput()->GetScalarPointer());
  int largest = 0;
  for (vtkIdType i = 0; i < 3 * whole->GetOutput()->GetNumberOfPoints(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  EXPECT_LE(largest, 1);
}

TEST(TriangleCasterMapperBehavior, DistanceOfRays)
{
  ImageScene scene(80, 60);
  scene.Mapper->SetImageSampleDistance(2);
  const std::vector<float> coarse = scene.Render();
  EXPECT_EQ(scene.Mapper->GetOutputImage()->GetDimensions()[0], 40);
  scene.Mapper->SetImageSampleDistance(1);
  scene.Window->SetSize(40, 30);
  EXPECT_LE(FindDifference(scene.Render(), coarse), 1e-6);

  // By the time that there is.
  scene.Window->SetSize(80, 60);
  scene.Mapper->AutoAdjustSampleDistancesOn();
  scene.Mapper->SetMaximumImageSampleDistance(5);
  scene.Window->SetDesiredUpdateRate(1e9);
  scene.Window->Render();
  scene.Window->Render();
  EXPECT_EQ(scene.Get("sample_distance"), "5.0");
  scene.Window->SetDesiredUpdateRate(1e-4);
  scene.Window->Render();
  EXPECT_EQ(scene.Get("sample_distance"), "1.0");
}

TEST(TriangleCasterMapperBehavior, AbortedFramesAreNotDrawn)
{
  ImageScene scene;
  scene.Renderer->SetBackground(0, 0, 1);
  bool abort = true;
  int events = 0;
  const Observer progress(scene.Mapper, vtkCommand::VolumeMapperRenderProgressEvent,
    [&](const char*)
    {
      ++events;
      scene.Window->SetAbortRender(abort);
    });
  scene.Mapper->SetNumberOfThreads(1); // which reports every tile
  scene.Window->Render();
  EXPECT_EQ(events, 1);
  EXPECT_EQ(scene.Get("aborted"), "true");
  const std::vector<int> shown = scene.Grab();
  for (std::size_t i = 0; i < shown.size(); ++i)
  {
    ASSERT_EQ(shown[i], i % 3 == 2 ? 255 : 0);
  }
  abort = false;
  scene.Window->Render();
  EXPECT_EQ(scene.Get("aborted"), "false");
  EXPECT_NE(scene.Grab(), shown);
}

TEST(TriangleCasterMapperBehavior, InvokesEvents)
{
  ImageScene scene;
  std::vector<std::string> events;
  std::vector<double> fractions;
  const Observer start(scene.Mapper, vtkCommand::VolumeMapperRenderStartEvent,
    [&](const char*) { events.emplace_back("start"); });
  const Observer end(scene.Mapper, vtkCommand::VolumeMapperRenderEndEvent,
    [&](const char*)
    {
      events.emplace_back("end");
      EXPECT_GT(scene.Mapper->GetTimeToDraw(), 0);
    });
  const Observer progress(scene.Mapper, vtkCommand::VolumeMapperRenderProgressEvent,
    [&](const char* data)
    {
      double fraction;
      std::memcpy(&fraction, data, sizeof(fraction));
      fractions.push_back(fraction);
    });
  scene.Mapper->SetNumberOfThreads(1);
  scene.Window->Render();
  EXPECT_EQ(events, (std::vector<std::string>{ "start", "end" }));
  ASSERT_GT(fractions.size(), 1u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_DOUBLE_EQ(fractions.back(), 1);
}

TEST(TriangleCasterMapperBehavior, LeavesOpenGLAsItWas)
{
  ImageScene scene;
  scene.Window->Render(); // makes the context
  OpenGLSnapshot before;
  OpenGLSnapshot after;
  const Observer start(scene.Mapper, vtkCommand::VolumeMapperRenderStartEvent,
    [&](const char*) { before = TakeOpenGLSnapshot(scene.Window); });
  const Observer end(scene.Mapper, vtkCommand::VolumeMapperRenderEndEvent,
    [&](const char*) { after = TakeOpenGLSnapshot(scene.Window); });
  scene.Renderer->PreserveDepthBufferOn(); // so that depths are read
  scene.Window->Render();
  ASSERT_FALSE(before.empty());
  EXPECT_EQ(FindDifferences(before, after), "");
}

TEST(TriangleCasterMapperBehavior, SeveralWindows)
{
  vtkNew<vtkTriangleCasterMapper> mapper;
  mapper->SetInputData(MakeImage());
  mapper->SetSampleDistance(0.5);
  ImageScene first;
  const std::vector<float> expected = first.Render();
  const std::vector<int> shown = first.Grab();
  ImageScene second;
  for (ImageScene* scene : { &first, &second, &first })
  {
    scene->Volume->SetMapper(mapper);
    scene->Window->Render();
    EXPECT_EQ(scene->Grab(), shown);
  }
  second.Window->Finalize();
  mapper->ReleaseGraphicsResources(first.Window);
  first.Window->Render();
  EXPECT_EQ(first.Grab(), shown);
}

TEST(TriangleCasterMapperBehavior, DoesNotDisturbSelection)
{
  ImageScene scene;
  scene.AddSphere(-1, -1.5, -8, 6); // behind the middle of the volume
  const std::vector<float> before = scene.Render();
  EXPECT_GT(before[4 * (36 * 96 + 48) + 3], 0.1); // there is volume
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(45, 33, 51, 39);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_EQ(selection->GetNumberOfNodes(), 1u);
  EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 96 * 72);
}

TEST(TriangleCasterMapperBehavior, ReportsAnErrorOnce)
{
  ImageScene scene;
  int errors = 0;
  std::string text;
  const Observer observer(scene.Mapper, vtkCommand::ErrorEvent,
    [&](const char* message)
    {
      ++errors;
      text = message;
    });
  scene.Mapper->SetScalarModeToUsePointFieldData();
  scene.Mapper->SelectScalarArray("Pressure");
  scene.Window->Render();
  scene.Window->Render();
  EXPECT_EQ(errors, 1);
  EXPECT_NE(text.find("Pressure"), std::string::npos) << text;
  EXPECT_NE(text.find("point arrays: Field"), std::string::npos) << text;
  EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 0);
  EXPECT_EQ(scene.Mapper->GetStatistics(), "{}");
  scene.Mapper->SelectScalarArray("Field");
  scene.Window->Render();
  EXPECT_EQ(errors, 1);
  EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 96 * 72);
}

/// The image of a scene's mapper.
vtkImageData* GetImage(ImageScene& scene)
{
  return vtkImageData::SafeDownCast(scene.Mapper->GetDataObjectInput());
}

void AddGhosts(vtkDataSetAttributes* attributes, vtkIdType count, unsigned char flag)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(count);
  ghosts->Fill(0);
  ghosts->SetValue(count / 2, flag);
  attributes->AddArray(ghosts);
}

TEST(TriangleCasterMapperBehavior, RefusesWhatItLacks)
{
  using Spoil = std::function<void(ImageScene&)>;
  const auto moveToCells = [](ImageScene& scene)
  {
    vtkNew<vtkDoubleArray> cells;
    cells->SetNumberOfValues(GetImage(scene)->GetNumberOfCells());
    cells->Fill(1);
    GetImage(scene)->GetCellData()->SetScalars(cells);
    GetImage(scene)->GetPointData()->Initialize();
  };
  const std::vector<std::pair<std::string, Spoil>> cases = {
    { "vtkRectilinearGrid",
      [](ImageScene& scene)
      {
        vtkNew<vtkRectilinearGrid> grid;
        grid->SetDimensions(2, 2, 2);
        for (const auto set : { &vtkRectilinearGrid::SetXCoordinates,
               &vtkRectilinearGrid::SetYCoordinates, &vtkRectilinearGrid::SetZCoordinates })
        {
          vtkNew<vtkDoubleArray> places;
          places->InsertNextValue(0);
          places->InsertNextValue(9);
          (grid.Get()->*set)(places);
        }
        scene.Mapper->SetInputData(grid.Get());
      } },
    { "scalars at points", moveToCells },
    { "14 x 154 x 1 points",
      [](ImageScene& scene) { GetImage(scene)->SetDimensions(14, 154, 1); } },
    { "has no component 3",
      [](ImageScene& scene)
      {
        scene.Mapper->SetVectorModeToComponent();
        scene.Mapper->SetVectorComponent(3);
      } },
    { "ScalarOpacityUnitDistance is 0",
      [](ImageScene& scene) { scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(0); } },
    { "matrix has no inverse", [](ImageScene& scene) { scene.Volume->SetScale(1, 0, 1); } },
    { "a spacing", [](ImageScene& scene) { GetImage(scene)->SetSpacing(1, 0, 1); } },
    { "direction matrix",
      [](ImageScene& scene)
      {
        GetImage(scene)->SetDirectionMatrix(0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1);
        scene.Mapper->CroppingOn();
      } },
    { "pre-integrated slabs",
      [](ImageScene& scene)
      {
        scene.Volume->GetProperty()->ShadeOn();
        scene.Mapper->PreIntegrationOn();
      } },
    { "distance of slices", [](ImageScene& scene) { scene.Mapper->SetSampleDistance(1e-9); } },
    { "point arrays: none",
      [](ImageScene& scene) { GetImage(scene)->GetPointData()->Initialize(); } },
  };
  for (const auto& [text, spoil] : cases)
  {
    ImageScene scene;
    const std::vector<float> before = scene.Render();
    EXPECT_EQ(scene.Mapper->GetObstacle(), "");
    spoil(scene);
    const MessageObserver errors(scene.Mapper);
    scene.Mapper->Render(scene.Renderer, scene.Volume);
    EXPECT_NE(errors.Text.find(text), std::string::npos) << text << ": " << errors.Text;
    EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 0) << text;
  }
}

// No flag is set: nothing is left out.
TEST(TriangleCasterMapperBehavior, GhostArraysWithoutGhostsAreNoObstacle)
{
  ImageScene scene;
  const std::vector<float> expected = scene.Render();
  AddGhosts(GetImage(scene)->GetPointData(), GetImage(scene)->GetNumberOfPoints(), 0);
  AddGhosts(GetImage(scene)->GetCellData(), GetImage(scene)->GetNumberOfCells(), 0);
  EXPECT_EQ(scene.Render(), expected);
}

TEST(TriangleCasterMapperBehavior, WarnsOnceOfWhatItDoesNotUse)
{
  ImageScene scene;
  scene.Volume->GetProperty()->SetLabelScalarOpacity(1, scene.Opacity);
  std::vector<std::string> warnings;
  const Observer observer(scene.Mapper, vtkCommand::WarningEvent,
    [&](const char* message) { warnings.emplace_back(message); });
  scene.Window->Render();
  scene.Window->Render();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("labels"), std::string::npos) << warnings[0];
  EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 96 * 72);
}

TEST(TriangleCasterMapperBehavior, WarnsOfAnErrorAboveTheMaximum)
{
  ImageScene scene;
  scene.Mapper->SetMaximumError(0.01); // more than what is between slices
  scene.Window->Render();
  EXPECT_TRUE(scene.Mapper->IsMaximumErrorKept());
  EXPECT_GT(scene.Mapper->GetErrorEstimate(), 0);
  EXPECT_LE(scene.Mapper->GetErrorEstimate(), 0.01);
  const MessageObserver warnings(scene.Mapper, { vtkCommand::WarningEvent });
  // So many samples that adding them up rounds too much.
  scene.Mapper->SetMaximumError(1e-6);
  scene.Mapper->SetSampleDistance(0.01);
  scene.Window->Render();
  EXPECT_FALSE(scene.Mapper->IsMaximumErrorKept());
  EXPECT_NE(warnings.Text.find("summation"), std::string::npos) << warnings.Text;
}

TEST(TriangleCasterMapperBehavior, PrintsWhatTheLastFrameFound)
{
  ImageScene scene;
  scene.Window->Render();
  std::ostringstream text;
  scene.Mapper->Print(text);
  std::ostringstream estimate;
  estimate << "  ErrorEstimate: " << scene.Mapper->GetErrorEstimate() << "\n";
  EXPECT_NE(text.str().find(estimate.str()), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("  Statistics:\n    {\n      \"method\": \"triangle-caster\""),
    std::string::npos)
    << text.str();
}

TEST(TriangleCasterMapperBehavior, BoundsAreThoseOfTheImage)
{
  vtkNew<vtkTriangleCasterMapper> mapper;
  EXPECT_EQ(mapper->GetObstacle(), "there is no input");
  mapper->SetInputData(MakeImage());
  const double* bounds = mapper->GetBounds();
  EXPECT_EQ(bounds[0], 0);
  EXPECT_EQ(bounds[1], ImageSize[0] - 1);
  EXPECT_EQ(bounds[5], ImageSize[2] - 1);
}

} // namespace
