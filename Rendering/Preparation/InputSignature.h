// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_InputSignature_h
#define tetralux_InputSignature_h

#include "Intake/ScalarExtraction.h"

#include <cstdint>
#include <vector>

class vtkDataObject;
class vtkVolumeProperty;

namespace tetralux
{

/// What something was built from: objects and their modification times. Equal signatures mean that
/// nothing has changed. Pointers are never followed; a new object at an old address has a later
/// time.
using Signature = std::vector<std::uint64_t>;

/// Of all that tetrahedra depend on: points, cells and ghost flags of each data set, but no other
/// array. A data set that a pipeline made anew from the same points and cells has the same
/// signature. Data sets that are none of VTK's grids are changed by anything.
Signature GetMeshSignature(vtkDataObject* input);

/// Of all that scalars depend on beside the mesh: the selected array of each data set.
Signature GetScalarsSignature(vtkDataObject* input, const ScalarSelection& selection);

/// Of all that TransferFunctionFromProperty reads, and of the values of isosurfaces.
Signature GetPropertySignature(vtkVolumeProperty* property);

} // namespace tetralux

#endif
