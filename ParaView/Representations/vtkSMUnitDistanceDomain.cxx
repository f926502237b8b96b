// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMUnitDistanceDomain.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

vtkStandardNewMacro(vtkSMUnitDistanceDomain);

//------------------------------------------------------------------------------------------------
vtkSMUnitDistanceDomain::vtkSMUnitDistanceDomain() = default;

//------------------------------------------------------------------------------------------------
vtkSMUnitDistanceDomain::~vtkSMUnitDistanceDomain() = default;

//------------------------------------------------------------------------------------------------
int vtkSMUnitDistanceDomain::SetDefaultValues(vtkSMProperty* property, bool unchecked)
{
  vtkSMProxy* representation = property->GetParent();
  vtkSMProperty* measured = representation->GetProperty("TetraluxMeasuredUnitDistance");
  if (measured)
  {
    representation->InvokeCommand("TetraluxMeasureUnitDistance");
    representation->UpdatePropertyInformation(measured);
    const double distance = vtkSMPropertyHelper(measured).GetAsDouble();
    if (distance > 0)
    {
      vtkSMPropertyHelper helper(property);
      helper.SetUseUnchecked(unchecked);
      helper.Set(distance);
      return 1;
    }
  }
  return this->Superclass::SetDefaultValues(property, unchecked);
}
