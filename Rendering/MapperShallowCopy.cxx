// SPDX-License-Identifier: BSD-3-Clause
// ShallowCopy of all mappers, by the table of their properties, which knows the mappers itself.
#include "MapperPropertyAccess.h"

#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraVolumeMapper.h"
#include "vtkTriangleCasterMapper.h"

#include "vtkAlgorithmOutput.h"
#include "vtkImageData.h"

#include <algorithm>
#include <vector>

using tetralux::MapperProperty;
using tetralux::NamedValue;

namespace
{

/// Input, choice of the array, and of a mapper of this project the properties that both have, but
/// for values that the copy does not honour.
void CopyMapper(vtkAbstractVolumeMapper* from, vtkAbstractVolumeMapper* to)
{
  to->SetInputConnection(
    from->GetNumberOfInputConnections(0) > 0 ? from->GetInputConnection(0, 0) : nullptr);
  to->SetScalarMode(from->GetScalarMode());
  if (from->GetArrayName())
  {
    to->SelectScalarArray(from->GetArrayName());
  }
  if (from->GetArrayAccessMode() == VTK_GET_ARRAY_BY_ID)
  {
    to->SelectScalarArray(from->GetArrayId());
  }
  const unsigned kind = tetralux::GetKind(to);
  const unsigned kindOfSource = tetralux::GetKind(from);
  for (const MapperProperty& property : tetralux::GetMapperProperties())
  {
    if (kindOfSource == tetralux::AllKinds || (property.Kinds & kind) == 0 ||
      (property.Kinds & kindOfSource) == 0)
    {
      continue; // not of both
    }
    const std::vector<double> values = tetralux::GetPropertyValues(from, property);
    const std::vector<NamedValue> named = tetralux::GetNamedValues(property, kind);
    const bool honoured = property.Type != tetralux::PropertyType::Enumeration ||
      std::any_of(named.begin(), named.end(),
        [&values](const NamedValue& value) { return value.Number == values.front(); });
    if (honoured)
    {
      tetralux::SetPropertyValues(to, property, values);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkAbstractVolumeMapper::SafeDownCast(mapper))
  {
    CopyMapper(other, this);
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkTetrahedraIsosurfaceMapper::SafeDownCast(mapper))
  {
    this->SetColorArrayName(other->GetColorArrayName());
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkAbstractVolumeMapper::SafeDownCast(mapper))
  {
    CopyMapper(other, this);
  }
  if (auto* other = vtkTriangleCasterMapper::SafeDownCast(mapper))
  {
    this->SetMaskInput(other->GetMaskInput());
    this->SetWholeExtent(other->GetWholeExtent());
  }
  this->Superclass::ShallowCopy(mapper);
}
