// SPDX-License-Identifier: BSD-3-Clause
#include "MapperGroup.h"

#include "ClippingPlanes.h"
#include "MapperPropertyAccess.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkImplicitFunction.h"

#include <algorithm>

namespace tetralux
{

MapperGroup::MapperGroup() = default;
MapperGroup::~MapperGroup() = default;

void MapperGroup::Add(vtkAbstractVolumeMapper* mapper) { this->Mappers.emplace_back(mapper); }

void MapperGroup::SetProperty(const char* name, const std::vector<double>& values)
{
  const MapperProperty& property = GetMapperProperty(name);
  for (vtkAbstractVolumeMapper* mapper : this->Mappers)
  {
    const unsigned kinds = GetKind(mapper) & property.Kinds;
    const std::vector<NamedValue> honoured = GetNamedValues(property, kinds);
    const bool honours = property.Type != PropertyType::Enumeration ||
      std::any_of(honoured.begin(), honoured.end(),
        [&](const NamedValue& value) { return value.Number == values.front(); });
    if (kinds != 0 && honours)
    {
      SetPropertyValues(mapper, property, values);
    }
  }
}

void MapperGroup::SetClipFunction(vtkImplicitFunction* function)
{
  this->ClipFunction = function;
  this->ClipTime = 0;
  if (!function)
  {
    for (vtkAbstractVolumeMapper* mapper : this->Mappers)
    {
      mapper->RemoveAllClippingPlanes();
    }
  }
}

void MapperGroup::UpdateClippingPlanes()
{
  if (!this->ClipFunction || this->ClipFunction->GetMTime() == this->ClipTime)
  {
    return;
  }
  const vtkSmartPointer<vtkPlaneCollection> planes = MakeClippingPlanes(this->ClipFunction);
  for (vtkAbstractVolumeMapper* mapper : this->Mappers)
  {
    mapper->SetClippingPlanes(planes);
  }
  this->ClipTime = this->ClipFunction->GetMTime();
}

} // namespace tetralux
