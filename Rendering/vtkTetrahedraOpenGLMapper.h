// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraOpenGLMapper
 * @brief   what mappers have in common that draw by OpenGL: calls of VTK's ray casters
 *
 * What programs for VTK's ray casters say about threads is accepted and not used; see
 * Documentation/from_vtk.md.
 *
 * The picture stays on the graphics card. It is read back, in each frame, if the window has
 * MultiSamples or the distance of rays is not 1.
 *
 * @sa vtkTetrahedraGPURayCastMapper, vtkTetrahedraProjectionMapper
 */
#ifndef vtkTetrahedraOpenGLMapper_h
#define vtkTetrahedraOpenGLMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkTetrahedraVolumeMapper.h"

class TETRALUXRENDERING_EXPORT vtkTetrahedraOpenGLMapper : public vtkTetrahedraVolumeMapper
{
public:
  vtkTypeMacro(vtkTetrahedraOpenGLMapper, vtkTetrahedraVolumeMapper);

  ///@{
  /**
   * Threads of the processor cast no rays here: accepted, without effect. Returns 0.
   */
  virtual void SetNumberOfThreads(int) {}
  virtual int GetNumberOfThreads() { return 0; }
  ///@}

protected:
  vtkTetrahedraOpenGLMapper();
  ~vtkTetrahedraOpenGLMapper() override;

private:
  vtkTetrahedraOpenGLMapper(const vtkTetrahedraOpenGLMapper&) = delete;
  void operator=(const vtkTetrahedraOpenGLMapper&) = delete;
};

#endif
