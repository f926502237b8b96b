// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PropertySetters_h
#define tetralux_PropertySetters_h

#include "Properties/PropertyTable.h"

#include "vtkObject.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tetralux
{

/// Setters whose range is that of the property table. A value that is refused leaves the property
/// as it was and gives one error that names the right ones.

/// What kind of mapper an object is; AllKinds if it is none of them.
inline unsigned FindMapperKind(vtkObjectBase* object)
{
  return object->IsA("vtkTetrahedraRayCastMapper") ? RayCastKind
    : object->IsA("vtkTetrahedraGPURayCastMapper") ? GPURayCastKind
    : object->IsA("vtkTetrahedraProjectionMapper") ? ProjectionKind
    : object->IsA("vtkTetrahedraIsosurfaceMapper") ? IsosurfaceKind
    : object->IsA("vtkTriangleCasterMapper")       ? TriangleCasterKind
                                                   : AllKinds;
}

/// A number. Refuses NaN, clamps others to the range.
template <class ObjectT, class NumberT>
void SetNumber(ObjectT* self, const char* name, NumberT& member, NumberT number)
{
  const MapperProperty& property = GetMapperProperty(name);
  const double value = static_cast<double>(number);
  if (std::isnan(value))
  {
    vtkErrorWithObjectMacro(
      self, << name << ": nan is not " << DescribeValues(property, FindMapperKind(self)));
    return;
  }
  const bool named = std::any_of(property.Values.begin(), property.Values.end(),
    [value](const NamedValue& candidate) { return candidate.Number == value; });
  const auto accepted =
    named ? number : static_cast<NumberT>(std::clamp(value, property.Minimum, property.Maximum));
  if (member != accepted)
  {
    member = accepted;
    self->Modified();
  }
}

/// One of some values. Refuses others.
template <class ObjectT>
void SetEnumeration(ObjectT* self, const std::string& name, const std::vector<NamedValue>& values,
  int& member, int number)
{
  const bool found = std::any_of(values.begin(), values.end(),
    [number](const NamedValue& value) { return value.Number == number; });
  if (!found)
  {
    vtkErrorWithObjectMacro(
      self, << name << ": " << number << " is not "
            << (values.empty() ? std::string("possible: this mapper has no such property")
                               : DescribeValues(values)));
    return;
  }
  if (member != number)
  {
    member = number;
    self->Modified();
  }
}

/// One of the values that the mapper honours.
template <class MapperT>
void SetEnumeration(MapperT* self, const char* name, int& member, int number)
{
  const MapperProperty& property = GetMapperProperty(name);
  const unsigned kinds = FindMapperKind(self) & property.Kinds;
  SetEnumeration(self, name, GetNamedValues(property, kinds), member, number);
}

} // namespace tetralux

/// Defines SetName of a number.
#define tetraluxSetNumberMacro(mapper, name, type)                                                 \
  void mapper::Set##name(type value) { tetralux::SetNumber(this, #name, this->name, value); }

/// Defines SetName and GetNameAsString of an enumeration.
#define tetraluxEnumerationMacro(mapper, name)                                                     \
  void mapper::Set##name(int value) { tetralux::SetEnumeration(this, #name, this->name, value); }  \
  const char* mapper::Get##name##AsString() { return tetralux::GetValueName(#name, this->name); }

#endif
