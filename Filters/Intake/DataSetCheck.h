// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_DataSetCheck_h
#define tetralux_DataSetCheck_h

#include "TetraluxFiltersModule.h"

#include <string>

class vtkDataSet;

namespace tetralux
{

/// Whether a data set has the points and types of the cells that it says it has, which VTK takes
/// for granted: readers of damaged files leave it otherwise. Returns one line that says what is
/// wrong, empty where nothing is. Constant time; ids of points are not looked at.
TETRALUXFILTERS_EXPORT std::string FindDamage(vtkDataSet* dataSet);

} // namespace tetralux

#endif
