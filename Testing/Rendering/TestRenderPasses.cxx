// SPDX-License-Identifier: BSD-3-Clause
// Render passes draw into frame buffers that are not the window's: of other sizes, from another
// corner, with pictures beside the colours.
#include "ImageScene.h"
#include "IsosurfaceScene.h"
#include "Observer.h"
#include "RayCastScene.h"

#include "vtkActor.h"
#include "vtkFloatArray.h"
#include "vtkGaussianBlurPass.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderStepsPass.h"
#include "vtkSSAAPass.h"
#include "vtkSSAOPass.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace
{

/// The window's size in the passes that change it: square, as vtkImageProcessingPass leaves the
/// aspect ratio alone where it adds a border.
constexpr int WindowSize = 60;

/// Of a picture of floats: the methods of the graphics card have other roundings.
constexpr float PictureTolerance = 2e-5f;

void AddBall(vtkRenderer* renderer, double x, double y, double z, double radius, double opacity = 1)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(x, y, z);
  sphere->SetRadius(radius);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetOpacity(opacity);
  renderer->AddActor(actor);
}

/// A narrow clipping range, so that depth buffers round little.
void SetCamera(RayCastScene& scene)
{
  scene.SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 }, 1, 6);
}

struct Picture
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Colors;
};

Picture GetPicture(vtkImageData* image)
{
  Picture picture;
  picture.Width = image->GetDimensions()[0];
  picture.Height = image->GetDimensions()[1];
  auto* colors = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("RGBA"));
  if (colors)
  {
    picture.Colors.assign(
      colors->GetPointer(0), colors->GetPointer(0) + colors->GetNumberOfValues());
  }
  return picture;
}

/// The largest difference to the middle of a picture that has a border around.
float FindDifference(const Picture& picture, const Picture& expected)
{
  const int left = (picture.Width - expected.Width) / 2;
  const int lower = (picture.Height - expected.Height) / 2;
  EXPECT_GE(left, 0);
  EXPECT_GE(lower, 0);
  float largest = 0;
  float covered = 0;
  for (int j = 0; j < expected.Height; ++j)
  {
    for (int i = 0; i < expected.Width; ++i)
    {
      for (int c = 0; c < 4; ++c)
      {
        const float a = picture.Colors[4 * ((j + lower) * picture.Width + i + left) + c];
        const float b = expected.Colors[4 * (j * expected.Width + i) + c];
        largest = std::max(largest, std::abs(a - b));
        covered = std::max(covered, b);
      }
    }
  }
  EXPECT_GT(covered, 0.1f);
  return largest;
}

/// A scene of one of the five mappers, with a ball in front of a part of the volume.
class PassScene
{
public:
  virtual ~PassScene() = default;
  virtual vtkRenderWindow* GetWindow() = 0;
  virtual vtkRenderer* GetRenderer() = 0;
  virtual vtkAbstractVolumeMapper* GetMapper() = 0;
  virtual vtkImageData* GetImage() = 0;

  Picture Render(int width, int height)
  {
    this->GetWindow()->SetSize(width, height);
    this->GetWindow()->Render();
    return GetPicture(this->GetImage());
  }

  std::vector<unsigned char> Grab()
  {
    const int* size = this->GetWindow()->GetActualSize();
    vtkNew<vtkUnsignedCharArray> shown;
    this->GetWindow()->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, shown, 0);
    return { shown->GetPointer(0), shown->GetPointer(0) + shown->GetNumberOfValues() };
  }
};

template <class Mapper>
class CellScene : public PassScene
{
public:
  CellScene()
  {
    this->Scene.Use(this->Used);
    SetCamera(this->Scene);
    AddBall(this->Scene.Renderer, 0.9, 0.7, 1, 0.2);
  }
  vtkRenderWindow* GetWindow() override { return this->Scene.Window; }
  vtkRenderer* GetRenderer() override { return this->Scene.Renderer; }
  vtkAbstractVolumeMapper* GetMapper() override { return this->Used; }
  vtkImageData* GetImage() override { return this->Used->GetOutputImage(); }

private:
  RayCastScene Scene;
  vtkNew<Mapper> Used;
};

class CPUScene : public CellScene<vtkTetrahedraRayCastMapper>
{
public:
  CPUScene()
  {
    vtkTetrahedraRayCastMapper::SafeDownCast(this->GetMapper())->AutoAdjustSampleDistancesOff();
  }
};

class SurfaceScene : public PassScene
{
public:
  SurfaceScene()
  {
    this->Scene.SetSurfaces({ { 0.1, 1 } });
    SetCamera(this->Scene);
    AddBall(this->Scene.Renderer, 0.9, 0.7, 1, 0.2);
  }
  vtkRenderWindow* GetWindow() override { return this->Scene.Window; }
  vtkRenderer* GetRenderer() override { return this->Scene.Renderer; }
  vtkAbstractVolumeMapper* GetMapper() override { return this->Scene.Tracer; }
  vtkImageData* GetImage() override { return this->Scene.Tracer->GetOutputImage(); }

private:
  IsosurfaceScene Scene;
};

class SliceScene : public PassScene
{
public:
  SliceScene() { this->Scene.AddSphere(7, 6, 9, 2); }
  vtkRenderWindow* GetWindow() override { return this->Scene.Window; }
  vtkRenderer* GetRenderer() override { return this->Scene.Renderer; }
  vtkAbstractVolumeMapper* GetMapper() override { return this->Scene.Mapper; }
  vtkImageData* GetImage() override { return this->Scene.Mapper->GetOutputImage(); }

private:
  ImageScene Scene;
};

template <class Scene>
class RenderPasses : public testing::Test
{
public:
  Scene Tested;
  vtkNew<vtkRenderStepsPass> Steps;
};

using Scenes = testing::Types<CPUScene, CellScene<vtkTetrahedraGPURayCastMapper>,
  CellScene<vtkTetrahedraProjectionMapper>, SurfaceScene, SliceScene>;
TYPED_TEST_SUITE(RenderPasses, Scenes);

// Rays are those of the pass's larger picture, and end at the opaque geometry in it.
TYPED_TEST(RenderPasses, FillsASupersampledPicture)
{
  PassScene& scene = this->Tested;
  vtkNew<vtkSSAAPass> pass;
  pass->SetDelegatePass(this->Steps);
  scene.GetRenderer()->SetPass(pass);
  const Picture picture = scene.Render(WindowSize, WindowSize);
  ASSERT_GT(picture.Width, 2 * WindowSize);
  scene.GetRenderer()->SetPass(nullptr);
  const Picture expected = scene.Render(picture.Width, picture.Height);
  ASSERT_EQ(picture.Colors.size(), expected.Colors.size());
  EXPECT_LE(FindDifference(picture, expected), PictureTolerance);
}

// Also of a renderer that has not all of the window: the pass draws from the lower left on.
TYPED_TEST(RenderPasses, FillsAPictureWithABorder)
{
  PassScene& scene = this->Tested;
  scene.GetRenderer()->SetViewport(0.5, 0.25, 1, 0.75);
  const Picture expected = scene.Render(2 * WindowSize, 2 * WindowSize);
  ASSERT_EQ(expected.Width, WindowSize);
  vtkNew<vtkGaussianBlurPass> pass;
  pass->SetDelegatePass(this->Steps);
  scene.GetRenderer()->SetPass(pass);
  const Picture picture = scene.Render(2 * WindowSize, 2 * WindowSize);
  ASSERT_GT(picture.Width, WindowSize);
  EXPECT_LE(FindDifference(picture, expected), PictureTolerance);
  scene.GetRenderer()->SetPass(nullptr);
  pass->ReleaseGraphicsResources(scene.GetWindow());
}

// The pass has positions and normals of opaque geometry in pictures beside the colours, by which it
// darkens what is beside and behind.
TYPED_TEST(RenderPasses, LeavesOtherPicturesOfAPassAlone)
{
  PassScene& scene = this->Tested;
  vtkNew<vtkSSAOPass> pass;
  pass->SetDelegatePass(this->Steps);
  pass->SetRadius(0.5);
  scene.GetRenderer()->SetPass(pass);
  scene.Render(WindowSize, WindowSize);
  const std::vector<unsigned char> shown = scene.Grab();
  auto* volume = vtkProp::SafeDownCast(scene.GetRenderer()->GetVolumes()->GetItemAsObject(0));
  volume->VisibilityOff();
  scene.GetWindow()->Render();
  const std::vector<unsigned char> without = scene.Grab();
  EXPECT_NE(shown, without);
  // Where nothing of the volume is seen, nothing changes.
  const Picture picture = GetPicture(scene.GetImage());
  int same = 0;
  for (std::size_t pixel = 0; pixel < without.size() / 3; ++pixel)
  {
    if (picture.Colors[4 * pixel + 3] == 0 && without[3 * pixel] > 0)
    {
      ++same;
      EXPECT_EQ(shown[3 * pixel], without[3 * pixel]);
    }
  }
  EXPECT_GT(same, 20);
  scene.GetRenderer()->SetPass(nullptr);
}

TYPED_TEST(RenderPasses, RefusesToBePeeled)
{
  PassScene& scene = this->Tested;
  AddBall(scene.GetRenderer(), 0, 0, 0, 0.3, 0.5);
  const Picture expected = scene.Render(WindowSize, WindowSize);
  scene.GetRenderer()->UseDepthPeelingOn();
  scene.GetRenderer()->UseDepthPeelingForVolumesOn();
  {
    const MessageObserver errors(scene.GetMapper());
    EXPECT_TRUE(scene.Render(WindowSize, WindowSize).Colors.empty());
    EXPECT_NE(errors.Text.find("UseDepthPeelingForVolumes off"), std::string::npos) << errors.Text;
  }
  scene.GetRenderer()->UseDepthPeelingForVolumesOff();
  const Picture picture = scene.Render(WindowSize, WindowSize);
  EXPECT_EQ(picture.Colors, expected.Colors);
}

} // namespace
