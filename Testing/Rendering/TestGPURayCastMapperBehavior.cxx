// SPDX-License-Identifier: BSD-3-Clause

// What the mapper on the graphics card does beside pictures: uploads, aborts, windows, errors.

#include "GPUScene.h"
#include "Observer.h"
#include "OpenGLSnapshot.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{

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
