// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/DataSetBlocks.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkSmartPointer.h"

namespace tetralux
{

std::vector<DataSetBlock> CollectDataSets(vtkDataObject* input, std::int64_t* skippedBlocks)
{
  std::vector<DataSetBlock> blocks;
  std::int64_t points = 0;
  std::int64_t cells = 0;
  std::int64_t skipped = 0;
  const auto add = [&](vtkDataObject* object)
  {
    auto* grid = vtkExplicitStructuredGrid::SafeDownCast(object);
    if (grid && !grid->GetCells())
    {
      return; // it says that it has a cell
    }
    if (auto dataSet = vtkDataSet::SafeDownCast(object))
    {
      blocks.push_back({ dataSet, points, cells });
      points += dataSet->GetNumberOfPoints();
      cells += dataSet->GetNumberOfCells();
    }
    else
    {
      ++skipped;
    }
  };

  if (auto composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    iterator->SkipEmptyNodesOn();
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      add(iterator->GetCurrentDataObject());
    }
  }
  else if (input)
  {
    add(input);
  }
  if (skippedBlocks)
  {
    *skippedBlocks = skipped;
  }
  return blocks;
}

} // namespace tetralux
