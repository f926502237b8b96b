// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchView_h
#define BenchView_h

#include "vtkAbstractVolumeMapper.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

struct BenchScene;
struct SceneOptions;
class vtkHeadlessRenderWindow;
class vtkRenderer;
class vtkVolume;

/// A picture as floating point numbers: red, green, blue and opacity of each pixel, premultiplied,
/// without background, lowest row first.
struct BenchPicture
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Rgba;
};

/// Makes the window that every method renders to. It has no multisampling, which would smooth
/// nothing and cost every method time. view: the size.
vtkSmartPointer<vtkHeadlessRenderWindow> MakeBenchWindow(const SceneOptions& view);

/// Returns OpenGL's name of what renders in a window.
std::string GetOpenGLRenderer(vtkHeadlessRenderWindow* window);

/// Shows one scene through one mapper and measures how long frames take. While it lives, nothing
/// else may be shown in its window.
class BenchView
{
public:
  /// view: the camera. Renders an empty frame, so that the window is ready.
  BenchView(vtkHeadlessRenderWindow* window, const BenchScene& scene,
    vtkSmartPointer<vtkAbstractVolumeMapper> mapper, const SceneOptions& view);
  ~BenchView();
  BenchView(const BenchView&) = delete;
  BenchView& operator=(const BenchView&) = delete;

  /// Renders a frame and returns the seconds until its last pixel is there. The camera counts as
  /// moved, so that nothing of the frame before is used again. Throws WorkError with VTK's error if
  /// the frame fails.
  double Render();

  /// Returns what the window shows, in 8 bit over black.
  BenchPicture CaptureWindow() const;

  /// Returns the mapper's own picture. It must be a mapper of this project, with one ray a pixel.
  BenchPicture GetFloatPicture() const;

  /// Returns the statistics of a mapper of this project as JSON, "{}" of others.
  std::string GetStatistics() const;

  vtkRenderer* GetRenderer() const { return this->Renderer; }
  vtkVolume* GetVolume() const { return this->Volume; }
  vtkAbstractVolumeMapper* GetMapper() const { return this->Mapper; }

private:
  vtkSmartPointer<vtkAbstractVolumeMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRenderer> Renderer;
  vtkSmartPointer<vtkHeadlessRenderWindow> Window;
};

#endif
