// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshedPolyhedraVisibilitySort
 * @brief   exact back-to-front visibility order of tetrahedra (MPVO, Williams 1992)
 *
 * For vtkProjectedTetrahedraMapper::SetVisibilitySort, and for other code that draws cells one
 * after the other. Occluded cells come before the cells that occlude them (BACK_TO_FRONT) or after
 * them (FRONT_TO_BACK). VTK's own vtkCellCenterDepthSort orders by the depths of the cells'
 * centers, which is wrong if neighbours differ in size or shape.
 *
 * Meshed polyhedra visibility ordering (Williams, Visibility Ordering Meshed Polyhedra, 1992): for
 * each face that two cells have in common, an exact sign tells which of them is in front. Across
 * empty space it is told by pairs of boundary faces of which rays leave by one and enter by the
 * other; or imaginary cells fill the space between the boundary and its hull, are sorted with the
 * others and are not returned. Cells that occlude each other in a cycle have no right
 * order: they are counted and named, and the faces that look smallest are ignored. Cells that touch
 * without sharing points are ordered by what lies behind each boundary face. A viewer on an edge or
 * a face of such cells, or cells a millionth as thick as wide, may close a cycle of them.
 *
 * Accepts a data set whose volumes are tetrahedra; refuses others (vtkTetrahedralizeCells makes
 * tetrahedra of them), since cells of other kinds need not have an order at all. Returns cells by
 * their ids, each once. Skips cells that are no volumes, that are blanked, ghosts or unusable
 * (point ids that do not exist, coordinates that are not finite, the same four points for a second
 * time), as vtkTetrahedraRayCastMapper does.
 *
 * Camera may make any projection that vtkCamera can; without one the view is along -z, from far
 * away. ModelTransform must be affine and invertible. An input that can't be used, and a camera or
 * transform that are singular, give one error and no cells.
 *
 * The tables of the mesh are cached until the input is modified: the first traversal of an input
 * takes about half a microsecond a cell (with imaginary cells some, see vtkConvexifyTetrahedra),
 * each later one about 0.1. The order does not depend on the number of threads.
 *
 * @sa vtkConvexifyTetrahedra, vtkTetrahedraProjectionMapper
 */
#ifndef vtkMeshedPolyhedraVisibilitySort_h
#define vtkMeshedPolyhedraVisibilitySort_h

#include "TetraluxRenderingModule.h"
#include "vtkVisibilitySort.h"

#include <memory> // for std::unique_ptr

class vtkIdList;

namespace tetralux
{
enum class OrderWish;
enum class VisibilityMethod;
} // namespace tetralux

class TETRALUXRENDERING_EXPORT vtkMeshedPolyhedraVisibilitySort : public vtkVisibilitySort
{
public:
  static vtkMeshedPolyhedraVisibilitySort* New();
  vtkTypeMacro(vtkMeshedPolyhedraVisibilitySort, vtkVisibilitySort);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Visibility orders. vtkTetrahedraProjectionMapper has the same ones.
   *
   * - AUTOMATIC_ORDER: exact, by what costs less. As ACROSS_GAPS_ORDER, and as EXACT_ORDER from
   *   where on a view had too many pairs, or pairs that took longer to find than all else.
   * - EXACT_ORDER: by the common faces of the mesh, made convex by imaginary cells. If it can't be
   *   made convex (GetRefusal() says why), as ACROSS_GAPS_ORDER.
   * - ACROSS_GAPS_ORDER: exact for any mesh, by common faces and by all pairs of boundary faces
   *   such that rays leave the mesh by one and enter it by the other. The pairs are found anew for
   *   each view: of most meshes as fast as all else, but not where rays leave and enter again and
   *   again. If there are more than 64 for each boundary face, as NON_CONVEX_ORDER.
   * - NON_CONVEX_ORDER: Williams' MPVONC. Exact across common faces, and so for convex meshes;
   *   across empty space a guess from the distances of centroids. Makes no imaginary cells, which
   *   takes seconds for a mesh with hundreds of thousands of boundary faces.
   * - CENTROID_ORDER: by the distances of the cells' centroids from the eye (along the view, in a
   *   parallel projection). The fastest, and inexact everywhere.
   */
  enum VisibilityOrder
  {
    AUTOMATIC_ORDER,
    EXACT_ORDER,
    ACROSS_GAPS_ORDER,
    NON_CONVEX_ORDER,
    CENTROID_ORDER
  };

  ///@{
  /**
   * Set the visibility order, one of VisibilityOrder; any other number is refused with an error.
   * Default AUTOMATIC_ORDER.
   */
  virtual void SetOrder(int order);
  vtkGetMacro(Order, int);
  const char* GetOrderAsString();
  void SetOrderToAutomatic() { this->SetOrder(AUTOMATIC_ORDER); }
  void SetOrderToExact() { this->SetOrder(EXACT_ORDER); }
  void SetOrderToAcrossGaps() { this->SetOrder(ACROSS_GAPS_ORDER); }
  void SetOrderToNonConvex() { this->SetOrder(NON_CONVEX_ORDER); }
  void SetOrderToCentroid() { this->SetOrder(CENTROID_ORDER); }
  ///@}

  /**
   * Sort, for the current input, camera, transform and direction.
   */
  void InitTraversal() override;

  /**
   * Return the ids of the next cells, MaxCellsReturned at most; nullptr after the last one.
   */
  vtkIdTypeArray* GetNextCells() override;

  ///@{
  /**
   * Return what the last InitTraversal found. A cycle is a set of cells, imaginary ones among them,
   * in which each cell occludes the next and the last occludes the first. Ignored faces are those
   * (or pairs of them across a gap) that the order passes in the wrong direction. Their area is how
   * large they look: the solid angle in a perspective view, the projected area in squared units of
   * the input in a parallel one. CENTROID_ORDER finds none, since it does not look for them.
   */
  vtkIdType GetNumberOfCycles();
  vtkIdType GetNumberOfIgnoredFaces();
  double GetIgnoredArea();
  ///@}

  /**
   * Fill cells with the ids of those in a cycle, counted from 0. The order of all other cells is
   * right.
   */
  void GetCycle(vtkIdType cycle, vtkIdList* cells);

  ///@{
  /**
   * Return the order that the last InitTraversal used; AUTOMATIC_ORDER before the first.
   */
  vtkGetMacro(UsedOrder, int);
  const char* GetUsedOrderAsString();
  ///@}

  /**
   * Return why the input could not be made convex, and where; empty if it could or if that was not
   * asked for.
   */
  const char* GetRefusal();

#ifndef __VTK_WRAP__
  ///@{
  /**
   * For C++ code: what an order is in Tetralux::Core, and the order that a method makes.
   */
  static tetralux::OrderWish GetWishOf(int order);
  static int GetOrderOf(tetralux::VisibilityMethod method);
  ///@}
#endif

protected:
  vtkMeshedPolyhedraVisibilitySort();
  ~vtkMeshedPolyhedraVisibilitySort() override;

private:
  vtkMeshedPolyhedraVisibilitySort(const vtkMeshedPolyhedraVisibilitySort&) = delete;
  void operator=(const vtkMeshedPolyhedraVisibilitySort&) = delete;

  /// Both throw with one line that says what is wrong.
  void UpdateTables();
  void Sort();

  int Order = AUTOMATIC_ORDER;
  int UsedOrder = AUTOMATIC_ORDER;

  struct Internals;
  std::unique_ptr<Internals> Tables;
};

#endif
