// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRepresentation.h"

#include "AllProcesses.h"
#include "FrameStatistics.h"
#include "Intake/DataSetBlocks.h"
#include "MapperGroup.h"
#include "Preparation/OpacityIntegral.h"
#include "ProcessRegions.h"
#include "ThreadShare.h"
#include "TupleOpacity.h"
#include "vtkOrderedVolume.h"
#include "vtkTetrahedraVolumeMapper.h"
#include "vtkTetrahedralizeCells.h"

#include "vtkAlgorithmOutput.h"
#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkColorTransferFunction.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkContourValues.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkExtractBlockUsingDataAssembly.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPVRenderView.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

//------------------------------------------------------------------------------------------------
class vtkTetrahedraRepresentation::Internals
{
public:
  /// The data of one block or of several, as one grid.
  static vtkSmartPointer<vtkUnstructuredGrid> Append(vtkDataObject* data);

  /// The same, of tetrahedra.
  static vtkSmartPointer<vtkUnstructuredGrid> Split(vtkDataObject* data);

  /// Bytes of a grid that came from other processes: all of it, where it is not what this one has.
  double CountDistributed(vtkUnstructuredGrid* drawn) const;

  /// What is chosen of a composite; other data as they are.
  vtkSmartPointer<vtkDataObject> ChooseBlocks(vtkDataObject* data) const;

  vtkNew<vtkOrderedVolume> Shown; ///< in place of the actor, which has the part of this process
  tetralux::MapperGroup Group;
  std::vector<vtkTetrahedraVolumeMapper*> Mappers; ///< those of the group
  vtkSmartPointer<vtkUnstructuredGrid> Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  std::string Assembly;
  std::vector<std::string> BlockSelectors;
  int Distribution = AUTOMATIC_DISTRIBUTION;
  bool Distributed = true;                    ///< by ParaView, in a parallel run
  vtkTetrahedraVolumeMapper* Last = nullptr;  ///< the mapper of the last frame
  vtkSmartPointer<vtkUnstructuredGrid> Drawn; ///< what this process draws, maybe redistributed
  unsigned long FrameObserver = 0;
  double MeasuredUnitDistance = 0;
  std::string Warning; ///< why nothing was drawn in the last frame; empty if it was
  bool OverlapWarned = false;
  std::string Statistics = "{}";
};

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkUnstructuredGrid> vtkTetrahedraRepresentation::Internals::Append(
  vtkDataObject* data)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  if (auto* single = vtkUnstructuredGrid::SafeDownCast(data))
  {
    grid->ShallowCopy(single);
    return grid;
  }
  vtkNew<vtkAppendFilter> append;
  for (const tetralux::DataSetBlock& block : tetralux::CollectDataSets(data))
  {
    append->AddInputData(block.DataSet);
  }
  if (append->GetNumberOfInputConnections(0) > 0)
  {
    append->Update();
    grid->ShallowCopy(append->GetOutput());
  }
  return grid;
}

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkUnstructuredGrid> vtkTetrahedraRepresentation::Internals::Split(
  vtkDataObject* data)
{
  vtkNew<vtkTetrahedralizeCells> split;
  split->PassOriginalIdsOff();
  split->SetInputDataObject(data);
  split->Update();
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->ShallowCopy(split->GetOutput());
  return grid;
}

//------------------------------------------------------------------------------------------------
double vtkTetrahedraRepresentation::Internals::CountDistributed(vtkUnstructuredGrid* drawn) const
{
  const bool own =
    drawn->GetCells()->GetConnectivityArray() == this->Grid->GetCells()->GetConnectivityArray();
  constexpr double Kibibyte = 1024;
  return own ? 0 : Kibibyte * static_cast<double>(drawn->GetActualMemorySize());
}

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> vtkTetrahedraRepresentation::Internals::ChooseBlocks(
  vtkDataObject* data) const
{
  const bool all = this->BlockSelectors.size() == 1 && this->BlockSelectors.front() == "/";
  if (!vtkCompositeDataSet::SafeDownCast(data) || this->BlockSelectors.empty() || all)
  {
    return data;
  }
  vtkNew<vtkExtractBlockUsingDataAssembly> extract;
  extract->SetAssemblyName(this->Assembly.c_str());
  for (const std::string& selector : this->BlockSelectors)
  {
    extract->AddSelector(selector.c_str());
  }
  extract->SetInputDataObject(data);
  extract->Update();
  return extract->GetOutputDataObject(0);
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraRepresentation::vtkTetrahedraRepresentation()
  : Private(std::make_unique<Internals>())
{
  tetralux::ShareThreads();
  this->Private->Shown->SetVolume(this->Actor);
  this->SetAmbient(0);
  this->SetDiffuse(1);
  this->SetSpecular(0);
  this->SetSpecularPower(100);
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraRepresentation::~vtkTetrahedraRepresentation() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::AddMapper(vtkTetrahedraVolumeMapper* mapper)
{
  this->Private->Group.Add(mapper);
  this->Private->Mappers.push_back(mapper);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetMapperProperty(const char* name, double value)
{
  try
  {
    this->Private->Group.SetProperty(name, { value });
  }
  catch (const std::out_of_range& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetMapperProperty(
  const char* name, double v0, double v1, double v2, double v3, double v4, double v5)
{
  try
  {
    this->Private->Group.SetProperty(name, { v0, v1, v2, v3, v4, v5 });
  }
  catch (const std::out_of_range& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetShade(int shade) { this->Property->SetShade(shade); }

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetAmbient(double ambient)
{
  this->Property->SetAmbient(ambient);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetDiffuse(double diffuse)
{
  this->Property->SetDiffuse(diffuse);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetSpecular(double specular)
{
  this->Property->SetSpecular(specular);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetSpecularPower(double power)
{
  this->Property->SetSpecularPower(power);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetNumberOfIsosurfaces(int number)
{
  this->Property->GetIsoSurfaceValues()->SetNumberOfContours(number);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetIsosurfaceValue(int index, double value)
{
  this->Property->GetIsoSurfaceValues()->SetValue(index, value);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetClipFunction(vtkImplicitFunction* function)
{
  this->Private->Group.SetClipFunction(function);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetActiveAssembly(const char* name)
{
  this->Private->Assembly = name ? name : "";
  this->MarkModified();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::AddBlockSelector(const char* selector)
{
  this->Private->BlockSelectors.emplace_back(selector);
  this->MarkModified();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::RemoveAllBlockSelectors()
{
  this->Private->BlockSelectors.clear();
  this->MarkModified();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetDistribution(int distribution)
{
  if (this->Private->Distribution != distribution)
  {
    this->Private->Distribution = distribution;
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::MeasureUnitDistance()
{
  vtkInformation* info = this->GetInputArrayInformation(0);
  const char* name = info->Get(vtkDataObject::FIELD_NAME());
  const int association = info->Get(vtkDataObject::FIELD_ASSOCIATION());
  const vtkSmartPointer<vtkUnstructuredGrid> grid = Internals::Split(this->Private->Grid);
  vtkDataSetAttributes* attributes = grid->GetAttributes(association);
  vtkDataArray* array = name && attributes ? attributes->GetArray(name) : nullptr;
  double integral = 0;
  if (array)
  {
    integral =
      tetralux::IntegrateOpacity(grid, array, association == vtkDataObject::FIELD_ASSOCIATION_CELLS,
        tetralux::MakeTupleOpacity(this->Property, array->GetNumberOfComponents()));
  }
  double bounds[6];
  tetralux::UniteBounds(this->DataBounds, bounds);
  this->Private->MeasuredUnitDistance = tetralux::FindUnitDistance(tetralux::Add(integral), bounds);
}

//------------------------------------------------------------------------------------------------
double vtkTetrahedraRepresentation::GetMeasuredUnitDistance()
{
  return this->Private->MeasuredUnitDistance;
}

//------------------------------------------------------------------------------------------------
const char* vtkTetrahedraRepresentation::GetStatistics()
{
  if (this->Private->Last)
  {
    this->Private->Statistics =
      tetralux::MakeFrameStatistics(this->Private->Last->GetStatistics(), this->Private->Shown);
  }
  return this->Private->Statistics.c_str();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->Private->Shown->SetVisibility(visible);
}

//------------------------------------------------------------------------------------------------
int vtkTetrahedraRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------------------------
int vtkTetrahedraRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMath::UninitializeBounds(this->DataBounds);
  // A process that only shows pictures has no input.
  if (inputVector[0]->GetNumberOfInformationObjects() == 1)
  {
    const vtkSmartPointer<vtkDataObject> data =
      this->Private->ChooseBlocks(vtkDataObject::GetData(inputVector[0], 0));
    this->Private->Grid = Internals::Append(data);
  }
  else
  {
    this->Private->Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  }
  this->PlaceData();
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::PlaceData()
{
  Internals& self = *this->Private;
  self.Shown->SetPlanes(nullptr);
  self.Distributed = self.Distribution == ALWAYS_DISTRIBUTED;
  if (tetralux::IsParallel() && !self.Distributed)
  {
    // Oblique planes order volumes, but not what else is in the view.
    const bool oblique = self.Distribution == NEVER_DISTRIBUTED;
    const tetralux::ProcessRegions regions = tetralux::FindProcessRegions(self.Grid, oblique);
    self.Distributed =
      self.Distribution == AUTOMATIC_DISTRIBUTION && (!regions.Planes || !regions.AllHaveCells);
    if (!regions.Planes && !self.Distributed && !self.OverlapWarned)
    {
      vtkWarningMacro(
        << "the data of processes overlap, and are not distributed anew: the order of "
           "their pictures may be wrong");
      self.OverlapWarned = true;
    }
    self.Shown->SetPlanes(self.Distributed ? nullptr : regions.Planes);
    std::copy(regions.Bounds.begin(), regions.Bounds.end(), this->DataBounds);
  }
  if (!tetralux::IsParallel() || self.Distributed)
  {
    self.Grid->GetBounds(this->DataBounds);
  }
  if (tetralux::IsParallel() && self.Distributed)
  {
    self.Grid = Internals::Split(self.Grid);
  }
}

//------------------------------------------------------------------------------------------------
int vtkTetrahedraRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    outInfo->Set(vtkPVRenderView::NEED_ORDERED_COMPOSITING(), 1);
    vtkPVRenderView::SetPiece(inInfo, this, this->Private->Grid);
    vtkPVRenderView::SetOrderedCompositingConfiguration(inInfo, this,
      this->Private->Distributed
        ? vtkPVRenderView::DATA_IS_REDISTRIBUTABLE | vtkPVRenderView::USE_DATA_FOR_LOAD_BALANCING
        : vtkPVRenderView::USE_BOUNDS_FOR_REDISTRIBUTION);
    vtkPVRenderView::SetRedistributionModeToSplitBoundaryCells(inInfo, this);
    vtkPVRenderView::SetRequiresDistributedRendering(inInfo, this, true);
    vtkNew<vtkMatrix4x4> matrix;
    this->Actor->GetMatrix(matrix);
    vtkPVRenderView::SetGeometryBounds(inInfo, this, this->DataBounds, matrix);
  }
  else if (request == vtkPVView::REQUEST_UPDATE_LOD())
  {
    vtkPVRenderView::SetRequiresDistributedRenderingLOD(inInfo, this, true);
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    vtkAlgorithmOutput* producer = vtkPVRenderView::GetPieceProducer(inInfo, this);
    auto* grid = vtkUnstructuredGrid::SafeDownCast(producer->GetProducer()->GetOutputDataObject(0));
    const bool drawn = grid && grid->GetNumberOfCells() > 0;
    this->Actor->SetVisibility(drawn);
    double distributed = 0;
    if (drawn)
    {
      distributed = this->Private->CountDistributed(grid);
      for (vtkTetrahedraVolumeMapper* mapper : this->Private->Mappers)
      {
        mapper->SetInputConnection(producer);
      }
      this->Private->Group.UpdateClippingPlanes();
      this->Private->Drawn = grid;
      // Until there is a context: see OnFrame.
      this->UseMapper(this->Private->Last ? this->Private->Last : this->Private->Mappers.front());
    }
    auto* view = vtkPVRenderView::SafeDownCast(inInfo->Get(vtkPVView::VIEW()));
    this->Private->Shown->PrepareFrame(view->GetRenderer(), distributed);
  }
  return 1;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::UseMapper(vtkTetrahedraVolumeMapper* mapper)
{
  this->Private->Last = mapper;
  this->UpdateMapper(mapper, this->Private->Drawn);
  this->Actor->SetMapper(mapper);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::OnFrame(vtkObject* renderer, unsigned long, void*)
{
  if (this->Actor->GetVisibility())
  {
    auto* window = vtkRenderer::SafeDownCast(renderer)->GetRenderWindow();
    vtkTetrahedraVolumeMapper* mapper = this->ChooseMapper(window);
    if (mapper != this->Private->Last)
    {
      this->UseMapper(mapper);
    }
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::UpdateMapper(
  vtkTetrahedraVolumeMapper* mapper, vtkDataObject* input)
{
  vtkInformation* info = this->GetInputArrayInformation(0);
  const char* name = info->Get(vtkDataObject::FIELD_NAME());
  vtkColorTransferFunction* colors = this->Property->GetRGBTransferFunction(0);
  this->SelectArray(mapper, input, name ? name : "", info->Get(vtkDataObject::FIELD_ASSOCIATION()),
    colors->GetVectorMode(), colors->GetVectorComponent());
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::SelectArray(vtkTetrahedraVolumeMapper* mapper,
  vtkDataObject* input, const std::string& name, int association, int mode, int component)
{
  const bool ofCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  mapper->SetScalarMode(
    ofCells ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  mapper->SelectScalarArray(name.c_str());
  vtkDataSetAttributes* attributes = input->GetAttributes(
    ofCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS);
  vtkDataArray* array = attributes->GetArray(name.c_str());
  const std::string warning = array ? ""
    : name.empty()                  ? "no array is chosen: nothing is drawn"
                   : "no array " + name + " in all blocks that are shown: nothing is drawn";
  if (warning != this->Private->Warning && !warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  this->Private->Warning = warning;
  this->Actor->SetVisibility(array != nullptr);
  if (!array || array->GetNumberOfComponents() == 1)
  {
    // The magnitude of a scalar would lose its sign.
    mapper->SetVectorMode(vtkTetrahedraVolumeMapper::DISABLED_MODE);
  }
  else if (mode == vtkScalarsToColors::COMPONENT)
  {
    mapper->SetVectorMode(vtkTetrahedraVolumeMapper::COMPONENT_MODE);
    mapper->SetVectorComponent(component);
  }
  else
  {
    mapper->SetVectorMode(vtkTetrahedraVolumeMapper::MAGNITUDE_MODE);
  }
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  vtkRenderer* renderer = renderView->GetRenderer();
  renderer->AddViewProp(this->Private->Shown);
  this->Private->FrameObserver =
    renderer->AddObserver(vtkCommand::StartEvent, this, &vtkTetrahedraRepresentation::OnFrame);
  return this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraRepresentation::RemoveFromView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->GetRenderer()->RemoveViewProp(this->Private->Shown);
  renderView->GetRenderer()->RemoveObserver(this->Private->FrameObserver);
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Distribution: " << this->Private->Distribution << "\n";
  os << indent << "Assembly: " << this->Private->Assembly << "\n";
  for (const std::string& selector : this->Private->BlockSelectors)
  {
    os << indent << "BlockSelector: " << selector << "\n";
  }
}
