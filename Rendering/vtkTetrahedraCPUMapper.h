// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraCPUMapper
 * @brief   what mappers have in common that make their pictures on the processor
 *
 * Threads, the distance of rays, and the picture's way into the window. The picture does not depend
 * on the number of threads.
 *
 * In a window with MultiSamples, where a ray is a pixel, pixels at edges are cast once for each
 * sample, through its own place and up to its own opaque depth: edges of opaque geometry, and
 * wherever colours change unevenly. What no ray through the middle of a pixel meets is not found.
 * GetOutputImage has one ray a pixel. Pictures that light samples refine over several frames have
 * one ray a pixel.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkTetrahedraIsosurfaceMapper
 */
#ifndef vtkTetrahedraCPUMapper_h
#define vtkTetrahedraCPUMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkTetrahedraVolumeMapper.h"

#include <memory> // For std::unique_ptr

namespace tetralux
{
struct CPUPicture;
struct PixelRectangle;
} // namespace tetralux

class TETRALUXRENDERING_EXPORT vtkTetrahedraCPUMapper : public vtkTetrahedraVolumeMapper
{
public:
  vtkTypeMacro(vtkTetrahedraCPUMapper, vtkTetrahedraVolumeMapper);

  ///@{
  /**
   * Set the number of threads that cast rays, 1 to 1024. Default 0: as many as OpenMP offers. The
   * picture does not depend on it.
   */
  virtual void SetNumberOfThreads(int threads);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * Set the distance of rays in pixels, 0.1 to 100, for frames with AutoAdjustSampleDistances off.
   * Default 1: one ray through each pixel's centre. At 2 one ray covers 2 x 2 pixels, and the
   * picture is interpolated; at 0.5 a pixel is the mean of 4 rays.
   */
  virtual void SetImageSampleDistance(float distance);
  vtkGetMacro(ImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Set the range of the automatic distance of rays in pixels, each 0.1 to 100. Default 1 and 10.
   */
  virtual void SetMinimumImageSampleDistance(float distance);
  vtkGetMacro(MinimumImageSampleDistance, float);
  virtual void SetMaximumImageSampleDistance(float distance);
  vtkGetMacro(MaximumImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Set whether the distance of rays follows from the time that the renderer allocates to the
   * volume and the time that a ray took in the last frame. Default on. Without a desired update
   * rate, as in still and off-screen frames, that time is hours, and the distance is
   * MinimumImageSampleDistance.
   */
  vtkSetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkGetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  ///@}

protected:
  vtkTetrahedraCPUMapper();
  ~vtkTetrahedraCPUMapper() override;

  void DrawFrame(tetralux::MapperFrame& frame) override;
  void ReleaseResources(vtkWindow* window) override;
  void PrintProperties(ostream& os, vtkIndent indent) override;

  /**
   * Make the picture of a frame: colours, distances, statistics, and whether it was aborted.
   * Returns the rays beyond which nothing is in the picture, empty where nothing is. What it throws
   * becomes an error of one line.
   */
  virtual tetralux::PixelRectangle MakePicture(
    tetralux::MapperFrame& frame, const tetralux::CPUPicture& picture) = 0;

  int NumberOfThreads = 0;
  float ImageSampleDistance = 1;
  float MinimumImageSampleDistance = 1;
  float MaximumImageSampleDistance = 10;
  vtkTypeBool AutoAdjustSampleDistances = 1;

private:
  vtkTetrahedraCPUMapper(const vtkTetrahedraCPUMapper&) = delete;
  void operator=(const vtkTetrahedraCPUMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
