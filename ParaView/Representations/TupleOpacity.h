// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TupleOpacity_h
#define tetralux_TupleOpacity_h

#include <functional>

class vtkVolumeProperty;

namespace tetralux
{

/// The opacity of tuples of so many components, as the colour map of a property shows them: by
/// their magnitude or a component. Valid as long as the property.
std::function<double(const double*)> MakeTupleOpacity(vtkVolumeProperty* property, int components);

} // namespace tetralux

#endif
