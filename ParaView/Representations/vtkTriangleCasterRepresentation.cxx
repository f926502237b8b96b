// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTriangleCasterRepresentation.h"

#include "AllProcesses.h"
#include "FrameStatistics.h"
#include "MapperGroup.h"
#include "Preparation/OpacityIntegral.h"
#include "ThreadShare.h"
#include "TupleOpacity.h"
#include "vtkOrderedVolume.h"
#include "vtkTriangleCasterMapper.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"
#include "vtkVolumeProperty.h"

#include <stdexcept>

vtkStandardNewMacro(vtkTriangleCasterRepresentation);

//------------------------------------------------------------------------------------------------
class vtkTriangleCasterRepresentation::Internals
{
public:
  vtkNew<vtkOrderedVolume> Shown; ///< in place of the actor, which has the part of this process
  vtkNew<vtkTriangleCasterMapper> Mapper;
  tetralux::MapperGroup Group;
  std::vector<double> CroppingRegionPlanes; ///< as they were set; empty before that
  double MeasuredUnitDistance = 0;
  std::string Statistics = "{}";
};

//------------------------------------------------------------------------------------------------
vtkTriangleCasterRepresentation::vtkTriangleCasterRepresentation()
  : Private(std::make_unique<Internals>())
{
  tetralux::ShareThreads();
  this->Private->Shown->SetVolume(this->Actor);
  this->VolumeMapper = this->Private->Mapper;
  this->Private->Group.Add(this->Private->Mapper);
}

//------------------------------------------------------------------------------------------------
vtkTriangleCasterRepresentation::~vtkTriangleCasterRepresentation() = default;

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::SetValues(const char* name, const std::vector<double>& values)
{
  try
  {
    this->Private->Group.SetProperty(name, values);
  }
  catch (const std::out_of_range& error)
  {
    vtkErrorMacro(<< error.what());
    return;
  }
  if (std::string(name) == "CroppingRegionPlanes")
  {
    this->Private->CroppingRegionPlanes = values;
  }
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::SetMapperProperty(const char* name, double value)
{
  this->SetValues(name, { value });
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::SetMapperProperty(const char* name, double v0, double v1)
{
  this->SetValues(name, { v0, v1 });
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::SetMapperProperty(
  const char* name, double v0, double v1, double v2)
{
  this->SetValues(name, { v0, v1, v2 });
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::SetMapperProperty(
  const char* name, double v0, double v1, double v2, double v3, double v4, double v5)
{
  this->SetValues(name, { v0, v1, v2, v3, v4, v5 });
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::SetClipFunction(vtkImplicitFunction* function)
{
  this->Private->Group.SetClipFunction(function);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::MeasureUnitDistance()
{
  auto* image = vtkImageData::SafeDownCast(this->Cache);
  vtkDataArray* array = image ? this->GetInputArrayToProcess(0, image) : nullptr;
  double integral = 0;
  if (array)
  {
    integral = tetralux::IntegrateOpacity(
      image, array, tetralux::MakeTupleOpacity(this->Property, array->GetNumberOfComponents()));
  }
  double bounds[6];
  tetralux::UniteBounds(this->DataBounds, bounds);
  this->Private->MeasuredUnitDistance = tetralux::FindUnitDistance(tetralux::Add(integral), bounds);
}

//------------------------------------------------------------------------------------------------
double vtkTriangleCasterRepresentation::GetMeasuredUnitDistance()
{
  return this->Private->MeasuredUnitDistance;
}

//------------------------------------------------------------------------------------------------
const char* vtkTriangleCasterRepresentation::GetStatistics()
{
  this->Private->Statistics =
    tetralux::MakeFrameStatistics(this->Private->Mapper->GetStatistics(), this->Private->Shown);
  return this->Private->Statistics.c_str();
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->Private->Shown->SetVisibility(visible);
}

//------------------------------------------------------------------------------------------------
int vtkTriangleCasterRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_RENDER())
  {
    auto* view = vtkPVRenderView::SafeDownCast(inInfo->Get(vtkPVView::VIEW()));
    constexpr double NothingDistributed = 0; // images stay where they are
    this->Private->Shown->PrepareFrame(view->GetRenderer(), NothingDistributed);
  }
  return 1;
}

//------------------------------------------------------------------------------------------------
bool vtkTriangleCasterRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!this->Superclass::AddToView(view) || !renderView)
  {
    return false;
  }
  renderView->GetRenderer()->RemoveViewProp(this->Actor);
  renderView->GetRenderer()->AddViewProp(this->Private->Shown);
  return true;
}

//------------------------------------------------------------------------------------------------
bool vtkTriangleCasterRepresentation::RemoveFromView(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetRenderer()->RemoveViewProp(this->Private->Shown);
  }
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::UpdateMapperParameters()
{
  this->Superclass::UpdateMapperParameters();
  vtkTriangleCasterMapper* mapper = this->Private->Mapper;
  mapper->SetWholeExtent(this->WholeExtent);
  // The superclass takes the planes for relative ones, of the part of the data that a process has.
  if (!this->Private->CroppingRegionPlanes.empty())
  {
    mapper->SetCroppingRegionPlanes(this->Private->CroppingRegionPlanes.data());
  }
  this->Private->Group.UpdateClippingPlanes();

  // And it tells only mappers of its own what the colour map shows of vectors.
  vtkColorTransferFunction* colors = this->Property->GetRGBTransferFunction(0);
  vtkImageData* image = vtkImageData::SafeDownCast(mapper->GetDataObjectInput());
  int ofCells = 0;
  vtkDataArray* array = image
    ? vtkAbstractMapper::GetScalars(image, mapper->GetScalarMode(), mapper->GetArrayAccessMode(),
        mapper->GetArrayId(), mapper->GetArrayName(), ofCells)
    : nullptr;
  if (!array || array->GetNumberOfComponents() == 1 || !this->Property->GetIndependentComponents())
  {
    mapper->SetVectorMode(vtkTriangleCasterMapper::DISABLED_MODE);
  }
  else if (colors->GetVectorMode() == vtkScalarsToColors::COMPONENT)
  {
    mapper->SetVectorMode(vtkTriangleCasterMapper::COMPONENT_MODE);
    mapper->SetVectorComponent(colors->GetVectorComponent());
  }
  else
  {
    mapper->SetVectorMode(vtkTriangleCasterMapper::MAGNITUDE_MODE);
  }
}

//------------------------------------------------------------------------------------------------
void vtkTriangleCasterRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mapper:\n";
  this->Private->Mapper->PrintSelf(os, indent.GetNextIndent());
}
