// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/ScenePreparation.h"

#include "Base/Stopwatch.h"
#include "Intake/ScalarExtraction.h"
#include "Preparation/TransferFunctionFromProperty.h"
#include "vtkTetrahedraVolumeMapper.h"

#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// The least error that a property's functions are approximated to: single precision tables have
/// no less.
constexpr double SmallestFunctionError = 1e-7;

/// Share of MaximumError that approximating a property's functions may take: ending rays early
/// takes a half, rounding a quarter.
constexpr double FunctionErrorShare = 0.125;

/// Share of MaximumError that looking segments up in a table may take.
constexpr double TableErrorShare = 0.25;

/// Frames that are to take less than this belong to an interaction, seconds.
constexpr double InteractiveSeconds = 1;

/// How much longer than in the mesh a distance in the world can be: the largest singular value.
double GetLargestScale(vtkVolume* volume)
{
  double linear[3][3], u[3][3], w[3], vt[3][3];
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      linear[row][column] = volume->GetMatrix()->GetElement(row, column);
    }
  }
  vtkMath::SingularValueDecomposition3x3(linear, u, w, vt);
  return std::max({ std::abs(w[0]), std::abs(w[1]), std::abs(w[2]) });
}

/// A bound of the length of a ray in a volume, in world units, that changes seldom: a power of two.
double GetLongestPath(const WalkMesh& mesh, vtkVolume* volume)
{
  const vtkMatrix4x4* matrix = volume->GetMatrix();
  double squares = 0;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      squares += matrix->GetElement(row, column) * matrix->GetElement(row, column);
    }
  }
  return std::exp2(std::ceil(std::log2(2 * mesh.GetRadius() * std::sqrt(squares))));
}

OpticalModel GetOpticalModel(int blendMode)
{
  switch (blendMode)
  {
    case vtkTetrahedraVolumeMapper::COMPOSITE_BLEND:
      return OpticalModel::EmissionAbsorption;
    case vtkTetrahedraVolumeMapper::MAXIMUM_INTENSITY_BLEND:
      return OpticalModel::MaximumIntensity;
    case vtkTetrahedraVolumeMapper::ADDITIVE_BLEND:
      return OpticalModel::EmissionOnly;
    case vtkTetrahedraVolumeMapper::ISOSURFACE_BLEND:
      return OpticalModel::Isosurfaces;
    case vtkTetrahedraVolumeMapper::ABSORPTION_BLEND:
      return OpticalModel::AbsorptionOnly;
    default:
      throw std::invalid_argument("BlendMode " + std::to_string(blendMode) +
        " is none of this mapper's: composite, maximum intensity, additive, isosurface or "
        "absorption");
  }
}

const char* GetModelName(OpticalModel model)
{
  switch (model)
  {
    case OpticalModel::EmissionOnly:
      return "emission only";
    case OpticalModel::AbsorptionOnly:
      return "absorption only";
    case OpticalModel::MaximumIntensity:
      return "maximum intensity";
    case OpticalModel::Isosurfaces:
      return "isosurfaces";
    default:
      return "emission and absorption";
  }
}

/// The surfaces of a property, each with colour and opacity at its value.
std::vector<Isosurface> GetIsosurfaces(
  vtkVolumeProperty* property, const TransferFunction& opacities)
{
  vtkContourValues* values = property->GetIsoSurfaceValues();
  if (values->GetNumberOfContours() == 0)
  {
    throw std::invalid_argument(
      "the volume property has no IsoSurfaceValues, which the isosurface BlendMode shows");
  }
  std::vector<Isosurface> surfaces;
  for (int i = 0; i < values->GetNumberOfContours(); ++i)
  {
    const TransferFunction::Value value = Evaluate(opacities, values->GetValue(i));
    Isosurface surface;
    surface.Value = values->GetValue(i);
    surface.Opacity = static_cast<float>(std::min(value.Attenuation, 1.));
    for (int c = 0; c < 3; ++c)
    {
      surface.Color[c] = static_cast<float>(value.Color[c]);
    }
    surfaces.push_back(surface);
  }
  return surfaces;
}

/// Opacities for attenuations: of models in which lengths do not count.
void RemoveUnitDistance(TransferFunction& function, double unitDistance)
{
  for (TransferFunction::Node& node : function.Nodes)
  {
    node.Left.Attenuation *= unitDistance;
    node.Right.Attenuation *= unitDistance;
  }
}

const char* GetFormatName(TexelFormat format)
{
  switch (format)
  {
    case TexelFormat::UNorm8:
      return "8-bit";
    case TexelFormat::UNorm16:
      return "16-bit";
    case TexelFormat::Half:
      return "half";
    default:
      return "float";
  }
}

} // namespace

ScenePreparation::ScenePreparation(vtkTetrahedraVolumeMapper* mapper)
  : Mapper(mapper)
{
}

bool ScenePreparation::Update(vtkVolume* volume, const std::function<bool(double)>& progress)
{
  this->Rebuilt.clear();
  this->IntakeSeconds = this->MeshSeconds = this->ScalarsSeconds = this->FunctionSeconds =
    this->TableSeconds = 0;
  vtkDataObject* input = this->Mapper->GetDataObjectInput();
  if (!input)
  {
    throw std::invalid_argument("there is no input");
  }
  if (!this->PrepareMesh(input, progress))
  {
    return false;
  }
  this->PrepareScalars(input);
  this->WarnOfShade(volume->GetProperty());
  this->PrepareFunction(volume);
  this->PrepareTable(volume);
  return true;
}

bool ScenePreparation::PrepareMesh(
  vtkDataObject* input, const std::function<bool(double)>& progress)
{
  Signature signature = GetMeshSignature(input);
  if (this->Scene.GetMesh() && signature == this->MeshSignature)
  {
    return true;
  }
  const Stopwatch intakeStopwatch;
  TetrahedraIntake intake = TakeInTetrahedra(input, progress);
  if (intake.Aborted)
  {
    return false;
  }
  if (!intake.Error.empty())
  {
    throw std::invalid_argument(intake.Error);
  }
  this->IntakeSeconds = intakeStopwatch.GetSeconds();

  const Stopwatch meshStopwatch;
  this->Scene.SetMesh(std::make_shared<WalkMesh>(std::move(intake.Mesh)));
  this->Intake = std::move(intake.Report);
  this->MeshSignature = std::move(signature);
  this->ScalarsSignature.clear();
  this->MeshSeconds = meshStopwatch.GetSeconds();
  this->Rebuilt.push_back("mesh");
  this->WarnOfMesh();
  return true;
}

void ScenePreparation::PrepareScalars(vtkDataObject* input)
{
  ScalarSelection selection;
  selection.ScalarMode = this->Mapper->GetScalarMode();
  selection.ArrayAccessMode = this->Mapper->GetArrayAccessMode();
  selection.ArrayId = this->Mapper->GetArrayId();
  selection.ArrayName = this->Mapper->GetArrayName() ? this->Mapper->GetArrayName() : "";
  selection.VectorMode = this->Mapper->GetVectorMode();
  selection.VectorComponent = this->Mapper->GetVectorComponent();
  Signature signature = GetScalarsSignature(input, selection);
  if (signature == this->ScalarsSignature)
  {
    return;
  }
  const Stopwatch stopwatch;
  this->ScalarsSignature.clear();
  const TetrahedralMesh& mesh = this->Scene.GetMesh()->GetMesh();
  if (mesh.GetNumberOfCells() > 0)
  {
    ExtractedScalars scalars = ExtractScalars(input, mesh, selection);
    if (!scalars.Error.empty())
    {
      throw std::invalid_argument(scalars.Error);
    }
    this->ArrayName = std::move(scalars.ArrayName);
    if (scalars.CellData)
    {
      this->Scene.SetCellScalars(std::move(scalars.Values));
    }
    else
    {
      this->Scene.SetPointScalars(std::move(scalars.Values));
    }
  }
  else
  {
    // Nothing to colour, so no array is missed either.
    this->Scene.SetCellScalars({});
  }
  this->ScalarsSignature = std::move(signature);
  this->ScalarsSeconds = stopwatch.GetSeconds();
  this->Rebuilt.push_back("scalars");
}

void ScenePreparation::PrepareFunction(vtkVolume* volume)
{
  vtkVolumeProperty* property = volume->GetProperty();
  const double longestPath = GetLongestPath(*this->Scene.GetMesh(), volume);
  const double maximumError =
    std::max(FunctionErrorShare * this->Mapper->GetMaximumError(), SmallestFunctionError);
  Signature signature = GetPropertySignature(property);
  const OpticalModel model = GetOpticalModel(this->Mapper->GetBlendMode());
  // Error and path matter only where the property had to be approximated.
  if (signature == this->FunctionSignature && model == this->Scene.GetOpticalModel() &&
    (this->FunctionError == 0 ||
      (maximumError == this->FunctionMaximumError && longestPath == this->FunctionLongestPath)))
  {
    return;
  }
  const Stopwatch stopwatch;
  this->FunctionSignature.clear();
  this->Scene.SetOpticalModel(model);
  PropertyTransferFunction function =
    TransferFunctionFromProperty(property, maximumError, longestPath);
  if (model == OpticalModel::MaximumIntensity || model == OpticalModel::Isosurfaces)
  {
    RemoveUnitDistance(function.Function, property->GetScalarOpacityUnitDistance(0));
  }
  if (model == OpticalModel::Isosurfaces)
  {
    this->Scene.SetIsosurfaces(GetIsosurfaces(property, function.Function));
  }
  this->Scene.SetTransferFunction(function.Function);
  this->TableSet = false;
  this->FunctionError = function.Error;
  this->FunctionMaximumError = maximumError;
  this->FunctionLongestPath = longestPath;
  this->FunctionSignature = std::move(signature);
  this->FunctionSeconds = stopwatch.GetSeconds();
  this->Rebuilt.push_back("transfer function");
}

void ScenePreparation::PrepareTable(vtkVolume* volume)
{
  const WalkMesh& mesh = *this->Scene.GetMesh();
  if (this->Mapper->GetIntegration() == vtkTetrahedraVolumeMapper::CLOSED_FORM_INTEGRATION ||
    this->Scene.GetOpticalModel() != OpticalModel::EmissionAbsorption ||
    this->Scene.HasCellScalars() || mesh.GetNumberOfCells() == 0 ||
    this->Scene.GetPlan().ConstantColor || this->Scene.GetPlan().Transparent)
  {
    if (this->TableSet)
    {
      this->Scene.SetTable(nullptr, 0);
      this->TableSet = false;
    }
    return;
  }
  const Stopwatch stopwatch;
  // Rounded, so that a volume which is only turned keeps its table.
  const double scale = static_cast<float>(GetLargestScale(volume));
  SegmentTable::Request request;
  request.Interactive = volume->GetAllocatedRenderTime() < InteractiveSeconds;
  TableGoal& goal = request.Goal;
  goal.MaximumError =
    std::max(TableErrorShare * this->Mapper->GetMaximumError(), SmallestFunctionError);
  goal.MaximumBytes = static_cast<std::size_t>(this->Mapper->GetTableMaximumBytes());
  goal.Rays = this->Scene.GetRaySample(scale);
  goal.LongestSegment = this->Scene.GetLongestEdge() * scale; // no segment is longer
  std::copy_n(this->Scene.GetScalarRange(), 2, goal.ScalarRange);
  goal.AlwaysTable = this->Mapper->GetIntegration() == vtkTetrahedraVolumeMapper::TABLE_INTEGRATION;
  goal.ScalarSize = this->Mapper->GetTableScalarSize();
  goal.LengthSize = this->Mapper->GetTableLengthSize();
  goal.AnyScale = this->Mapper->GetTableLengthScale() == vtkTetrahedraVolumeMapper::AUTOMATIC_SCALE;
  goal.Scale = this->Mapper->GetTableLengthScale() == vtkTetrahedraVolumeMapper::LOGARITHMIC_SCALE
    ? LengthScale::Logarithmic
    : LengthScale::Linear;
  goal.AnyAxis = this->Mapper->GetTableScalarAxis() == vtkTetrahedraVolumeMapper::AUTOMATIC_AXIS;
  goal.Axis = this->Mapper->GetTableScalarAxis() == vtkTetrahedraVolumeMapper::NODES_AXIS
    ? ScalarAxis::Nodes
    : ScalarAxis::Uniform;
  goal.AnyFormat = this->Mapper->GetTableFormat() == vtkTetrahedraVolumeMapper::AUTOMATIC_FORMAT;
  goal.Format = goal.AnyFormat ? TexelFormat::Float
                               : static_cast<TexelFormat>(this->Mapper->GetTableFormat() -
                                   vtkTetrahedraVolumeMapper::UNORM8_FORMAT);
  const bool changed = this->Table.Update(this->Scene.GetTransferFunction(), request);
  if (changed || (!this->TableSet && this->Table.GetTable()))
  {
    this->Scene.SetTable(this->Table.GetTable(), this->Table.GetPictureError());
    this->TableSet = this->Table.GetTable() != nullptr;
  }
  if (changed)
  {
    this->Rebuilt.push_back("table");
  }
  this->TableSeconds = stopwatch.GetSeconds();
}

void ScenePreparation::WarnOfMesh()
{
  std::string warning;
  if (this->Scene.GetMesh()->GetNumberOfCells() == 0)
  {
    warning = "nothing is drawn: of the input's " + std::to_string(this->Intake.NumberOfCells) +
      " cells, none can be rendered as a volume";
  }
  if (this->Intake.GetNumberOfSkippedCells() > 0)
  {
    warning += (warning.empty() ? "" : "; ") + std::string("cells that can't be rendered: ") +
      this->Intake.DescribeSkippedCells();
  }
  this->MeshWarning.Update(this->Mapper, warning);
}

void ScenePreparation::WarnOfShade(vtkVolumeProperty* property)
{
  std::string warning;
  if (property->GetShade(0) && !this->IsShaded(property) &&
    this->Scene.GetMesh()->GetNumberOfCells() > 0)
  {
    warning = this->Scene.HasCellScalars()
      ? "Shade is not used: scalars at cells have no gradient"
      : "Shade is not used: there is light with composite and isosurface blending only";
  }
  if (property->GetDisableGradientOpacity(0) == 0 && property->HasGradientOpacity(0))
  {
    warning += (warning.empty() ? "" : "; ") + std::string("gradient opacity is not used");
  }
  this->ShadeWarning.Update(this->Mapper, warning);
}

bool ScenePreparation::IsShaded(vtkVolumeProperty* property) const
{
  const int mode = this->Mapper->GetBlendMode();
  return property->GetShade(0) != 0 && !this->Scene.HasCellScalars() &&
    (mode == vtkTetrahedraVolumeMapper::COMPOSITE_BLEND ||
      mode == vtkTetrahedraVolumeMapper::ISOSURFACE_BLEND);
}

std::string ScenePreparation::GetIntegrationReason()
{
  if (this->Scene.GetOpticalModel() != OpticalModel::EmissionAbsorption)
  {
    return "exact for this optical model";
  }
  if (this->Scene.GetPlan().ConstantColor)
  {
    return "all that is visible has one colour";
  }
  if (this->Scene.HasCellScalars())
  {
    return "closed form: cells are constant";
  }
  if (this->Mapper->GetIntegration() == vtkTetrahedraVolumeMapper::CLOSED_FORM_INTEGRATION)
  {
    return "closed form: asked for";
  }
  return this->Table.GetReason();
}

void ScenePreparation::WriteSeconds(JsonObject& seconds) const
{
  seconds.Set("intake", this->IntakeSeconds);
  seconds.Set("mesh", this->MeshSeconds);
  seconds.Set("scalars", this->ScalarsSeconds);
  seconds.Set("transfer_function", this->FunctionSeconds);
  seconds.Set("table", this->TableSeconds);
}

JsonObject ScenePreparation::DescribeInput() const
{
  JsonObject input;
  input.Set("points", this->Intake.NumberOfPoints);
  input.Set("cells", this->Intake.NumberOfCells);
  input.Set("ghost_cells", this->Intake.GhostCells);
  input.Set("blanked_cells", this->Intake.BlankedCells);
  input.Set("lower_dimensional_cells", this->Intake.LowerDimensionalCells);
  input.Set("invalid_cells", this->Intake.InvalidCells);
  input.Set("skipped_cells", this->Intake.GetNumberOfSkippedCells());
  input.Set("skipped_cell_types", this->Intake.DescribeSkippedCells());
  input.Set("skipped_blocks", this->Intake.SkippedBlocks);
  input.Set("array", this->ArrayName);
  input.Set("array_of", this->Scene.HasCellScalars() ? "cells" : "points");
  return input;
}

JsonObject ScenePreparation::DescribeTables() const
{
  const WalkMesh& mesh = *this->Scene.GetMesh();
  const RemovedCells& removed = mesh.GetRemovedCells();
  JsonObject removedCells;
  removedCells.Set("invalid_point_ids", removed.InvalidPointIds);
  removedCells.Set("non_finite_coordinates", removed.NonFiniteCoordinates);
  removedCells.Set("repeated_points", removed.RepeatedPoints);
  removedCells.Set("duplicates", removed.Duplicates);

  JsonObject tables;
  tables.Set("tetrahedra", mesh.GetNumberOfCells());
  tables.Set("points", mesh.GetMesh().GetNumberOfPoints());
  tables.Set("boundary_faces", mesh.GetNumberOfBoundaryFaces());
  tables.Set("non_manifold_faces", mesh.GetNumberOfNonManifoldFaces());
  tables.Set("components", mesh.GetNumberOfComponents());
  tables.Set("blank_tetrahedra", this->Scene.GetNumberOfBlankCells());
  tables.Set("removed_tetrahedra", removedCells);
  tables.Set("transfer_function_nodes", this->Scene.GetTransferFunction().Nodes.size());
  tables.Set("bytes", mesh.GetTableSize());
  if (const Convexification* convex = mesh.GetConvexification())
  {
    tables.Set("imaginary_cells", convex->GetNumberOfCells());
    tables.Set("steiner_points", convex->GetNumberOfSteinerPoints());
    tables.Set("convexification_seconds", convex->GetSeconds());
    tables.Set("convexification_refusal", convex->Refusal);
  }
  return tables;
}

JsonObject ScenePreparation::DescribeSegments(const std::string& integration)
{
  JsonObject segments;
  segments.Set("optical_model", GetModelName(this->Scene.GetOpticalModel()));
  segments.Set("integration", integration);
  segments.Set("reason", this->GetIntegrationReason());
  if (const PreIntegrationTable* table = this->Scene.GetTable())
  {
    segments.Set("table_scalar_size", table->Scalars.GetSize());
    segments.Set("table_length_size", table->Lengths.Size);
    segments.Set(
      "table_length_scale", table->Lengths.Scale == LengthScale::Linear ? "linear" : "logarithmic");
    segments.Set(
      "table_scalar_axis", table->Settings.Axis == ScalarAxis::Uniform ? "uniform" : "nodes");
    segments.Set("table_format", GetFormatName(table->Settings.Format));
    segments.Set("table_bytes", table->GetNumberOfBytes());
    segments.Set("table_is_coarse", this->Table.IsCoarse());
  }
  return segments;
}

} // namespace tetralux
