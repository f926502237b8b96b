// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ClippingPlanes_h
#define tetralux_ClippingPlanes_h

#include "vtkPlaneCollection.h"
#include "vtkSmartPointer.h"

class vtkImplicitFunction;

namespace tetralux
{

/// Planes of a mapper that keep what is inside of a function, where its value is negative: of a
/// vtkPlane the side that its normal points away from, of a vtkBox its inside. Empty for nullptr
/// and for other functions, whose inside no planes have.
vtkSmartPointer<vtkPlaneCollection> MakeClippingPlanes(vtkImplicitFunction* function);

} // namespace tetralux

#endif
