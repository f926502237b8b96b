// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceScene_h
#define tetralux_IsosurfaceScene_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDoubleArray;
class vtkUnstructuredGrid;

namespace tetralux
{

/// Tetrahedra with scalars at points, and what these become.
struct IsosurfaceScene
{
  vtkSmartPointer<vtkUnstructuredGrid> Grid; ///< its active scalars are Steps.front()
  std::vector<vtkSmartPointer<vtkDoubleArray>> Steps;
  std::vector<double> Isovalues; ///< the one that is asked for, and neighbours
};

/// Makes a scene of a generator, as "ring" or "ring:around=600,across=32", or reads a file. Cells
/// of a file that are no tetrahedra are split. array: of a file's points; empty: ChooseArray's
/// choice. Steps are moments of a generator that has a time, else the scalars with an offset.
/// Throws UsageError and WorkError.
IsosurfaceScene MakeIsosurfaceScene(
  const std::string& mesh, const std::string& array, double isovalue);

} // namespace tetralux

#endif
