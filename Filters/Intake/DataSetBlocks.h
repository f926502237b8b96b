// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_DataSetBlocks_h
#define tetralux_DataSetBlocks_h

#include "TetraluxFiltersModule.h"

#include <cstdint>
#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace tetralux
{

/// One data set of an input and where its ids start in the concatenation of all.
struct DataSetBlock
{
  vtkDataSet* DataSet;
  std::int64_t FirstPoint;
  std::int64_t FirstCell;
};

/// The data sets of an input in the order in which their points and cells are numbered: the input
/// itself, or the leaves of a composite in traversal order without those that are missing or no
/// data sets; without explicit structured grids that have no cells. skippedBlocks, where not null,
/// receives the number of leaves that are no data sets.
TETRALUXFILTERS_EXPORT std::vector<DataSetBlock> CollectDataSets(
  vtkDataObject* input, std::int64_t* skippedBlocks = nullptr);

} // namespace tetralux

#endif
