// SPDX-License-Identifier: BSD-3-Clause
#include "GhostArray.h"

#include "vtkDataSetAttributes.h"

vtkSmartPointer<vtkUnsignedCharArray> MakeGhostArray(
  vtkIdType size, const std::map<vtkIdType, unsigned char>& bits, unsigned char others)
{
  auto ghosts = vtkSmartPointer<vtkUnsignedCharArray>::New();
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(size);
  ghosts->FillValue(others);
  for (const auto& [id, value] : bits)
  {
    ghosts->SetValue(id, value);
  }
  return ghosts;
}
