// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayCastMapper
 * @brief   direct volume rendering of unstructured grids by cell-to-cell ray casting on the CPU
 *
 * Renders the cells of a data set as a volume with a known error. The integral over each cell is
 * evaluated in closed form, never sampled. The picture does not depend on the number of threads.
 * See vtkTetrahedraVolumeMapper for the input, the optical models and their properties. Reentry is
 * AUTOMATIC_REENTRY, BOUNDARY_HIERARCHY_REENTRY or IMAGINARY_CELLS_REENTRY; the hierarchy was
 * faster in every scene that was measured.
 *
 * @sa vtkTetrahedralizeCells, vtkUnstructuredGridVolumeRayCastMapper
 */
#ifndef vtkTetrahedraRayCastMapper_h
#define vtkTetrahedraRayCastMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkTetrahedraVolumeMapper.h"

#include <memory> // For std::unique_ptr

class TETRALUXRENDERING_EXPORT vtkTetrahedraRayCastMapper : public vtkTetrahedraVolumeMapper
{
public:
  static vtkTetrahedraRayCastMapper* New();
  vtkTypeMacro(vtkTetrahedraRayCastMapper, vtkTetrahedraVolumeMapper);

  ///@{
  /**
   * Set the number of threads that cast rays, 1 to 1024. Default 0: as many as OpenMP offers. The
   * picture does not depend on it.
   */
  virtual void SetNumberOfThreads(int threads);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  enum PrecisionType
  {
    AUTOMATIC_PRECISION,
    SINGLE_PRECISION,
    DOUBLE_PRECISION
  };

  ///@{
  /**
   * Set the arithmetic of the geometry along rays. Default AUTOMATIC_PRECISION: single if its
   * estimated error is within a quarter of MaximumError, else double. Double precision takes 32
   * bytes a point more.
   */
  virtual void SetPrecision(int precision);
  vtkGetMacro(Precision, int);
  const char* GetPrecisionAsString();
  void SetPrecisionToAutomatic() { this->SetPrecision(AUTOMATIC_PRECISION); }
  void SetPrecisionToSingle() { this->SetPrecision(SINGLE_PRECISION); }
  void SetPrecisionToDouble() { this->SetPrecision(DOUBLE_PRECISION); }
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

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   */
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkTetrahedraRayCastMapper();
  ~vtkTetrahedraRayCastMapper() override;

  void DrawFrame(tetralux::MapperFrame& frame) override;
  void PrintProperties(ostream& os, vtkIndent indent) override;

  int NumberOfThreads = 0;
  int Precision = AUTOMATIC_PRECISION;
  float ImageSampleDistance = 1;
  float MinimumImageSampleDistance = 1;
  float MaximumImageSampleDistance = 10;
  vtkTypeBool AutoAdjustSampleDistances = 1;

private:
  vtkTetrahedraRayCastMapper(const vtkTetrahedraRayCastMapper&) = delete;
  void operator=(const vtkTetrahedraRayCastMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
