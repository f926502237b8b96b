// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceWindow_h
#define tetralux_IsosurfaceWindow_h

#include "vtkHeadlessRenderWindow.h"

#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

#include <array>
#include <string>

struct SceneOptions;

namespace tetralux
{

/// A window without a display, with a camera and one positional light.
class IsosurfaceWindow
{
public:
  /// bounds: of what is shown.
  IsosurfaceWindow(const SceneOptions& options, const double bounds[6]);

  vtkRenderer* GetRenderer() const { return this->Renderer; }

  const std::array<double, 3>& GetLightPosition() const { return this->LightPosition; }

  /// Name of what renders.
  std::string GetOpenGL();

  /// Shadow maps with as many texels as the larger side of the picture has pixels. They are drawn
  /// anew where geometry or light changed. Off, the light shines through.
  void SetShadows(bool shadows);

  /// Draws a frame and returns its seconds, until OpenGL has finished.
  double DrawFrame();

  /// Pixels that have not the colour of the background.
  vtkIdType CountCoveredPixels();

private:
  vtkNew<vtkHeadlessRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLight> Light;
  std::array<double, 3> LightPosition;
};

} // namespace tetralux

#endif
