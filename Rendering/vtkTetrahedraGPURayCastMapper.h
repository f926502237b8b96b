// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraGPURayCastMapper
 * @brief   direct volume rendering of unstructured grids by cell-to-cell ray casting on the GPU
 *
 * Renders what vtkTetrahedraRayCastMapper renders, in the same way, on the graphics card (Weiler et
 * al. 2003). The mesh lies in texture buffers, 32 bytes a tetrahedron and 16 a point. Rays go from
 * cell to cell in passes of a bounded number of steps. See vtkTetrahedraVolumeMapper for the input,
 * the optical models and their properties. OpenGL 3.2 with GLSL 1.50 is enough.
 *
 * Each ray finds its way by exact signs in whole numbers: none is lost or counted twice at faces,
 * edges and vertices, on any graphics card. Geometry is in single precision; GetErrorEstimate()
 * includes its error.
 *
 * Only what changed is sent to the graphics card: topology, or points with their scalars. The
 * picture is read back when GetOutputImage() asks for it. If segments are looked up in a table, its
 * Depth is that of the first cell that contributes. Where cells overlap, Depth is what is first in
 * the cell that contributes and begins nearest.
 *
 * @warning A mesh has at most a quarter as many tetrahedra as the driver's texture buffers have
 * texels (2^27 on most) and 67,108,863 tetrahedra on any, and must fit into free memory if the
 * driver tells how much there is. All is checked before anything is sent; one error says which
 * limit was exceeded. A mesh whose size in the world is beyond the range of single precision is
 * refused.
 *
 * @sa vtkTetrahedraRayCastMapper
 */
#ifndef vtkTetrahedraGPURayCastMapper_h
#define vtkTetrahedraGPURayCastMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkTetrahedraOpenGLMapper.h"

#include <memory> // For std::unique_ptr

class TETRALUXRENDERING_EXPORT vtkTetrahedraGPURayCastMapper : public vtkTetrahedraOpenGLMapper
{
public:
  static vtkTetrahedraGPURayCastMapper* New();
  vtkTypeMacro(vtkTetrahedraGPURayCastMapper, vtkTetrahedraOpenGLMapper);

  ///@{
  /**
   * Set the number of cells that a ray passes in one draw call at most, 1 to 65535. Default 128.
   * Fewer steps make an abort sooner and keep a slow graphics card's watchdog quiet; more steps
   * save draw calls. The picture does not depend on it.
   */
  virtual void SetStepsPerPass(int steps);
  vtkGetMacro(StepsPerPass, int);
  ///@}

  ///@{
  /**
   * Set the largest size of what rays keep between passes, bytes, 4096 to 2^40. Default 2^30. Rays
   * keep 38 bytes a pixel, or 42 with boundary layers. A picture for which that is not enough is
   * cast in bands of rows, one after the other; so is one that is larger than what OpenGL draws
   * into, or for which the driver has no memory. The picture does not depend on it. One row is cast
   * in any case. The picture itself takes 20 bytes a pixel more.
   */
  virtual void SetRayMaximumBytes(vtkIdType bytes);
  vtkGetMacro(RayMaximumBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * Set whether GetStatistics() has the number of rays of every pass. Each pass then waits for the
   * one before. Default off: only numbers that were known without waiting.
   */
  vtkSetMacro(CountFragments, vtkTypeBool);
  vtkGetMacro(CountFragments, vtkTypeBool);
  vtkBooleanMacro(CountFragments, vtkTypeBool);
  ///@}

  /**
   * Return whether the mapper works in a window: false if OpenGL lacks something, or if the mesh of
   * the input may not fit. Software OpenGL will do.
   */
  bool IsSupported(vtkRenderWindow* window) override;

  /**
   * Return whether IsSupported(), and by a graphics card: with software OpenGL,
   * vtkTetrahedraRayCastMapper is faster. GetSupportReason() then says why not, or which graphics
   * card it is.
   */
  bool IsAccelerated(vtkRenderWindow* window);

protected:
  vtkTetrahedraGPURayCastMapper();
  ~vtkTetrahedraGPURayCastMapper() override;

  void DrawFrame(tetralux::MapperFrame& frame) override;
  void ReleaseResources(vtkWindow* window) override;
  void PrintProperties(ostream& os, vtkIndent indent) override;

  int StepsPerPass = 128;
  vtkIdType RayMaximumBytes = 1073741824;
  vtkTypeBool CountFragments = 0;

private:
  vtkTetrahedraGPURayCastMapper(const vtkTetrahedraGPURayCastMapper&) = delete;
  void operator=(const vtkTetrahedraGPURayCastMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
