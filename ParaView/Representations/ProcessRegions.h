// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ProcessRegions_h
#define tetralux_ProcessRegions_h

#include "Geometry/SeparatingPlanes.h"

#include <array>
#include <memory>

class vtkUnstructuredGrid;

namespace tetralux
{

/// Where the data of all processes are.
struct ProcessRegions
{
  /// Between the data of all processes; nullptr if no planes part them.
  std::shared_ptr<const SeparatingPlanes> Planes;

  /// Whether each process has cells.
  bool AllHaveCells = false;

  /// What the planes leave this process of the box around all data; these parts fill the box. With
  /// oblique planes, or none, the bounds of its own data. In coordinates of the data.
  std::array<double, 6> Bounds;
};

/// Looks for planes between the data of processes; to be called by all of them at once. Ghost cells
/// and blanked cells do not count, since they are not drawn. Cells with curved faces are not looked
/// at: there are no planes if any process has some. oblique: planes may have any normal, else only
/// those of axes.
ProcessRegions FindProcessRegions(vtkUnstructuredGrid* mine, bool oblique);

} // namespace tetralux

#endif
