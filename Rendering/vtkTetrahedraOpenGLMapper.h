// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraOpenGLMapper
 * @brief   what mappers have in common that draw by OpenGL: calls of VTK's ray casters
 *
 * These mappers draw every pixel of every frame. What programs for VTK's ray casters say about the
 * distance of rays and about threads is accepted and not used; see Documentation/from_vtk.md.
 *
 * In a window with MultiSamples, a pixel has one ray, up to the depth of one of its samples: edges
 * are not antialiased.
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
   * The distance of rays in pixels: always 1. Any other distance gives one warning, and so does
   * AutoAdjustSampleDistances on.
   */
  virtual void SetImageSampleDistance(float distance);
  virtual float GetImageSampleDistance() { return 1; }
  virtual void SetMinimumImageSampleDistance(float distance);
  virtual float GetMinimumImageSampleDistance() { return 1; }
  virtual void SetMaximumImageSampleDistance(float) {}
  virtual float GetMaximumImageSampleDistance() { return 1; }
  virtual void SetAutoAdjustSampleDistances(vtkTypeBool adjust);
  virtual vtkTypeBool GetAutoAdjustSampleDistances() { return 0; }
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  ///@}

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
