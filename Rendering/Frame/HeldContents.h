// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_HeldContents_h
#define tetralux_HeldContents_h

#include "TetraluxRenderingModule.h"

#include "vtkSmartPointer.h"

class vtkDataObject;

namespace tetralux
{

/// A shallow copy: what data consist of, of a composite those of its blocks, as long as it lives.
/// Whoever reads it is not disturbed by observers that release the data or give them other arrays.
/// nullptr of nullptr.
TETRALUXRENDERING_EXPORT vtkSmartPointer<vtkDataObject> HoldContents(vtkDataObject* data);

} // namespace tetralux

#endif
