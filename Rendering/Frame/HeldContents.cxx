// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/HeldContents.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkExplicitStructuredGrid.h"

namespace tetralux
{

vtkSmartPointer<vtkDataObject> HoldContents(vtkDataObject* data)
{
  if (!data)
  {
    return nullptr;
  }
  auto held = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    // Without cells its extent was never set, and a copy would allocate cells by it.
    auto* grid = vtkExplicitStructuredGrid::SafeDownCast(data);
    if (!grid || grid->GetCells())
    {
      held->ShallowCopy(data);
    }
    return held;
  }
  auto* copy = vtkCompositeDataSet::SafeDownCast(held);
  copy->CopyStructure(composite);
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    copy->SetDataSet(iterator, HoldContents(iterator->GetCurrentDataObject()));
  }
  return held;
}

} // namespace tetralux
