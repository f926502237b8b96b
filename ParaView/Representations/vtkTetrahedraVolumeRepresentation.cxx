// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraVolumeRepresentation.h"

#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkTetrahedraVolumeRepresentation);

//------------------------------------------------------------------------------------------------
vtkTetrahedraVolumeRepresentation::vtkTetrahedraVolumeRepresentation()
{
  this->AddMapper(this->RayCaster);
  this->AddMapper(this->GPURayCaster);
  this->AddMapper(this->Projection);
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraVolumeRepresentation::~vtkTetrahedraVolumeRepresentation() = default;

//------------------------------------------------------------------------------------------------
vtkTetrahedraVolumeMapper* vtkTetrahedraVolumeRepresentation::ChooseMapper(vtkRenderWindow* window)
{
  switch (this->Method)
  {
    case RAY_CASTING_METHOD:
      return this->RayCaster;
    case GRAPHICS_CARD_METHOD:
      return this->GPURayCaster;
    case PROJECTION_METHOD:
      return this->Projection;
    default: // SetMethod lets no other through
      break;
  }
  if (this->GPURayCaster->IsSupported(window))
  {
    return this->GPURayCaster;
  }
  return this->RayCaster;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraVolumeRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
}
