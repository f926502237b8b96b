// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/ScenePreparation.h"

#include "Base/Stopwatch.h"
#include "Intake/LeftOutCells.h"
#include "Intake/PointExtraction.h"
#include "Intake/ScalarExtraction.h"
#include "Integral/ErrorBudget.h"
#include "Preparation/IsosurfacesFromProperty.h"
#include "Preparation/TransferFunctionFromProperty.h"
#include "View/MeshToWorld.h"

#include "vtkMatrix4x4.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// World units of a length in the mesh, at most.
double GetLargestScale(const vtkMatrix4x4* worldFromMesh)
{
  double rows[3][4];
  std::copy_n(worldFromMesh->GetData(), 12, &rows[0][0]);
  return MeasureStretch(rows).Largest;
}

} // namespace

ScenePreparation::ScenePreparation(vtkObject* source)
  : Source(source)
{
}

bool ScenePreparation::Update(const MapperSettings& settings, const SceneInput& input,
  const std::function<bool(double)>& progress)
{
  this->Last = Record();
  if (!input.Data)
  {
    throw std::invalid_argument("there is no input");
  }
  const std::vector<DataSetBlock> blocks = CollectDataSets(input.Data);
  if (!this->PrepareMesh(settings, input.Data, blocks, progress))
  {
    return false;
  }
  if (!this->MergePoints(settings, input.Data, blocks, progress))
  {
    return false;
  }
  this->PrepareScalars(input.Data, blocks, settings.Scalars);
  this->PrepareColors(input.Data, blocks, settings.Colors);
  this->PrepareFunction(settings, input);
  this->WarnOfShade(input.Property);
  this->Scene.Prepare({});
  this->PrepareTable(settings, input);
  return true;
}

bool ScenePreparation::PrepareMesh(const MapperSettings& settings, vtkDataObject* input,
  const std::vector<DataSetBlock>& blocks, const std::function<bool(double)>& progress)
{
  CacheKey cellsKey = GetCellsKey(blocks);
  CacheKey pointsKey = GetPointsKey(blocks);
  const bool hasMesh = this->Scene.Mesh.GetMesh() != nullptr;
  const bool sameCells = hasMesh && cellsKey == this->CellsKey;
  if (sameCells && pointsKey == this->PointsKey)
  {
    return true;
  }
  const Stopwatch intakeStopwatch;
  const Digest digest = sameCells ? this->Cells : DigestCells(blocks);
  if (hasMesh && digest == this->Cells && this->MovePoints(input))
  {
    this->CellsKey = std::move(cellsKey);
    this->PointsKey = std::move(pointsKey);
    this->Last.MeshSeconds = intakeStopwatch.GetSeconds();
    return true;
  }
  TetrahedraIntake intake = TakeInTetrahedra(input, progress);
  if (intake.Aborted)
  {
    return false;
  }
  if (!intake.Error.empty())
  {
    throw std::invalid_argument(intake.Error);
  }
  this->Last.IntakeSeconds = intakeStopwatch.GetSeconds();

  const Stopwatch meshStopwatch;
  // What is found belongs to this input: if it is aborted, the mesh of the last one is of no use.
  this->CellsKey = CacheKey();
  this->PointsKey = CacheKey();
  this->Cells = Digest();
  this->Merger.Start(settings.Merging, input, intake.Mesh);
  this->Merging.Reset();
  const CoincidentPoints merged = this->Merger.Choose(settings.Merging, input, settings.Scalars);
  bool used = false;
  if (!merged.Points.empty() && !this->UseMerged(settings, input, merged, progress, used))
  {
    return false;
  }
  if (!used)
  {
    this->SetMesh(std::move(intake));
    if (!merged.Points.empty())
    {
      this->Merger.CompareWith(*this->Scene.Mesh.GetMesh());
    }
  }
  this->CellsKey = std::move(cellsKey);
  this->PointsKey = std::move(pointsKey);
  this->Cells = digest;
  this->Last.MeshSeconds = meshStopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("mesh");
  return true;
}

void ScenePreparation::SetMesh(TetrahedraIntake intake)
{
  this->SetMesh(std::make_shared<WalkMesh>(std::move(intake.Mesh)), std::move(intake.Report));
}

void ScenePreparation::SetMesh(std::shared_ptr<WalkMesh> mesh, TetrahedraIntakeReport report)
{
  this->Scene.Mesh.SetMesh(std::move(mesh));
  this->Intake = std::move(report);
  this->Scalars.Reset();
  this->Colors.Reset();
  this->WarnOfMesh();
}

/// Makes the mesh anew where other points are to be taken as one.
bool ScenePreparation::MergePoints(const MapperSettings& settings, vtkDataObject* input,
  const std::vector<DataSetBlock>& blocks, const std::function<bool(double)>& progress)
{
  CacheKey key = GetScalarsKey(blocks, settings.Scalars);
  key.Add(settings.Merging);
  const bool isKnown = settings.Merging == PointMerging::Never || this->Merger.HasFound();
  if ((isKnown && this->Merging.Has(key)) || this->Scene.Mesh.GetMesh()->GetNumberOfCells() == 0)
  {
    return true;
  }
  const Stopwatch stopwatch;
  if (!isKnown)
  {
    this->Merger.Find(input, *this->Scene.Mesh.GetMesh());
  }
  const CoincidentPoints wanted = this->Merger.Choose(settings.Merging, input, settings.Scalars);
  const CoincidentPoints before = this->Merger.GetMerged();
  bool used = wanted == before;
  if (!used && !this->UseMerged(settings, input, wanted, progress, used))
  {
    return false;
  }
  // Where it does not fit together, points stay apart.
  if (!used && !before.Points.empty() && !this->UseMerged(settings, input, {}, progress, used))
  {
    return false;
  }
  if (!(before == this->Merger.GetMerged()))
  {
    this->Last.Rebuilt.push_back("merged points");
  }
  this->Merging.Set(std::move(key));
  this->Last.MeshSeconds += stopwatch.GetSeconds();
  return true;
}

/// Makes the mesh with some points taken as one; used: whether it replaces that of the scene. False
/// after an abort.
bool ScenePreparation::UseMerged(const MapperSettings& settings, vtkDataObject* input,
  const CoincidentPoints& merged, const std::function<bool(double)>& progress, bool& used)
{
  TetrahedraIntake intake = TakeInTetrahedra(input, progress, merged);
  if (intake.Aborted)
  {
    return false;
  }
  if (!intake.Error.empty())
  {
    throw std::invalid_argument(intake.Error);
  }
  auto mesh = std::make_shared<WalkMesh>(std::move(intake.Mesh));
  used = this->Merger.Accept(settings.Merging, merged, *mesh);
  if (used)
  {
    this->SetMesh(std::move(mesh), std::move(intake.Report));
  }
  return true;
}

/// Of the same cells. Returns false where the mesh has to be made anew.
bool ScenePreparation::MovePoints(vtkDataObject* input)
{
  const WalkMesh& walk = *this->Scene.Mesh.GetMesh();
  // Cells that were removed because of their points may come back.
  if (DependsOnPoints(this->Intake) || walk.GetRemovedCells().NonFiniteCoordinates > 0 ||
    !this->Merger.Follow(input))
  {
    return false;
  }
  const TetrahedralMesh& mesh = walk.GetMesh();
  const std::vector<double> points = ExtractPoints(input, mesh);
  if (points == mesh.Points)
  {
    return true;
  }
  if (!this->Scene.Mesh.SetPoints(points))
  {
    return false;
  }
  this->Last.Rebuilt.push_back("points");
  return true;
}

void ScenePreparation::PrepareScalars(
  vtkDataObject* input, const std::vector<DataSetBlock>& blocks, const ScalarSelection& selection)
{
  CacheKey key = GetScalarsKey(blocks, selection);
  if (this->Scalars.Has(key))
  {
    return;
  }
  const Stopwatch stopwatch;
  this->Scalars.Reset();
  const TetrahedralMesh& mesh = this->Scene.Mesh.GetMesh()->GetMesh();
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
      this->Scene.Mesh.SetCellScalars(std::move(scalars.Values));
    }
    else
    {
      this->Scene.Mesh.SetPointScalars(std::move(scalars.Values));
    }
  }
  else
  {
    // Nothing to colour, so no array is missed either.
    this->Scene.Mesh.SetCellScalars({});
  }
  this->Scalars.Set(std::move(key));
  this->Last.ScalarsSeconds = stopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("scalars");
}

void ScenePreparation::PrepareColors(vtkDataObject* input, const std::vector<DataSetBlock>& blocks,
  const std::optional<ScalarSelection>& selection)
{
  CacheKey key = selection ? GetScalarsKey(blocks, *selection) : CacheKey();
  const TetrahedralMesh& mesh = this->Scene.Mesh.GetMesh()->GetMesh();
  if (this->Colors.Has(key) || (!selection && this->Scene.Mesh.GetColorScalars().empty()))
  {
    return;
  }
  const Stopwatch stopwatch;
  this->Colors.Reset();
  std::vector<double> values;
  if (selection && mesh.GetNumberOfCells() > 0)
  {
    ExtractedScalars scalars = ExtractScalars(input, mesh, *selection);
    if (!scalars.Error.empty())
    {
      throw std::invalid_argument("the array to colour by: " + scalars.Error);
    }
    values = std::move(scalars.Values);
  }
  this->Scene.Mesh.SetColorScalars(std::move(values));
  this->Colors.Set(std::move(key));
  this->Last.ScalarsSeconds += stopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("colours");
}

void ScenePreparation::PrepareFunction(const MapperSettings& settings, const SceneInput& input)
{
  // A power of two, so that a path which grows a little changes nothing.
  const double longestPath = std::exp2(std::ceil(
    std::log2(2 * this->Scene.Mesh.GetMesh()->GetRadius() * GetLargestScale(input.Matrix))));
  ErrorSpending spending;
  spending.Approximated = true;
  const double maximumError =
    std::max(MakeErrorBudget(settings.MaximumError, spending).Functions, SmallestFunctionError);
  CacheKey exactKey = GetPropertyKey(input.Property);
  exactKey.Add(settings.Model);
  CacheKey key = exactKey;
  key.Add(maximumError);
  key.Add(longestPath);
  // Error and path matter only to a property that had to be approximated.
  if (this->Function.Has(this->FunctionIsExact ? exactKey : key))
  {
    return;
  }
  const Stopwatch stopwatch;
  this->Function.Reset();
  this->Scene.Optics.SetModel(settings.Model);
  PropertyTransferFunction function =
    TransferFunctionFromProperty(input.Property, maximumError, longestPath);
  if (settings.Model == OpticalModel::MaximumIntensity ||
    settings.Model == OpticalModel::Isosurfaces)
  {
    RemoveUnitDistance(function.Function, input.Property->GetScalarOpacityUnitDistance(0));
  }
  if (settings.Model == OpticalModel::Isosurfaces)
  {
    this->Scene.Optics.SetIsosurfaces(IsosurfacesFromProperty(input.Property, function.Function));
  }
  this->Scene.Optics.SetTransferFunction(function.Function, function.Error);
  this->FunctionIsExact = function.Error == 0;
  this->Function.Set(this->FunctionIsExact ? exactKey : key);
  this->Last.FunctionSeconds = stopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("transfer function");
}

void ScenePreparation::PrepareTable(const MapperSettings& settings, const SceneInput& input)
{
  const TableWishes& wishes = settings.Table;
  SceneOptics& optics = this->Scene.Optics;
  const std::uint64_t function = optics.GetFunctionVersion();
  this->Use = wishes.Use;
  if (wishes.Use == TableUse::Never || input.LightVaries ||
    optics.GetModel() != OpticalModel::EmissionAbsorption || this->Scene.Mesh.HasCellScalars() ||
    this->Scene.Mesh.GetMesh()->GetNumberOfCells() == 0 || this->Scene.GetPlan().ConstantColor ||
    this->Scene.GetPlan().Transparent)
  {
    if (optics.GetTable())
    {
      optics.SetTable(nullptr, 0);
    }
    this->TableOfFunction = 0;
    return;
  }
  const Stopwatch stopwatch;
  // Rounded, so that a volume which is only turned keeps its table.
  const double scale = static_cast<float>(GetLargestScale(input.Matrix));
  ErrorSpending spending;
  spending.Tabulated = true;
  SegmentTable::Request request;
  request.Interactive = input.Interactive;
  TableGoal& goal = request.Goal;
  goal.MaximumError =
    std::max(MakeErrorBudget(settings.MaximumError, spending).Table, SmallestFunctionError);
  goal.MaximumBytes = wishes.MaximumBytes;
  goal.Rays = this->Scene.Mesh.DrawRays(scale);
  this->Scene.Mesh.PrepareLongestEdge();
  goal.LongestSegment = this->Scene.Mesh.GetLongestEdge() * scale; // no segment is longer
  std::copy_n(this->Scene.Mesh.GetScalarRange(), 2, goal.ScalarRange);
  goal.AlwaysTable = wishes.Use == TableUse::Always;
  goal.ScalarSize = wishes.ScalarSize;
  goal.LengthSize = wishes.LengthSize;
  goal.AnyScale = !wishes.Scale;
  goal.Scale = wishes.Scale.value_or(LengthScale::Linear);
  goal.AnyAxis = !wishes.Axis;
  goal.Axis = wishes.Axis.value_or(ScalarAxis::Uniform);
  goal.AnyFormat = !wishes.Format;
  goal.Format = wishes.Format.value_or(TexelFormat::Float);
  const bool changed = this->Table.Update(optics.GetTransferFunction(), request);
  // A new function removed the table from the scene, though it may still be that of the function.
  if (changed || this->TableOfFunction != function)
  {
    optics.SetTable(this->Table.GetTable(), this->Table.GetPictureError());
    this->TableOfFunction = function;
  }
  if (changed)
  {
    this->Last.Rebuilt.push_back("table");
  }
  this->Last.TableSeconds = stopwatch.GetSeconds();
}

void ScenePreparation::WarnOfMesh()
{
  std::string warning;
  if (this->Scene.Mesh.GetMesh()->GetNumberOfCells() == 0)
  {
    warning = "nothing is drawn: of the input's " + std::to_string(this->Intake.NumberOfCells) +
      " cells, none can be rendered as a volume";
  }
  const std::string leftOut =
    DescribeLeftOutCells(this->Intake, this->Scene.Mesh.GetMesh()->GetRemovedCells());
  for (const std::string& text : { leftOut, DescribeFoldedCells(this->Intake) })
  {
    warning += (warning.empty() || text.empty() ? "" : "; ") + text;
  }
  this->MeshWarning.Update(this->Source, warning);
}

void ScenePreparation::WarnOfShade(vtkVolumeProperty* property)
{
  std::string warning;
  if (property->GetShade(0) && !this->IsShaded(property) &&
    this->Scene.Mesh.GetMesh()->GetNumberOfCells() > 0)
  {
    warning = this->Scene.Mesh.HasCellScalars()
      ? "Shade is not used: scalars at cells have no gradient"
      : "Shade is not used: there is light with composite and isosurface blending only";
  }
  if (property->GetDisableGradientOpacity(0) == 0 && property->HasGradientOpacity(0))
  {
    warning += (warning.empty() ? "" : "; ") + std::string("gradient opacity is not used");
  }
  this->ShadeWarning.Update(this->Source, warning);
}

bool ScenePreparation::IsShaded(vtkVolumeProperty* property) const
{
  const OpticalModel model = this->Scene.Optics.GetModel();
  return property->GetShade(0) != 0 && !this->Scene.Mesh.HasCellScalars() &&
    (model == OpticalModel::EmissionAbsorption || model == OpticalModel::Isosurfaces);
}

} // namespace tetralux
