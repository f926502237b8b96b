// SPDX-License-Identifier: BSD-3-Clause

// Pictures that the graphics card casts in bands of rows.

#include "GPUScene.h"
#include "Observer.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkImageData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <vector>

namespace
{

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

} // namespace
