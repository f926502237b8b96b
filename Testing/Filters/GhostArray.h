// SPDX-License-Identifier: BSD-3-Clause
#ifndef GhostArray_h
#define GhostArray_h

#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"

#include <map>

/// vtkGhostType, as in vtkDataSetAttributes, of so many points or cells: the bits of some by their
/// ids, and those of all others.
vtkSmartPointer<vtkUnsignedCharArray> MakeGhostArray(
  vtkIdType size, const std::map<vtkIdType, unsigned char>& bits, unsigned char others = 0);

#endif
