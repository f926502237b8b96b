// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchView_h
#define BenchView_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGridVolumeMapper.h"

#include <string>
#include <vector>

struct BenchScene;
struct SceneOptions;
class vtkHeadlessRenderWindow;
class vtkRenderer;
class vtkVolume;

/// A picture as floating point numbers: four channels for each pixel, premultiplied, over nothing,
/// lower row first.
struct BenchPicture
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Rgba;
};

/// A window as every method gets it: without multisampling, since there is no geometry to smooth and
/// it costs all of them. view: its size.
vtkSmartPointer<vtkHeadlessRenderWindow> MakeBenchWindow(const SceneOptions& view);

/// OpenGL's name of what renders in a window.
std::string GetOpenGLRenderer(vtkHeadlessRenderWindow* window);

/// Shows one scene through one mapper, alone in its window as long as it lives, and tells how long
/// frames take.
class BenchView
{
public:
  /// view: the camera. The window is ready, with a frame that shows nothing behind it.
  BenchView(vtkHeadlessRenderWindow* window, const BenchScene& scene,
    vtkSmartPointer<vtkUnstructuredGridVolumeMapper> mapper, const SceneOptions& view);
  ~BenchView();
  BenchView(const BenchView&) = delete;
  BenchView& operator=(const BenchView&) = delete;

  /// Seconds that a frame takes, until the last pixel of it is there. The camera counts as moved, so
  /// that nothing is shown again that was computed for the frame before. Throws WorkError with what
  /// VTK has to say where the frame fails.
  double Render();

  /// What the window shows, in 8 bit over black.
  BenchPicture CaptureWindow() const;

  /// What the mapper cast; it must be ours, with one ray for each pixel.
  BenchPicture GetFloatPicture() const;

  /// As JSON, of ours; "{}" of others.
  std::string GetStatistics() const;

  vtkRenderer* GetRenderer() const { return this->Renderer; }
  vtkVolume* GetVolume() const { return this->Volume; }
  vtkUnstructuredGridVolumeMapper* GetMapper() const { return this->Mapper; }

private:
  vtkSmartPointer<vtkUnstructuredGridVolumeMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRenderer> Renderer;
  vtkSmartPointer<vtkHeadlessRenderWindow> Window;
};

#endif
