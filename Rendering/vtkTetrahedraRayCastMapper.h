// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayCastMapper
 * @brief   direct volume rendering of unstructured grids by cell-to-cell ray casting on the CPU
 *
 * Renders the cells of a data set as a volume, with an error that is known: the integral over each
 * cell is evaluated in closed form, never sampled, and the picture does not depend on the number
 * of threads. Input, optical models and what they are set by: see vtkTetrahedraVolumeMapper.
 *
 * @sa vtkTetrahedraFilter, vtkUnstructuredGridVolumeRayCastMapper
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
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ReentryType
  {
    AUTOMATIC_REENTRY,
    BOUNDARY_HIERARCHY,
    IMAGINARY_CELLS
  };

  ///@{
  /**
   * How rays that left the mesh find where they enter it again: by a hierarchy over its boundary
   * faces, or through imaginary cells between the mesh and its convex hull (Weiler et al. 2003,
   * section 3.4, see vtkConvexifyTetrahedra), which are made in the first frame that needs them.
   * Automatic (default) is BOUNDARY_HIERARCHY: it was faster in every scene that was measured. A mesh
   * that can't be made convex is entered by its boundary, and one warning says why. The picture is
   * the same.
   */
  vtkSetClampMacro(Reentry, int, AUTOMATIC_REENTRY, IMAGINARY_CELLS);
  vtkGetMacro(Reentry, int);
  void SetReentryToAutomatic() { this->SetReentry(AUTOMATIC_REENTRY); }
  void SetReentryToBoundaryHierarchy() { this->SetReentry(BOUNDARY_HIERARCHY); }
  void SetReentryToImaginaryCells() { this->SetReentry(IMAGINARY_CELLS); }
  ///@}

  ///@{
  /**
   * Threads that cast rays; 0 (default): as many as OpenMP offers. At most 1024. The picture does
   * not depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
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
   * Arithmetic of the geometry along rays. Automatic (default): single where its estimated error
   * stays within a quarter of MaximumError, else double. Double precision takes 32 bytes a point
   * more.
   */
  vtkSetClampMacro(Precision, int, AUTOMATIC_PRECISION, DOUBLE_PRECISION);
  vtkGetMacro(Precision, int);
  void SetPrecisionToAutomatic() { this->SetPrecision(AUTOMATIC_PRECISION); }
  void SetPrecisionToSingle() { this->SetPrecision(SINGLE_PRECISION); }
  void SetPrecisionToDouble() { this->SetPrecision(DOUBLE_PRECISION); }
  ///@}

  ///@{
  /**
   * Distance of rays in pixels, 0.1..100, default 1: one ray through each pixel's centre. At 2 one
   * ray does for 2 x 2 pixels, and the picture is interpolated; at 0.5 a pixel is the mean of 4.
   * Used where AutoAdjustSampleDistances is off.
   */
  vtkSetClampMacro(ImageSampleDistance, float, 0.1f, 100.0f);
  vtkGetMacro(ImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * The range that automatic adjustment may choose the distance of rays from, in pixels, each
   * 0.1..100, default 1 and 10.
   */
  vtkSetClampMacro(MinimumImageSampleDistance, float, 0.1f, 100.0f);
  vtkGetMacro(MinimumImageSampleDistance, float);
  vtkSetClampMacro(MaximumImageSampleDistance, float, 0.1f, 100.0f);
  vtkGetMacro(MaximumImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Whether the distance of rays follows from the time that the renderer allocates to the volume
   * and the time that a ray took in the last frame. On by default. Without a desired update rate,
   * as in still and off-screen frames, that time is hours, and the distance
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

  int Reentry = AUTOMATIC_REENTRY;
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
