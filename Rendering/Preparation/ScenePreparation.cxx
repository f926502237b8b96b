// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/ScenePreparation.h"

#include "Base/Stopwatch.h"
#include "Frame/HeldContents.h"
#include "Intake/LeftOutCells.h"
#include "Intake/PointExtraction.h"
#include "Intake/ScalarExtraction.h"
#include "Integral/ErrorBudget.h"
#include "Preparation/IsosurfacesFromProperty.h"
#include "Preparation/TransferFunctionFromProperty.h"
#include "Report/PeakMemory.h"
#include "View/MeshToWorld.h"

#include "vtkDataObject.h"
#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tetralux
{
namespace
{

/// Of the progress of a mesh, what taking it in takes.
constexpr double IntakeShare = 0.2;

/// Reports the progress of a part of the work as that of the whole.
std::function<bool(double)> MakePart(
  const std::function<bool(double)>& progress, double from, double to)
{
  if (!progress)
  {
    return {};
  }
  return [&progress, from, to](double share) { return progress(from + share * (to - from)); };
}

/// World units of a length in the mesh, at most.
double GetLargestScale(const vtkMatrix4x4* worldFromMesh)
{
  double rows[3][4];
  std::copy_n(worldFromMesh->GetData(), 12, &rows[0][0]);
  return MeasureStretch(rows).Largest;
}

/// How much brighter than colours lights make them, in steps of a fifth, so that a light which
/// moves a little changes nothing. Infinite if the matrix has no inverse.
double FindBrightness(const SceneInput& input, const WalkMesh& mesh)
{
  if (!input.Lights || !input.Surface)
  {
    return 1;
  }
  double inverse[16];
  vtkMatrix4x4::Invert(input.Matrix->GetData(), inverse);
  double meshFromWorld[3][4];
  std::copy_n(inverse, 12, &meshFromWorld[0][0]);
  const double brightness = FindLargestBrightness(*input.Lights, *input.Surface, meshFromWorld,
    mesh.GetCenter(), mesh.GetRadius(), MeasureMeshToWorld(meshFromWorld).Smallest);
  constexpr double StepsOfDoubling = 4;
  return std::exp2(std::ceil(StepsOfDoubling * std::log2(brightness)) / StepsOfDoubling);
}

/// Share of the error of functions that subdividing a property takes. Runs take what it leaves, all
/// of it if the property is piecewise linear.
constexpr double ShareOfSubdivision = 1. / 4;

/// Whether values are the same; those that are no numbers, too.
bool HaveSameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() &&
    (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// Where one of several scalars is not finite, none is.
void LeaveOutInfinite(const std::vector<double>& other, std::vector<double>& first)
{
  for (std::size_t i = 0; i < other.size(); ++i)
  {
    if (!std::isfinite(other[i]))
    {
      first[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

} // namespace

ScenePreparation::ScenePreparation(vtkObject* source)
  : Source(source)
{
}

bool ScenePreparation::Update(const MapperSettings& wanted, const SceneInput& input,
  const std::function<bool(double)>& progress)
{
  this->Last = Record();
  if (!input.Data)
  {
    throw std::invalid_argument("there is no input");
  }
  const std::vector<DataSetBlock> blocks = CollectDataSets(input.Data);
  const vtkMTimeType inputTime = GetInputTime(input.Data, blocks);
  const vtkMTimeType attributesTime = GetAttributesTime(blocks);
  this->Touched = inputTime != this->InputTime;
  this->ValuesTouched = this->Touched || attributesTime != this->AttributesTime;
  this->ChooseComponents(wanted, blocks, input.Property);
  MapperSettings settings = wanted;
  settings.Scalars = this->Components.Select(0);
  InputKeys keys;
  keys.Cells = GetCellsKey(blocks);
  keys.Points = GetPointsKey(blocks);
  keys.Scalars = GetScalarsKey(blocks, settings.Scalars);
  keys.Scalars.Add(this->Components.Components);
  keys.Colors = settings.Colors ? GetScalarsKey(blocks, *settings.Colors) : CacheKey();
  // Who is told of progress may change the input: what it consists of now is read.
  const vtkSmartPointer<vtkDataObject> data =
    this->IsOf(keys) ? vtkSmartPointer<vtkDataObject>(input.Data) : HoldContents(input.Data);
  const auto recordPeak = [this](const char* stage)
  { this->Last.Peaks.emplace_back(stage, GetPeakMemory()); };
  if (!this->PrepareMesh(settings, data, keys, progress))
  {
    return false;
  }
  recordPeak("mesh");
  if (!this->MergePoints(settings, data, keys.Scalars, progress))
  {
    return false;
  }
  this->PrepareScalars(data, keys.Scalars);
  this->PrepareColors(data, keys.Colors, settings.Colors);
  recordPeak("scalars");
  this->InputTime = inputTime;
  this->AttributesTime = attributesTime;
  this->PrepareFunction(settings, input);
  this->WarnOfShade(input.Property);
  this->Scene.Prepare({});
  recordPeak("transfer_function");
  this->PrepareTable(settings, input);
  recordPeak("table");
  return true;
}

/// Whether the scene was made of that input.
bool ScenePreparation::IsOf(const InputKeys& keys) const
{
  return !this->ValuesTouched && this->Scene.Mesh.GetMesh() && keys.Cells == this->CellsKey &&
    keys.Points == this->PointsKey && this->Scalars.Has(keys.Scalars) &&
    (keys.Colors == CacheKey() || this->Colors.Has(keys.Colors));
}

/// What is shown of the array; several components only if whoever draws them can.
void ScenePreparation::ChooseComponents(const MapperSettings& settings,
  const std::vector<DataSetBlock>& blocks, vtkVolumeProperty* property)
{
  ComponentUse use = FindComponentUse(blocks, settings.Scalars, property);
  if (use.Shown != ComponentUse::Kind::One &&
    !(settings.DrawsComponents && settings.Model == OpticalModel::EmissionAbsorption))
  {
    const std::string who = "only vtkTetrahedraRayCastMapper with composite blending draws";
    if (use.Shown == ComponentUse::Kind::Dependent)
    {
      throw std::invalid_argument(
        "IndependentComponents is off, and " + who + " dependent components");
    }
    use.Shown = ComponentUse::Kind::One;
    use.Components = 1;
    use.Warning = "functions of further components are not used, and the first component is "
                  "shown: " +
      who + " several components";
  }
  this->ComponentsWarning.Update(this->Source, use.Warning);
  this->Components = std::move(use);
}

/// The points that are taken as one; where components disagree, none.
CoincidentPoints ScenePreparation::ChooseMerged(
  const MapperSettings& settings, vtkDataObject* input) const
{
  CoincidentPoints chosen = this->Merger.Choose(settings.Merging, input, settings.Scalars);
  for (int c = 1; c < this->Components.Components; ++c)
  {
    if (!(this->Merger.Choose(settings.Merging, input, this->Components.Select(c)) == chosen))
    {
      return {};
    }
  }
  return chosen;
}

bool ScenePreparation::PrepareMesh(const MapperSettings& settings, vtkDataObject* input,
  const InputKeys& keys, const std::function<bool(double)>& progress)
{
  const bool hasMesh = this->Scene.Mesh.GetMesh() != nullptr;
  const bool isKnown = hasMesh && !this->Touched;
  const bool sameCells = isKnown && keys.Cells == this->CellsKey;
  const bool samePoints = isKnown && keys.Points == this->PointsKey;
  if (sameCells && samePoints)
  {
    return true;
  }
  const Stopwatch intakeStopwatch;
  const std::vector<DataSetBlock> blocks = CollectDataSets(input);
  const Digest cells = sameCells ? this->Cells : DigestCells(blocks);
  const Digest points = samePoints ? this->Points : DigestPoints(blocks);
  if (hasMesh && cells == this->Cells && (points == this->Points || this->MovePoints(input)))
  {
    this->CellsKey = keys.Cells;
    this->PointsKey = keys.Points;
    this->Points = points;
    this->Last.MeshSeconds = intakeStopwatch.GetSeconds();
    return true;
  }
  TetrahedraIntake intake = TakeInTetrahedra(input, MakePart(progress, 0, IntakeShare));
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
  this->Cells = this->Points = Digest();
  this->Merger.Start(settings.Merging, input, intake.Mesh);
  this->Merging.Reset();
  const CoincidentPoints merged = this->ChooseMerged(settings, input);
  bool used = false;
  if (!merged.Points.empty() && !this->UseMerged(settings, input, merged, progress, used))
  {
    return false;
  }
  if (!used)
  {
    auto mesh =
      std::make_shared<WalkMesh>(std::move(intake.Mesh), MakePart(progress, IntakeShare, 1));
    if (!mesh->IsComplete())
    {
      return false;
    }
    this->SetMesh(std::move(mesh), std::move(intake.Report));
    if (!merged.Points.empty())
    {
      this->Merger.CompareWith(*this->Scene.Mesh.GetMesh());
    }
  }
  this->CellsKey = keys.Cells;
  this->PointsKey = keys.Points;
  this->Cells = cells;
  this->Points = points;
  this->Last.MeshSeconds = meshStopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("mesh");
  return true;
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
  const CacheKey& scalars, const std::function<bool(double)>& progress)
{
  CacheKey key = scalars;
  key.Add(settings.Merging);
  const bool isKnown = settings.Merging == PointMerging::Never || this->Merger.HasFound();
  if ((isKnown && !this->ValuesTouched && this->Merging.Has(key)) ||
    this->Scene.Mesh.GetMesh()->GetNumberOfCells() == 0)
  {
    return true;
  }
  const Stopwatch stopwatch;
  if (!isKnown)
  {
    this->Merger.Find(input, *this->Scene.Mesh.GetMesh());
  }
  const CoincidentPoints wanted = this->ChooseMerged(settings, input);
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
  TetrahedraIntake intake = TakeInTetrahedra(input, MakePart(progress, 0, IntakeShare), merged);
  if (intake.Aborted)
  {
    return false;
  }
  if (!intake.Error.empty())
  {
    throw std::invalid_argument(intake.Error);
  }
  auto mesh =
    std::make_shared<WalkMesh>(std::move(intake.Mesh), MakePart(progress, IntakeShare, 1));
  if (!mesh->IsComplete())
  {
    return false;
  }
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

void ScenePreparation::PrepareScalars(vtkDataObject* input, const CacheKey& key)
{
  const bool sameArrays = this->Scalars.Has(key);
  if (sameArrays && !this->ValuesTouched)
  {
    return;
  }
  const Stopwatch stopwatch;
  MeshScene& scene = this->Scene.Mesh;
  const TetrahedralMesh& mesh = scene.GetMesh()->GetMesh();
  // Without cells there is nothing to colour, so no array is missed either.
  ExtractedScalars first;
  first.CellData = true;
  std::vector<std::vector<double>> others(this->Components.Components - 1);
  if (mesh.GetNumberOfCells() > 0)
  {
    first = this->Extract(input, 0);
    for (int c = 1; c < this->Components.Components; ++c)
    {
      others[c - 1] = this->Extract(input, c).Values;
      LeaveOutInfinite(others[c - 1], first.Values);
    }
  }
  if (sameArrays && HaveSameBits(first.Values, scene.GetScalars()) &&
    std::equal(others.begin(), others.end(), scene.GetOtherScalars().begin(),
      scene.GetOtherScalars().end(), HaveSameBits))
  {
    return;
  }
  this->Scalars.Reset();
  this->ArrayName = std::move(first.ArrayName);
  if (first.CellData)
  {
    scene.SetCellScalars(std::move(first.Values));
  }
  else
  {
    scene.SetPointScalars(std::move(first.Values));
  }
  if (!others.empty())
  {
    scene.SetOtherScalars(std::move(others));
  }
  this->Scalars.Set(key);
  this->Last.ScalarsSeconds = stopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("scalars");
}

/// One of the components that are shown.
ExtractedScalars ScenePreparation::Extract(vtkDataObject* input, int component)
{
  ExtractedScalars scalars = ExtractScalars(
    input, this->Scene.Mesh.GetMesh()->GetMesh(), this->Components.Select(component));
  if (!scalars.Error.empty())
  {
    this->Scalars.Reset();
    throw std::invalid_argument(scalars.Error);
  }
  return scalars;
}

void ScenePreparation::PrepareColors(
  vtkDataObject* input, const CacheKey& key, const std::optional<ScalarSelection>& selection)
{
  const TetrahedralMesh& mesh = this->Scene.Mesh.GetMesh()->GetMesh();
  const bool sameArrays = this->Colors.Has(key);
  if ((sameArrays && !this->ValuesTouched) ||
    (!selection && this->Scene.Mesh.GetColorScalars().empty()))
  {
    return;
  }
  const Stopwatch stopwatch;
  std::vector<double> values;
  if (selection && mesh.GetNumberOfCells() > 0)
  {
    ExtractedScalars scalars = ExtractScalars(input, mesh, *selection);
    if (!scalars.Error.empty())
    {
      this->Colors.Reset();
      throw std::invalid_argument("the array to colour by: " + scalars.Error);
    }
    values = std::move(scalars.Values);
  }
  if (sameArrays && HaveSameBits(values, this->Scene.Mesh.GetColorScalars()))
  {
    return;
  }
  this->Scene.Mesh.SetColorScalars(std::move(values));
  this->Colors.Set(key);
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
  spending.LightVaries = input.LightVaries;
  const double allowed = MakeErrorBudget(settings.MaximumError, spending).Functions;
  const double brightness = FindBrightness(input, *this->Scene.Mesh.GetMesh());
  // Nothing stands for anything else where no error is allowed, and where it would save nothing.
  const bool exact = allowed <= SmallestFunctionError || this->Scene.Mesh.HasCellScalars() ||
    this->Components.Shown != ComponentUse::Kind::One || !std::isfinite(brightness);
  const double maximumError =
    std::max((exact ? 1 : ShareOfSubdivision) * allowed, SmallestFunctionError);
  CacheKey exactKey = GetPropertyKey(input.Property);
  exactKey.Add(settings.Model);
  AddComponents(input.Property, this->Components, exactKey);
  if (this->Components.Shown == ComponentUse::Kind::Dependent)
  {
    exactKey.Add(this->Scene.Mesh.GetScalarsVersion()); // red, green and blue are scalars
  }
  CacheKey key = exactKey;
  key.Add(maximumError);
  key.Add(longestPath);
  const auto makeTolerance = [&](const TransferFunction& function, double error)
  {
    RunTolerance tolerance;
    if (!exact)
    {
      const double ofRuns = (allowed - error) / brightness;
      tolerance = MakeRunTolerance(settings.Model, function, ofRuns, longestPath);
      tolerance.Picture *= brightness;
    }
    return tolerance;
  };
  const CacheKey toleranceKey = CacheKey::Of(exact, allowed, brightness, longestPath);
  // Error and path matter only to a property that had to be approximated, and to runs.
  const bool sameFunction = this->Function.Has(this->PropertyError == 0 ? exactKey : key);
  if (sameFunction && this->Tolerance.Has(toleranceKey))
  {
    return;
  }
  const Stopwatch stopwatch;
  this->Tolerance.Reset();
  if (sameFunction)
  {
    SceneOptics& optics = this->Scene.Optics;
    if (optics.SetRunTolerance(makeTolerance(optics.GetTransferFunction(), this->PropertyError)))
    {
      this->Last.Rebuilt.push_back("transfer function");
    }
    this->Tolerance.Set(toleranceKey);
    this->Last.FunctionSeconds = stopwatch.GetSeconds();
    return;
  }
  this->Function.Reset();
  this->Scene.Optics.SetModel(settings.Model);
  PropertyTransferFunction function = this->MakeFunctions(input, maximumError, longestPath);
  if (settings.Model == OpticalModel::MaximumIntensity ||
    settings.Model == OpticalModel::Isosurfaces)
  {
    RemoveUnitDistance(function.Function, input.Property->GetScalarOpacityUnitDistance(0));
  }
  if (settings.Model == OpticalModel::Isosurfaces)
  {
    this->Scene.Optics.SetIsosurfaces(IsosurfacesFromProperty(input.Property, function.Function));
  }
  const RunTolerance tolerance = makeTolerance(function.Function, function.Error);
  this->Scene.Optics.SetTransferFunction(std::move(function.Function), function.Error, tolerance);
  this->PropertyError = function.Error;
  this->Function.Set(this->PropertyError == 0 ? exactKey : key);
  this->Tolerance.Set(toleranceKey);
  this->Last.FunctionSeconds = stopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("transfer function");
}

/// The function of the first component, and in the scene those of all if several are shown.
PropertyTransferFunction ScenePreparation::MakeFunctions(
  const SceneInput& input, double maximumError, double longestPath)
{
  SceneOptics& optics = this->Scene.Optics;
  if (this->Components.Shown == ComponentUse::Kind::One)
  {
    optics.SetComponents({});
    return TransferFunctionFromProperty(input.Property, maximumError, longestPath);
  }
  std::vector<const std::vector<double>*> values = { &this->Scene.Mesh.GetScalars() };
  for (const std::vector<double>& other : this->Scene.Mesh.GetOtherScalars())
  {
    values.push_back(&other);
  }
  PropertyTransferFunction function;
  ComponentFunctions components = ComponentsFromProperty(
    input.Property, this->Components, values, maximumError, longestPath, function.Error);
  function.Function = components.Functions.front();
  optics.SetComponents(std::move(components));
  return function;
}

void ScenePreparation::PrepareTable(const MapperSettings& settings, const SceneInput& input)
{
  const TableWishes& wishes = settings.Table;
  SceneOptics& optics = this->Scene.Optics;
  const std::uint64_t function = optics.GetFunctionVersion();
  this->Use = wishes.Use;
  if (wishes.Use == TableUse::Never || input.LightVaries || this->Scene.HasComponents() ||
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
  goal.PiecesPerSegment = this->Scene.EstimatePieces();
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
      : this->Scene.HasComponents()
      ? "Shade is not used: several components are not lit"
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
    !this->Scene.HasComponents() &&
    (model == OpticalModel::EmissionAbsorption || model == OpticalModel::Isosurfaces);
}

} // namespace tetralux
