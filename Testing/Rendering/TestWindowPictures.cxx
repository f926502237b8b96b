// SPDX-License-Identifier: BSD-3-Clause
// The window shows the mapper's picture over what was there, wherever the camera is: what is left
// out of compositing has nothing in it.
#include "AnyMapperScene.h"

#include "vtkCamera.h"

#include <cmath>
#include <functional>
#include <utility>

namespace
{

constexpr double Background[3] = { 0.3, 0.5, 0.1 };

/// Steps of 255: drawing rounds the colour, its product and the background.
constexpr double DrawnSteps = 2;

using View = std::pair<const char*, std::function<void(vtkRenderer*, vtkCamera*)>>;

const std::vector<View>& GetViews()
{
  static const std::vector<View> views = {
    { "whole", [](vtkRenderer*, vtkCamera*) {} },
    { "small", [](vtkRenderer*, vtkCamera* camera) { camera->Zoom(0.3); } },
    { "beside the middle",
      [](vtkRenderer*, vtkCamera* camera) { camera->SetWindowCenter(1, 0.7); } },
    { "parallel",
      [](vtkRenderer*, vtkCamera* camera)
      {
        camera->SetWindowCenter(0, 0);
        camera->ParallelProjectionOn();
        camera->SetParallelScale(2 * camera->GetParallelScale());
      } },
    { "inside",
      [](vtkRenderer* renderer, vtkCamera* camera)
      {
        camera->ParallelProjectionOff();
        camera->SetPosition(2.4, 2.1, 1.6);
        renderer->ResetCameraClippingRange();
      } },
    { "a part of the window",
      [](vtkRenderer* renderer, vtkCamera*)
      {
        renderer->ResetCamera();
        renderer->SetViewport(0.3, 0.2, 0.8, 0.9);
      } },
  };
  return views;
}

} // namespace

TEST_P(AnyMapper, ShowsItsPictureOverWhatWasThere)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()));
  scene.Renderer->SetBackground(Background[0], Background[1], Background[2]);
  for (const auto& [name, look] : GetViews())
  {
    SCOPED_TRACE(name);
    look(scene.Renderer, scene.Renderer->GetActiveCamera());
    const std::vector<float> picture = scene.Render();
    const std::vector<int> window = scene.Grab();
    const int* size = GetOutputImage(scene.GetMapper())->GetDimensions();
    const int* windowSize = scene.Window->GetSize();
    const int* origin = scene.Renderer->GetOrigin();
    ASSERT_EQ(size[0], scene.Renderer->GetSize()[0]);
    ASSERT_EQ(size[1], scene.Renderer->GetSize()[1]);
    bool anything = false;
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        const float* color = &picture[4 * (static_cast<std::size_t>(y) * size[0] + x)];
        const int* shown = &window[3 * ((origin[1] + y) * windowSize[0] + origin[0] + x)];
        anything = anything || color[3] > 0;
        for (int c = 0; c < 3; ++c)
        {
          ASSERT_NEAR(shown[c], 255 * (color[c] + (1 - color[3]) * Background[c]), DrawnSteps)
            << x << " " << y;
        }
      }
    }
    EXPECT_TRUE(anything);
  }
}
