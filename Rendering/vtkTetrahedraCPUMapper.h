// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraCPUMapper
 * @brief   what mappers have in common that make their pictures on the processor
 *
 * Threads, and the picture's way into the window. The picture does not depend on the number of
 * threads.
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
struct PictureTask;
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
    tetralux::MapperFrame& frame, const tetralux::PictureTask& picture) = 0;

  int NumberOfThreads = 0;

private:
  vtkTetrahedraCPUMapper(const vtkTetrahedraCPUMapper&) = delete;
  void operator=(const vtkTetrahedraCPUMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
