// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraProjectionMapper
 * @brief   direct volume rendering of unstructured grids by projected tetrahedra, without artifacts
 *
 * Draws each cell's silhouette as triangles in visibility order. Each fragment finds where its ray
 * enters and leaves the cell, with which scalars, and what that adds to the picture (Kraus et al.,
 * Projecting Tetrahedra without Rendering Artifacts, 2004). With the defaults the picture is that
 * of ray casting, except for cells that occlude each other in a cycle, and for the colours of cells
 * that overlap: the order of cells is one for all rays, see VisibilityOrder. Each of the paper's
 * corrections can be turned off, so that its artifact can be studied:
 *
 * - perspective interpolation (section 2): PerspectiveInterpolation;
 * - the table's texels and its logarithmic scale (section 3): TableFormat and TableLengthScale,
 *   with IntegrationToTable; by default there is no table if the integral has a cheap closed form;
 * - compositing (section 4): ColorBuffer, and AlphaDithering for the 8-bit buffer.
 *
 * Cells are drawn in parts, one for each interval of the transfer function that they have a part
 * in: the same picture in less time. They are drawn as they are where they would have more than 1.8
 * parts on the average, where a part is so thick that it would be cut into more than 32 slices,
 * where thick parts are cropped, with lights, with scalars of cells, with a table, and with a
 * ColorBuffer that is not of 32-bit floats. GetStatistics() says why, and has the time of dividing
 * cells for a new function ("divide") and of waiting for cells to be projected ("project").
 *
 * Order is the visibility order; models whose contributions commute need none. Cells that can't be
 * seen are neither ordered nor drawn. See vtkTetrahedraVolumeMapper for the input, the optical
 * models and their properties; Reentry is not one of this mapper's.
 *
 * Needs OpenGL 3.2 and draws on a graphics card or in software.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkTetrahedraGPURayCastMapper, vtkProjectedTetrahedraMapper
 */
#ifndef vtkTetrahedraProjectionMapper_h
#define vtkTetrahedraProjectionMapper_h

#include "TetraluxRenderingModule.h"          // For export macro
#include "vtkMeshedPolyhedraVisibilitySort.h" // For VisibilityOrder
#include "vtkSmartPointer.h"                  // For VisibilitySort
#include "vtkTetrahedraOpenGLMapper.h"

#include <memory> // For std::unique_ptr

class TETRALUXRENDERING_EXPORT vtkTetrahedraProjectionMapper : public vtkTetrahedraOpenGLMapper
{
public:
  static vtkTetrahedraProjectionMapper* New();
  vtkTypeMacro(vtkTetrahedraProjectionMapper, vtkTetrahedraOpenGLMapper);

  ///@{
  /**
   * Set whether depths and scalars are interpolated with perspective correction (Kraus et al. 2004,
   * section 2.2). Default on. Off: they are interpolated linearly on the screen, as by
   * vtkProjectedTetrahedraMapper, and cells that reach behind the camera are left out. A parallel
   * projection is the same with both.
   *
   * @warning Off is wrong in a perspective, the more the nearer a cell is.
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
   * Set the format that colours are composited in by the hardware's blending (Kraus et al. 2004,
   * section 4.1): 32-bit floats, 16-bit floats, or 8 bits a channel. Default AUTOMATIC_BUFFER:
   * 16-bit floats if their rounding is within a quarter of MaximumError, else 32-bit floats.
   * Without absorption colours may come above 1, and are rounded in proportion; 16 bits hold up to
   * 65504.
   * Colours of 32-bit floats are composited front to back, which keeps the smallest opacities. The
   * others are composited back to front, where rounding does less harm.
   */
  virtual void SetColorBuffer(int buffer);
  vtkGetMacro(ColorBuffer, int);
  const char* GetColorBufferAsString();
  void SetColorBufferToAutomatic() { this->SetColorBuffer(AUTOMATIC_BUFFER); }
  void SetColorBufferToFloat() { this->SetColorBuffer(FLOAT_BUFFER); }
  void SetColorBufferToHalf() { this->SetColorBuffer(HALF_BUFFER); }
  void SetColorBufferToUNorm8() { this->SetColorBuffer(UNORM8_BUFFER); }
  ///@}

  ///@{
  /**
   * Set whether opacities may be rounded to 8 bits up or down at random instead of to the nearest
   * (Kraus et al. 2004, section 4.2), if ColorBuffer is UNORM8_BUFFER; without absorption it is
   * colours that are. Default on: where it makes the picture better. That is measured on a sample
   * of rays, since what the graphics card blends with is rounded to the nearest in any case, which
   * random opacities can't make good; GetStatistics() has both errors. The random numbers belong to
   * pixels and cells, so frames of the same view are the same.
   */
  vtkSetMacro(AlphaDithering, vtkTypeBool);
  vtkGetMacro(AlphaDithering, vtkTypeBool);
  vtkBooleanMacro(AlphaDithering, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set the visibility order that cells are composited in, one of
   * vtkMeshedPolyhedraVisibilitySort::VisibilityOrder, which has what each of them does. Default
   * AUTOMATIC_ORDER: exact, by what costs less, without a warning. EXACT_ORDER makes the mesh
   * convex in the first frame (see vtkConvexifyTetrahedra), which takes longer than that frame, and
   * saves some of each later one. It warns once, and says why, if neither the convex mesh nor
   * ACROSS_GAPS_ORDER is possible and the order is that of NON_CONVEX_ORDER.
   *
   * GetUsedOrder() returns the order of the last frame: AUTOMATIC_ORDER before the first frame, and
   * if the cells' contributions commute and need no order ("none" as a string).
   *
   * @warning Cells that occlude each other in a cycle have no right order. GetStatistics() counts
   * them; vtkMeshedPolyhedraVisibilitySort, given the same input, camera and matrix, names them.
   */
  virtual void SetOrder(int order);
  vtkGetMacro(Order, int);
  const char* GetOrderAsString();
  void SetOrderToAutomatic() { this->SetOrder(vtkMeshedPolyhedraVisibilitySort::AUTOMATIC_ORDER); }
  void SetOrderToExact() { this->SetOrder(vtkMeshedPolyhedraVisibilitySort::EXACT_ORDER); }
  void SetOrderToAcrossGaps()
  {
    this->SetOrder(vtkMeshedPolyhedraVisibilitySort::ACROSS_GAPS_ORDER);
  }
  void SetOrderToNonConvex() { this->SetOrder(vtkMeshedPolyhedraVisibilitySort::NON_CONVEX_ORDER); }
  void SetOrderToCentroid() { this->SetOrder(vtkMeshedPolyhedraVisibilitySort::CENTROID_ORDER); }
  int GetUsedOrder();
  const char* GetUsedOrderAsString();
  ///@}

  ///@{
  /**
   * Another name of Order, for programs that sort by VTK's classes: a
   * vtkMeshedPolyhedraVisibilitySort sets its own Order, vtkCellCenterDepthSort sets
   * CENTROID_ORDER, and no sort the default. Any other class gives one warning and leaves Order as
   * it is. GetVisibilitySort() returns what was set, or nullptr. Default nullptr.
   */
  void SetVisibilitySort(vtkVisibilitySort* sort) override;
  vtkVisibilitySort* GetVisibilitySort() override;
  ///@}

  ///@{
  /**
   * Another name of ColorBuffer: off is UNORM8_BUFFER, on is AUTOMATIC_BUFFER unless floats are
   * chosen already. Default on.
   */
  void SetUseFloatingPointFrameBuffer(bool use) override;
  bool GetUseFloatingPointFrameBuffer() override { return this->ColorBuffer != UNORM8_BUFFER; }
  ///@}

protected:
  vtkTetrahedraProjectionMapper();
  ~vtkTetrahedraProjectionMapper() override;

  void DrawFrame(tetralux::MapperFrame& frame) override;
  void ReleaseResources(vtkWindow* window) override;
  void PrintProperties(ostream& os, vtkIndent indent) override;
  void PrintResults(ostream& os, vtkIndent indent) override;

  vtkTypeBool PerspectiveInterpolation = 1;
  int ColorBuffer = AUTOMATIC_BUFFER;
  vtkTypeBool AlphaDithering = 1;
  int Order = vtkMeshedPolyhedraVisibilitySort::AUTOMATIC_ORDER;
  vtkSmartPointer<vtkVisibilitySort> VisibilitySort;

private:
  vtkTetrahedraProjectionMapper(const vtkTetrahedraProjectionMapper&) = delete;
  void operator=(const vtkTetrahedraProjectionMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
