// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshedPolyhedraVisibilitySort.h"

#include "Frame/CameraRays.h"
#include "Intake/TetrahedraIntake.h"
#include "Properties/PropertySetters.h"
#include "Visibility/MeshOrder.h"
#include "Walk/WalkMesh.h"

#include "vtkCamera.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

using tetralux::OrderWish;
using tetralux::VisibilityMethod;

vtkStandardNewMacro(vtkMeshedPolyhedraVisibilitySort);

struct vtkMeshedPolyhedraVisibilitySort::Internals
{
  // What the tables were made of.
  vtkDataSet* Input = nullptr;
  vtkMTimeType InputTime = 0;

  std::unique_ptr<tetralux::WalkMesh> Mesh;
  std::unique_ptr<tetralux::MeshOrder> Order;

  std::vector<vtkIdType> Sorted; ///< ids of the input
  std::size_t Next = 0;
  vtkNew<vtkIdTypeArray> Returned;

  /// Those of the last order; nullptr before the first.
  const tetralux::VisibilityCycles* GetCycles() const
  {
    return this->Order ? &this->Order->Get().GetCycles() : nullptr;
  }

  vtkIdType GetInputCell(std::int32_t cell) const
  {
    const auto& original = this->Mesh->GetMesh().OriginalCells;
    return original.empty() ? cell : static_cast<vtkIdType>(original[cell]);
  }
};

//----------------------------------------------------------------------------
vtkMeshedPolyhedraVisibilitySort::vtkMeshedPolyhedraVisibilitySort()
  : Tables(new Internals)
{
}

vtkMeshedPolyhedraVisibilitySort::~vtkMeshedPolyhedraVisibilitySort() = default;

//----------------------------------------------------------------------------
void vtkMeshedPolyhedraVisibilitySort::UpdateTables()
{
  Internals& tables = *this->Tables;
  if (tables.Order && tables.Input == this->Input && tables.InputTime == this->Input->GetMTime())
  {
    return;
  }
  tables.Order.reset();
  tables.Mesh.reset();
  tetralux::TetrahedraIntake intake = tetralux::TakeInTetrahedra(this->Input);
  if (!intake.Error.empty())
  {
    throw std::invalid_argument(intake.Error);
  }
  const auto& cells = intake.Mesh.OriginalCells;
  const auto split = std::adjacent_find(cells.begin(), cells.end());
  if (split != cells.end() || intake.Report.GetNumberOfSkippedCells() > 0)
  {
    throw std::invalid_argument(
      "only tetrahedra can be sorted, which vtkTetrahedralizeCells makes of "
      "other cells: " +
      (split != cells.end() ? "cell " + std::to_string(*split) + " is none"
                            : "there are " + intake.Report.DescribeSkippedCells()));
  }
  tables.Mesh = std::make_unique<tetralux::WalkMesh>(std::move(intake.Mesh));
  tables.Input = this->Input;
  tables.InputTime = this->Input->GetMTime();
  tables.Order = std::make_unique<tetralux::MeshOrder>(*tables.Mesh);
}

//----------------------------------------------------------------------------
void vtkMeshedPolyhedraVisibilitySort::Sort()
{
  Internals& tables = *this->Tables;
  // In homogeneous coordinates of the world, then of the input; from +z without a camera.
  std::array<double, 4> eye = { 0, 0, 1, 0 };
  if (this->Camera)
  {
    eye = tetralux::FindEye(this->Camera);
  }
  if (this->ModelTransform)
  {
    if (this->ModelTransform->Determinant() == 0)
    {
      throw std::invalid_argument("the model transform has no inverse");
    }
    this->InverseModelTransform->MultiplyPoint(eye.data(), eye.data());
  }
  tetralux::VisibilityView view;
  view.Parallel = eye[3] == 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    view.Eye[axis] = view.Parallel ? 0 : eye[axis] / eye[3];
    view.Direction[axis] = -eye[axis];
  }

  const std::vector<std::int32_t>& order = *tables.Order->Sort(view, GetWishOf(this->Order),
    this->Direction == FRONT_TO_BACK ? tetralux::VisibilityDirection::FrontToBack
                                     : tetralux::VisibilityDirection::BackToFront);
  this->UsedOrder = GetOrderOf(tables.Order->Get().GetUsedMethod());
  tables.Sorted.resize(order.size());
  std::transform(order.begin(), order.end(), tables.Sorted.begin(),
    [&](std::int32_t cell) { return tables.GetInputCell(cell); });
}

//----------------------------------------------------------------------------
tetralux::OrderWish vtkMeshedPolyhedraVisibilitySort::GetWishOf(int order)
{
  switch (order)
  {
    case EXACT_ORDER:
      return OrderWish::Convexified;
    case ACROSS_GAPS_ORDER:
      return OrderWish::AcrossGaps;
    case NON_CONVEX_ORDER:
      return OrderWish::NonConvex;
    case CENTROID_ORDER:
      return OrderWish::Centroids;
    default:
      return OrderWish::Automatic;
  }
}

//----------------------------------------------------------------------------
int vtkMeshedPolyhedraVisibilitySort::GetOrderOf(VisibilityMethod method)
{
  switch (method)
  {
    case VisibilityMethod::Meshed:
      return EXACT_ORDER;
    case VisibilityMethod::MeshedAcrossGaps:
      return ACROSS_GAPS_ORDER;
    case VisibilityMethod::MeshedNonConvex:
      return NON_CONVEX_ORDER;
    default:
      return CENTROID_ORDER;
  }
}

//----------------------------------------------------------------------------
void vtkMeshedPolyhedraVisibilitySort::InitTraversal()
{
  this->Tables->Sorted.clear();
  this->Tables->Next = 0;
  if (!this->Input)
  {
    vtkErrorMacro("there is no input to sort: SetInput gives one");
    return;
  }
  try
  {
    this->UpdateTables();
    this->Sort();
    this->LastSortTime.Modified();
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("not enough memory to sort " << this->Input->GetNumberOfCells() << " cells");
    this->Tables = std::make_unique<Internals>();
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    this->Tables->Sorted.clear();
  }
}

//----------------------------------------------------------------------------
vtkIdTypeArray* vtkMeshedPolyhedraVisibilitySort::GetNextCells()
{
  Internals& tables = *this->Tables;
  const std::size_t count = std::min<std::size_t>(
    tables.Sorted.size() - tables.Next, static_cast<std::size_t>(this->MaxCellsReturned));
  if (count == 0)
  {
    return nullptr;
  }
  tables.Returned->SetNumberOfTuples(static_cast<vtkIdType>(count));
  std::copy_n(tables.Sorted.begin() + static_cast<std::ptrdiff_t>(tables.Next), count,
    tables.Returned->GetPointer(0));
  tables.Next += count;
  return tables.Returned;
}

//----------------------------------------------------------------------------
vtkIdType vtkMeshedPolyhedraVisibilitySort::GetNumberOfCycles()
{
  const tetralux::VisibilityCycles* cycles = this->Tables->GetCycles();
  return cycles ? static_cast<vtkIdType>(cycles->GetNumberOfCycles()) : 0;
}

//----------------------------------------------------------------------------
vtkIdType vtkMeshedPolyhedraVisibilitySort::GetNumberOfIgnoredFaces()
{
  const tetralux::VisibilityCycles* cycles = this->Tables->GetCycles();
  return cycles ? static_cast<vtkIdType>(cycles->IgnoredFaces) : 0;
}

//----------------------------------------------------------------------------
double vtkMeshedPolyhedraVisibilitySort::GetIgnoredArea()
{
  const tetralux::VisibilityCycles* cycles = this->Tables->GetCycles();
  return cycles ? cycles->IgnoredArea : 0;
}

//----------------------------------------------------------------------------
void vtkMeshedPolyhedraVisibilitySort::GetCycle(vtkIdType cycle, vtkIdList* cells)
{
  cells->Reset();
  if (cycle < 0 || cycle >= this->GetNumberOfCycles())
  {
    vtkErrorMacro("there is no cycle " << cycle << ": there are " << this->GetNumberOfCycles());
    return;
  }
  const tetralux::VisibilityCycles& cycles = *this->Tables->GetCycles();
  for (std::int64_t i = cycles.Begins[cycle]; i < cycles.Begins[cycle + 1]; ++i)
  {
    if (cycles.Cells[i] < this->Tables->Mesh->GetNumberOfCells())
    {
      cells->InsertNextId(this->Tables->GetInputCell(cycles.Cells[i]));
    }
  }
}

//----------------------------------------------------------------------------
const char* vtkMeshedPolyhedraVisibilitySort::GetRefusal()
{
  const auto& order = this->Tables->Order;
  return order ? order->GetRefusal().c_str() : "";
}

//----------------------------------------------------------------------------
tetraluxEnumerationMacro(vtkMeshedPolyhedraVisibilitySort, Order);

//----------------------------------------------------------------------------
const char* vtkMeshedPolyhedraVisibilitySort::GetUsedOrderAsString()
{
  return tetralux::GetValueName("Order", this->UsedOrder);
}

//----------------------------------------------------------------------------
void vtkMeshedPolyhedraVisibilitySort::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Order: " << this->GetOrderAsString() << "\n";
  os << indent << "UsedOrder: " << this->GetUsedOrderAsString() << "\n";
  os << indent << "NumberOfCycles: " << this->GetNumberOfCycles() << "\n";
  os << indent << "NumberOfIgnoredFaces: " << this->GetNumberOfIgnoredFaces() << "\n";
  os << indent << "IgnoredArea: " << this->GetIgnoredArea() << "\n";
  os << indent << "Refusal: " << this->GetRefusal() << "\n";
}
