// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_DataSetCheck_h
#define tetralux_DataSetCheck_h

#include "TetraluxFiltersModule.h"

#include <string>

class vtkDataSet;
class vtkUnstructuredGrid;

namespace tetralux
{

/// Whether a data set has the points and types of the cells that it says it has, which VTK takes
/// for granted: readers of damaged files leave it otherwise. Returns one line that says what is
/// wrong, empty where nothing is. Constant time; ids of points are not looked at.
TETRALUXFILTERS_EXPORT std::string FindDamage(vtkDataSet* dataSet);

/// The same, and whether each cell's list of points is within the array of them: for those that
/// read cells by VTK's functions, which do not look. Linear time.
TETRALUXFILTERS_EXPORT std::string FindDamageOfCells(vtkUnstructuredGrid* grid);

} // namespace tetralux

#endif
