// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshedPolyhedraVisibilitySort
 * @brief   the order in which cells have to be drawn, exactly
 *
 * For vtkProjectedTetrahedraMapper::SetVisibilitySort, and whoever else draws cells one after the
 * other: cells that are hidden come before those that hide them (BACK_TO_FRONT), or behind
 * (FRONT_TO_BACK). VTK's own vtkCellCenterDepthSort orders by the depths of the cells' centers, which
 * is wrong wherever neighbours differ in size or shape.
 *
 * Meshed polyhedra visibility ordering (Williams, Visibility Ordering Meshed Polyhedra, 1992): the
 * faces that cells have in common tell which of them is in front, by exact signs; for a mesh that is
 * not convex, the space between its boundary and its hull is filled with imaginary cells, which are
 * sorted with the others and not returned. Where cells hide each other in a circle there is no right
 * order; such cells are counted and named, and the faces that look smallest are ignored.
 *
 * Input is a data set whose volumes are tetrahedra; others are refused (vtkTetrahedraFilter makes
 * tetrahedra of them), since cells of any other kind need not have an order at all. Cells are returned
 * by their ids, each once. Not returned are cells that are no volumes, that are blanked, ghosts or
 * unusable (point ids that do not exist, coordinates that are not finite, the same four points for a
 * second time), as in vtkTetrahedraRayCastMapper.
 *
 * Camera may make any projection that vtkCamera can; without one the view is along -z, from far
 * away. ModelTransform must be affine and invertible. An input that can't be used, and a camera or
 * transform that are singular, give one error and no cells.
 *
 * The tables of the mesh are kept until the input is modified: the first traversal of an input takes
 * some microseconds a cell (with imaginary cells, see vtkConvexifyTetrahedra), each later one about
 * 0.1. The order does not depend on the number of threads.
 *
 * @sa vtkConvexifyTetrahedra, vtkTetrahedraProjectionMapper
 */
#ifndef vtkMeshedPolyhedraVisibilitySort_h
#define vtkMeshedPolyhedraVisibilitySort_h

#include "TetraluxRenderingModule.h"
#include "vtkVisibilitySort.h"

#include <memory> // for std::unique_ptr

class vtkIdList;

class TETRALUXRENDERING_EXPORT vtkMeshedPolyhedraVisibilitySort : public vtkVisibilitySort
{
public:
  static vtkMeshedPolyhedraVisibilitySort* New();
  vtkTypeMacro(vtkMeshedPolyhedraVisibilitySort, vtkVisibilitySort);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * CONVEXIFIED: exact, see above; where the mesh can't be made convex (GetRefusal), as ACROSS_GAPS.
   * ACROSS_GAPS: exact for any mesh, by all pairs of boundary faces of which rays leave the mesh by one
   * and enter it by the other. They are found anew for each view, which takes several times what all
   * else takes. Where there are more than 64 for each boundary face, as NON_CONVEX.
   * NON_CONVEX: Williams' MPVONC. Exact across the faces that cells have in common, and so for convex
   * meshes; across empty space a guess from the distances of centroids. No imaginary cells are made,
   * which takes seconds for a mesh with hundreds of thousands of boundary faces.
   * CENTROID_DISTANCE: by the distances of the cells' centroids from the eye (along the view, in a
   * parallel projection): the fastest, and inexact everywhere.
   */
  enum Orders
  {
    CONVEXIFIED = 0,
    ACROSS_GAPS = 1,
    NON_CONVEX = 2,
    CENTROID_DISTANCE = 3
  };

  ///@{
  /**
   * By what cells are ordered, CONVEXIFIED by default.
   */
  vtkSetClampMacro(Order, int, CONVEXIFIED, CENTROID_DISTANCE);
  vtkGetMacro(Order, int);
  void SetOrderToConvexified() { this->SetOrder(CONVEXIFIED); }
  void SetOrderToAcrossGaps() { this->SetOrder(ACROSS_GAPS); }
  void SetOrderToNonConvex() { this->SetOrder(NON_CONVEX); }
  void SetOrderToCentroidDistance() { this->SetOrder(CENTROID_DISTANCE); }
  ///@}

  /**
   * Sorts, for the input, the camera, the transform and the direction of now.
   */
  void InitTraversal() override;

  /**
   * The ids of the next cells, MaxCellsReturned at most; nullptr after the last one.
   */
  vtkIdTypeArray* GetNextCells() override;

  ///@{
  /**
   * What the last InitTraversal found. Cycles: sets of cells that hide each other in a circle, over
   * imaginary cells, too; ignored faces (or pairs of them across a gap): those that are passed in the wrong direction to have an order
   * at all, and how large they look (in a perspective view their solid angle, in a parallel one their
   * projected area in units of the input). None with CENTROID_DISTANCE, which does not look for them.
   */
  vtkIdType GetNumberOfCycles();
  vtkIdType GetNumberOfIgnoredFaces();
  double GetIgnoredArea();
  ///@}

  /**
   * Fills cells with the ids of those in one of the cycles. Where only other cells are seen, the order
   * is right.
   */
  void GetCycle(vtkIdType cycle, vtkIdList* cells);

  /**
   * Which of Orders was used in the last InitTraversal.
   */
  vtkGetMacro(UsedOrder, int);

  /**
   * Why the input could not be made convex, and where; empty where it could, or where that was not
   * asked for.
   */
  const char* GetRefusal();

protected:
  vtkMeshedPolyhedraVisibilitySort();
  ~vtkMeshedPolyhedraVisibilitySort() override;

private:
  vtkMeshedPolyhedraVisibilitySort(const vtkMeshedPolyhedraVisibilitySort&) = delete;
  void operator=(const vtkMeshedPolyhedraVisibilitySort&) = delete;

  /// Both throw with one line that says what is wrong.
  void UpdateTables();
  void Sort();

  int Order = CONVEXIFIED;
  int UsedOrder = CONVEXIFIED;

  struct Internals;
  std::unique_ptr<Internals> Tables;
};

#endif
