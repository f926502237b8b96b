// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SurfaceExtraction_h
#define tetralux_SurfaceExtraction_h

#include "vtkNew.h"

class vtkContour3DLinearGrid;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace tetralux
{

/// Whether cells are found by a tree over their scalars.
enum class ScalarTree
{
  Off, ///< all cells are looked at
  On   ///< VTK's span space, which is made anew for new scalars
};

/// The triangles of an isosurface by VTK's threads, on its fast path: each has points of its own,
/// in single precision, and no normals.
class SurfaceExtraction
{
public:
  SurfaceExtraction(vtkUnstructuredGrid* grid, ScalarTree tree);
  ~SurfaceExtraction();
  SurfaceExtraction(const SurfaceExtraction&) = delete;
  SurfaceExtraction& operator=(const SurfaceExtraction&) = delete;

  void SetIsovalue(double isovalue);

  /// Extracts the surface if isovalue or scalars are new. Returns the seconds.
  double Update();

  vtkPolyData* GetSurface() const;

private:
  vtkNew<vtkContour3DLinearGrid> Filter;
};

} // namespace tetralux

#endif
