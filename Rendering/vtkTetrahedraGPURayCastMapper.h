// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraGPURayCastMapper
 * @brief   direct volume rendering of unstructured grids by cell-to-cell ray casting on the GPU
 *
 * Renders what vtkTetrahedraRayCastMapper renders, in the same way, on the graphics card (Weiler et
 * al. 2003): the mesh lies in texture buffers, 32 bytes a tetrahedron and 16 a point, and rays go from
 * cell to cell in passes of a bounded number of steps. Input, optical models and what they are set by:
 * see vtkTetrahedraVolumeMapper. OpenGL 3.2 with GLSL 1.50 is enough.
 *
 * Each ray finds its way by exact signs in whole numbers: none is lost or counted twice at faces, edges
 * and vertices, on any graphics card. Geometry is in single precision, which GetErrorEstimate() tells
 * the error of; a mesh whose size in the world is beyond its range is refused.
 *
 * A mesh has at most a quarter as many tetrahedra as the driver's texture buffers have texels (2^27 on
 * most), and fits into free memory where the driver tells how much there is; both are looked at before
 * anything is sent, and missed ones are one error. Only what changed is sent: topology, or points with
 * their scalars. The picture is read back when GetOutputImage() asks for it; its Depth is, where
 * segments are looked up in a table, that of the first cell that contributes.
 *
 * @sa vtkTetrahedraRayCastMapper
 */
#ifndef vtkTetrahedraGPURayCastMapper_h
#define vtkTetrahedraGPURayCastMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkTetrahedraVolumeMapper.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkRenderWindow;

class TETRALUXRENDERING_EXPORT vtkTetrahedraGPURayCastMapper : public vtkTetrahedraVolumeMapper
{
public:
  static vtkTetrahedraGPURayCastMapper* New();
  vtkTypeMacro(vtkTetrahedraGPURayCastMapper, vtkTetrahedraVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ReentryType
  {
    AUTOMATIC_REENTRY,
    BOUNDARY_HIERARCHY,
    IMAGINARY_CELLS,
    BOUNDARY_LAYERS,
    NO_REENTRY
  };

  ///@{
  /**
   * How rays find where they enter the mesh, for the first time and, where they left it, again. By a
   * hierarchy over its boundary faces, between passes. By drawing all boundary faces, layer after layer
   * (depth peeling), which takes the hierarchy's place where the mesh reaches through the plane of the
   * eye. Through imaginary cells between the mesh and its convex hull (Weiler et al. 2003, section 3.4,
   * see vtkConvexifyTetrahedra), which are made in the first frame that needs them, and which
   * transparent cells are not left out with. Or not again at all, which is right for convex meshes only.
   * Each of them decides by the same exact signs as the walk. Automatic (default): not again where the
   * mesh is convex and all of it is walked through, else by the hierarchy. A mesh that can't be made
   * convex is entered by its boundary, and one warning says why.
   */
  vtkSetClampMacro(Reentry, int, AUTOMATIC_REENTRY, NO_REENTRY);
  vtkGetMacro(Reentry, int);
  void SetReentryToAutomatic() { this->SetReentry(AUTOMATIC_REENTRY); }
  void SetReentryToBoundaryHierarchy() { this->SetReentry(BOUNDARY_HIERARCHY); }
  void SetReentryToImaginaryCells() { this->SetReentry(IMAGINARY_CELLS); }
  void SetReentryToBoundaryLayers() { this->SetReentry(BOUNDARY_LAYERS); }
  void SetReentryToNone() { this->SetReentry(NO_REENTRY); }
  ///@}

  ///@{
  /**
   * Cells that a ray goes through in one pass at most, 1..65535, default 128. A pass is one draw call:
   * fewer steps make an abort sooner and keep a slow graphics card's watchdog quiet, more save passes.
   * The picture does not depend on it.
   */
  vtkSetClampMacro(StepsPerPass, int, 1, 65535);
  vtkGetMacro(StepsPerPass, int);
  ///@}

  ///@{
  /**
   * Whether GetStatistics() has the number of rays of every pass. That takes waiting for each pass
   * before the next. Off by default: it has those that were known without waiting.
   */
  vtkSetMacro(CountFragments, vtkTypeBool);
  vtkGetMacro(CountFragments, vtkTypeBool);
  vtkBooleanMacro(CountFragments, vtkTypeBool);
  ///@}

  /**
   * Whether frames in a window are drawn by a graphics card that can do it, and would be by this mapper
   * faster than by vtkTetrahedraRayCastMapper: false where OpenGL lacks something and where it is
   * software. Makes the window's context where there is none. GetSupportReason() then says why, or
   * which graphics card it is.
   */
  bool IsSupported(vtkRenderWindow* window);
  std::string GetSupportReason();

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   */
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkTetrahedraGPURayCastMapper();
  ~vtkTetrahedraGPURayCastMapper() override;

  void DrawFrame(tetralux::MapperFrame& frame) override;

  int Reentry = AUTOMATIC_REENTRY;
  int StepsPerPass = 128;
  vtkTypeBool CountFragments = 0;

private:
  vtkTetrahedraGPURayCastMapper(const vtkTetrahedraGPURayCastMapper&) = delete;
  void operator=(const vtkTetrahedraGPURayCastMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
