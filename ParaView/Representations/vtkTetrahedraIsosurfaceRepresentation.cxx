// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraIsosurfaceRepresentation.h"

#include "vtkTetrahedraIsosurfaceMapper.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

vtkStandardNewMacro(vtkTetrahedraIsosurfaceRepresentation);

//------------------------------------------------------------------------------------------------
vtkTetrahedraIsosurfaceRepresentation::vtkTetrahedraIsosurfaceRepresentation()
{
  this->AddMapper(this->Mapper);
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraIsosurfaceRepresentation::~vtkTetrahedraIsosurfaceRepresentation() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceRepresentation::SelectContourArray(int, int, int, int, const char* name)
{
  this->ContourArray = name ? name : "";
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceRepresentation::SetColorMap(vtkColorTransferFunction* colors)
{
  this->ColorMap = colors;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceRepresentation::SetOpacityMap(vtkPiecewiseFunction* opacities)
{
  this->OpacityMap = opacities;
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraVolumeMapper* vtkTetrahedraIsosurfaceRepresentation::ChooseMapper(vtkRenderWindow*)
{
  return this->Mapper;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceRepresentation::UpdateMapper(
  vtkTetrahedraVolumeMapper* mapper, vtkDataObject* input)
{
  vtkInformation* info = this->GetInputArrayInformation(0);
  const char* chosen = info->Get(vtkDataObject::FIELD_NAME());
  const std::string colorArray = chosen ? chosen : "";
  const int colorAssociation = info->Get(vtkDataObject::FIELD_ASSOCIATION());
  const bool colored = !colorArray.empty() && this->ColorMap;
  this->UpdateProperty(colored);

  const std::string& contourArray = this->UseContourArray ? this->ContourArray : colorArray;
  const bool byAnother = colored && contourArray != colorArray;
  const int mode = colored ? this->ColorMap->GetVectorMode() : vtkScalarsToColors::MAGNITUDE;
  const int component = colored ? this->ColorMap->GetVectorComponent() : 0;
  if (byAnother)
  {
    this->Mapper->SetColorArrayName(colorArray.c_str());
    constexpr int Magnitude = -1;
    this->Mapper->SetColorArrayComponent(
      mode == vtkScalarsToColors::COMPONENT ? component : Magnitude);
  }
  else
  {
    this->Mapper->SetColorArrayName(nullptr);
  }
  this->SelectArray(mapper, input, contourArray,
    this->UseContourArray ? vtkDataObject::FIELD_ASSOCIATION_POINTS : colorAssociation,
    byAnother ? vtkScalarsToColors::MAGNITUDE : mode, component);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceRepresentation::UpdateProperty(bool colored)
{
  if (colored)
  {
    this->Property->SetColor(this->ColorMap);
  }
  else
  {
    double present[3];
    this->Uniform->GetColor(0, present);
    if (this->Uniform->GetSize() == 0 || present[0] != this->SolidColor[0] ||
      present[1] != this->SolidColor[1] || present[2] != this->SolidColor[2])
    {
      this->Uniform->RemoveAllPoints();
      this->Uniform->AddRGBPoint(0, this->SolidColor[0], this->SolidColor[1], this->SolidColor[2]);
    }
    this->Property->SetColor(this->Uniform);
  }
  if (colored && this->MapOpacity && this->OpacityMap)
  {
    this->Property->SetScalarOpacity(this->OpacityMap);
    return;
  }
  if (this->UniformOpacity->GetSize() == 0 || this->UniformOpacity->GetValue(0) != this->Opacity)
  {
    this->UniformOpacity->RemoveAllPoints();
    this->UniformOpacity->AddPoint(0, this->Opacity);
  }
  this->Property->SetScalarOpacity(this->UniformOpacity);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraIsosurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "UseContourArray: " << (this->UseContourArray ? "On" : "Off") << "\n";
  os << indent << "ContourArray: " << this->ContourArray << "\n";
  os << indent << "Opacity: " << this->Opacity << "\n";
  os << indent << "MapOpacity: " << (this->MapOpacity ? "On" : "Off") << "\n";
  os << indent << "SolidColor: " << this->SolidColor[0] << ", " << this->SolidColor[1] << ", "
     << this->SolidColor[2] << "\n";
}
