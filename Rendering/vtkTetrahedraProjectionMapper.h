// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraProjectionMapper
 * @brief   direct volume rendering of unstructured grids by projected tetrahedra, without artifacts
 *
 * Draws each cell's silhouette as triangles, in order of visibility, and lets each fragment find
 * where its ray enters and leaves the cell, with which scalars, and what that adds to the picture
 * (Kraus et al., Projecting Tetrahedra without Rendering Artifacts, 2004). With everything on, as
 * it is by default, the picture is that of ray casting, up to the order of cells that hide each
 * other in a cycle. Each of the paper's corrections can be turned off, so that its artifact can be
 * studied:
 *
 * - perspective interpolation (section 2): PerspectiveInterpolation;
 * - the table's texels and its logarithmic scale (section 3): TableFormat and TableLengthScale, with
 *   IntegrationToTable; by default there is no table where the integral has a cheap closed form;
 * - compositing (section 4): ColorBuffer, and AlphaDithering for the 8-bit buffer.
 *
 * The order of cells is by VisibilityOrder; models whose light adds up in any order have none.
 * Cells that nothing can be seen of are neither ordered nor drawn. Input, optical models and what
 * they are set by: see vtkTetrahedraVolumeMapper.
 *
 * Needs OpenGL 3.2 and draws on a graphics card or in software.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkTetrahedraGPURayCastMapper, vtkProjectedTetrahedraMapper
 */
#ifndef vtkTetrahedraProjectionMapper_h
#define vtkTetrahedraProjectionMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkTetrahedraVolumeMapper.h"

#include <memory> // For std::unique_ptr

class TETRALUXRENDERING_EXPORT vtkTetrahedraProjectionMapper : public vtkTetrahedraVolumeMapper
{
public:
  static vtkTetrahedraProjectionMapper* New();
  vtkTypeMacro(vtkTetrahedraProjectionMapper, vtkTetrahedraVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether depths and scalars are interpolated with perspective correction (section 2.2 of the
   * paper); on by default. Off, they are interpolated linearly on the screen, as by
   * vtkProjectedTetrahedraMapper: wrong in a perspective, the more the nearer a cell is, and cells
   * that reach behind the camera are left out. A parallel projection is the same with both.
   */
  vtkSetMacro(PerspectiveInterpolation, vtkTypeBool);
  vtkGetMacro(PerspectiveInterpolation, vtkTypeBool);
  vtkBooleanMacro(PerspectiveInterpolation, vtkTypeBool);
  ///@}

  enum ColorBufferType
  {
    AUTOMATIC_BUFFER,
    FLOAT_BUFFER,
    HALF_BUFFER,
    UNORM8_BUFFER
  };

  ///@{
  /**
   * What colours are composited in, by the hardware's blending (section 4.1 of the paper): 32-bit
   * floats, 16-bit floats, or 8 bits a channel. Automatic (default): 16-bit floats where their
   * rounding stays within a quarter of MaximumError, else 32-bit floats. 32-bit floats are
   * composited front to back, which keeps the smallest opacities; the others back to front, where
   * rounding does less harm.
   */
  vtkSetClampMacro(ColorBuffer, int, AUTOMATIC_BUFFER, UNORM8_BUFFER);
  vtkGetMacro(ColorBuffer, int);
  void SetColorBufferToAutomatic() { this->SetColorBuffer(AUTOMATIC_BUFFER); }
  void SetColorBufferToFloat() { this->SetColorBuffer(FLOAT_BUFFER); }
  void SetColorBufferToHalf() { this->SetColorBuffer(HALF_BUFFER); }
  void SetColorBufferToUNorm8() { this->SetColorBuffer(UNORM8_BUFFER); }
  ///@}

  ///@{
  /**
   * Whether opacities are rounded to 8 bits up or down at random instead of to the nearest (section
   * 4.2 of the paper), where ColorBuffer is UNORM8_BUFFER; on by default. The random numbers belong
   * to pixels and cells, so frames of the same view are the same.
   */
  vtkSetMacro(AlphaDithering, vtkTypeBool);
  vtkGetMacro(AlphaDithering, vtkTypeBool);
  vtkBooleanMacro(AlphaDithering, vtkTypeBool);
  ///@}

  enum OrderType
  {
    AUTOMATIC_ORDER,
    EXACT_ORDER,
    NON_CONVEX_ORDER,
    CENTROID_ORDER
  };

  ///@{
  /**
   * In which order cells are composited; see VisibilityOrder and vtkMeshedPolyhedraVisibilitySort,
   * which has the same orders for VTK's own mapper. EXACT_ORDER: by common faces, after the mesh
   * was made convex by imaginary cells in the first frame (see vtkConvexifyTetrahedra); where it
   * can't be, by common faces, and by all pairs of boundary faces that rays leave and enter it by,
   * which takes several times as long; where these are too many, as NON_CONVEX_ORDER, and one
   * warning says why. NON_CONVEX_ORDER: by common faces, and a guess across empty space (MPVONC of
   * Williams 1992). CENTROID_ORDER: by distance of centroids, the fastest, and wrong here and
   * there. AUTOMATIC_ORDER (default): as EXACT_ORDER, without the warning. Cells that hide each
   * other in a cycle have no right order; GetStatistics() counts them, and
   * vtkMeshedPolyhedraVisibilitySort, given the same input, camera and matrix, names them. Optical
   * models whose contributions commute need no order and have none.
   */
  vtkSetClampMacro(Order, int, AUTOMATIC_ORDER, CENTROID_ORDER);
  vtkGetMacro(Order, int);
  void SetOrderToAutomatic() { this->SetOrder(AUTOMATIC_ORDER); }
  void SetOrderToExact() { this->SetOrder(EXACT_ORDER); }
  void SetOrderToNonConvex() { this->SetOrder(NON_CONVEX_ORDER); }
  void SetOrderToCentroid() { this->SetOrder(CENTROID_ORDER); }
  ///@}

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   */
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkTetrahedraProjectionMapper();
  ~vtkTetrahedraProjectionMapper() override;

  void DrawFrame(tetralux::MapperFrame& frame) override;

  vtkTypeBool PerspectiveInterpolation = 1;
  int ColorBuffer = AUTOMATIC_BUFFER;
  vtkTypeBool AlphaDithering = 1;
  int Order = AUTOMATIC_ORDER;

private:
  vtkTetrahedraProjectionMapper(const vtkTetrahedraProjectionMapper&) = delete;
  void operator=(const vtkTetrahedraProjectionMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
