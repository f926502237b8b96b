// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "CameraRays.h"
#include "CellVolumes.h"
#include "ImageCompositor.h"
#include "InputSignature.h"
#include "JsonObject.h"
#include "OpaqueDistances.h"
#include "RayCaster.h"
#include "RendererLights.h"
#include "SegmentTable.h"
#include "TransferFunctionFromProperty.h"

#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkContourValues.h"
#include "vtkDataSet.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkTetrahedraIntake.h"
#include "vtkTetrahedraScalars.h"
#include "vtkUnstructuredGridBase.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <stdexcept>
#include <vector>

using tetralux::CameraRays;
using tetralux::JsonObject;
using tetralux::RayCaster;
using tetralux::RayLimits;

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

class Stopwatch
{
public:
  double GetSeconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

/// Thrown through the stages of a frame when the render window asks to abort.
struct Abort
{
};

/// The inverse of a volume's matrix.
void SetMeshFromWorld(vtkVolume* volume, double meshFromWorld[3][4])
{
  const vtkMatrix4x4* matrix = volume->GetMatrix();
  const double* rows = matrix->GetData();
  if (rows[12] != 0 || rows[13] != 0 || rows[14] != 0 || rows[15] == 0)
  {
    throw std::invalid_argument("the volume's matrix is not affine: its last row must be 0 0 0 1");
  }
  const double determinant = vtkMatrix4x4::Determinant(rows);
  double inverse[16];
  if (determinant != 0)
  {
    vtkMatrix4x4::Invert(rows, inverse);
  }
  const auto isFinite = [](double x) { return std::isfinite(x); };
  if (determinant == 0 || !std::all_of(inverse, inverse + 16, isFinite))
  {
    throw std::invalid_argument(
      "the volume's matrix has no inverse: is a scale of the volume 0, or not a number?");
  }
  std::copy_n(inverse, 12, &meshFromWorld[0][0]);
}

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
double GetLongestPath(const tetralux::WalkMesh& mesh, vtkVolume* volume)
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

void AddClippingPlanes(vtkPlaneCollection* planes, RayLimits& limits)
{
  for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
  {
    vtkPlane* plane = planes->GetItem(i);
    const double* normal = plane->GetNormal();
    limits.Planes.push_back(
      { normal[0], normal[1], normal[2], -vtkMath::Dot(normal, plane->GetOrigin()) });
  }
}

using tetralux::OpticalModel;
using Mapper = vtkTetrahedraRayCastMapper;

OpticalModel GetOpticalModel(int blendMode)
{
  switch (blendMode)
  {
    case Mapper::COMPOSITE_BLEND:
      return OpticalModel::EmissionAbsorption;
    case Mapper::MAXIMUM_INTENSITY_BLEND:
      return OpticalModel::MaximumIntensity;
    case Mapper::ADDITIVE_BLEND:
      return OpticalModel::EmissionOnly;
    case Mapper::ISOSURFACE_BLEND:
      return OpticalModel::Isosurfaces;
    case Mapper::ABSORPTION_BLEND:
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
std::vector<tetralux::Isosurface> GetIsosurfaces(
  vtkVolumeProperty* property, const tetralux::TransferFunction& opacities)
{
  vtkContourValues* values = property->GetIsoSurfaceValues();
  if (values->GetNumberOfContours() == 0)
  {
    throw std::invalid_argument(
      "the volume property has no IsoSurfaceValues, which the isosurface BlendMode shows");
  }
  std::vector<tetralux::Isosurface> surfaces;
  for (int i = 0; i < values->GetNumberOfContours(); ++i)
  {
    const tetralux::TransferFunction::Value value =
      tetralux::Evaluate(opacities, values->GetValue(i));
    tetralux::Isosurface surface;
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
void RemoveUnitDistance(tetralux::TransferFunction& function, double unitDistance)
{
  for (tetralux::TransferFunction::Node& node : function.Nodes)
  {
    node.Left.Attenuation *= unitDistance;
    node.Right.Attenuation *= unitDistance;
  }
}

const char* GetFormatName(tetralux::TexelFormat format)
{
  switch (format)
  {
    case tetralux::TexelFormat::UNorm8:
      return "8-bit";
    case tetralux::TexelFormat::UNorm16:
      return "16-bit";
    case tetralux::TexelFormat::Half:
      return "half";
    default:
      return "float";
  }
}

const char* GetPrecisionName(int precision)
{
  switch (precision)
  {
    case vtkTetrahedraRayCastMapper::SINGLE_PRECISION:
      return "single";
    case vtkTetrahedraRayCastMapper::DOUBLE_PRECISION:
      return "double";
    default:
      return "automatic";
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
// The stages of a frame, what they keep and what they report.
class vtkTetrahedraRayCastMapper::Internals
{
public:
  explicit Internals(vtkTetrahedraRayCastMapper* self)
    : Self(self)
  {
  }

  /// Throws what the stages throw, or Abort.
  void DrawFrame(vtkRenderer* renderer, vtkVolume* volume);

  void WriteStatistics();

  /// Empties what the last frame left, where the next one fails.
  void Clear();

  /// One error for each cause: not again until a frame succeeds.
  void ReportOnce(const std::string& error);

  RayCaster Caster;
  tetralux::ImageCompositor Compositor;
  tetralux::TetrahedraIntakeReport Intake;
  vtkNew<vtkImageData> Image;
  double ErrorEstimate = 0;
  std::string Statistics = "{}";
  std::string LastError;

private:
  void PrepareMesh(vtkDataObject* input);
  void PrepareScalars(vtkDataObject* input);
  void PrepareFunction(vtkVolume* volume);
  void PrepareTable(vtkVolume* volume);
  double ChooseSampleDistance(vtkRenderer* renderer, vtkVolume* volume) const;
  void Cast(vtkRenderer* renderer, vtkVolume* volume, const CameraRays& rays);
  tetralux::Span<float> GetArray(const char* name, int components);
  void WarnOfMesh();
  void WarnOfShade(vtkVolumeProperty* property);
  void WarnOfReentry();

  std::string GetIntegrationReason();

  /// Tells how far a stage is, and asks whether to go on.
  bool Continue(unsigned long event, double fraction) const;

  vtkTetrahedraRayCastMapper* Self;
  vtkOpenGLRenderWindow* Window = nullptr; ///< of the frame that is being drawn

  // What was built, and from what.
  tetralux::Signature MeshSignature;
  tetralux::Signature ScalarsSignature;
  tetralux::Signature FunctionSignature;
  double FunctionMaximumError = 0;
  double FunctionLongestPath = 0;
  std::string ArrayName;
  bool CellData = false;
  double FunctionError = 0;
  int NumberOfNodes = 0;
  OpticalModel FunctionModel = OpticalModel::EmissionAbsorption;
  tetralux::TransferFunction Function;
  double LongestEdge = 0; ///< of the mesh, in its units; 0: not found yet
  tetralux::SegmentTable Table;
  bool TableSet = false;    ///< the ray caster has Table
  double SecondsPerRay = 0; ///< of the last frame that was cast; 0: none yet
  bool WarnedOfShade = false;
  std::string ReentryWarning; ///< the last one
  std::string MeshWarning;    ///< the last one: the next time step may have the same

  // The last frame.
  struct Frame
  {
    std::vector<std::string> Rebuilt;
    double IntakeSeconds = 0;
    double MeshSeconds = 0;
    double ScalarsSeconds = 0;
    double FunctionSeconds = 0;
    double TableSeconds = 0;
    double DepthSeconds = 0;
    double CastSeconds = 0;
    double CompositeSeconds = 0;
    double Seconds = 0;
    tetralux::RayCastStatistics Rays;
    int Size[2] = { 0, 0 };
    double SampleDistance = 1;
    bool Clipped = false;
    bool Opaque = false;
    bool Shaded = false;
  };
  Frame Last;
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::DrawFrame(vtkRenderer* renderer, vtkVolume* volume)
{
  const Stopwatch stopwatch;
  this->Last = Frame();
  this->Caster.SetOpticalModel(GetOpticalModel(this->Self->BlendMode));
  this->Window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!this->Window)
  {
    throw std::invalid_argument("the renderer has no OpenGL render window");
  }
  vtkDataObject* input = this->Self->GetDataObjectInput();
  if (!input)
  {
    throw std::invalid_argument("there is no input");
  }
  this->PrepareMesh(input);
  this->PrepareScalars(input);
  this->PrepareFunction(volume);
  this->PrepareTable(volume);

  this->Last.SampleDistance = this->ChooseSampleDistance(renderer, volume);
  const CameraRays rays(renderer, this->Last.SampleDistance);
  if (rays.GetVisible().Width == 0)
  {
    this->Image->Initialize(); // a tile that shows nothing of the viewport
    return;
  }
  this->Cast(renderer, volume, rays);

  const Stopwatch compositeStopwatch;
  if (this->Last.Rays.Paths > 0) // else there is nothing in the picture
  {
    this->Compositor.Composite(this->Window, rays.GetVisible(),
      vtkFloatArray::SafeDownCast(this->Image->GetPointData()->GetArray("RGBA"))->GetPointer(0),
      this->Last.Size[0], this->Last.Size[1]);
  }
  this->Last.CompositeSeconds = compositeStopwatch.GetSeconds();
  this->Last.Seconds = stopwatch.GetSeconds();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::PrepareMesh(vtkDataObject* input)
{
  tetralux::Signature signature = tetralux::GetMeshSignature(input);
  if (this->Caster.GetMesh() && signature == this->MeshSignature)
  {
    return;
  }
  const Stopwatch intakeStopwatch;
  tetralux::TetrahedraIntake intake = tetralux::TakeInTetrahedra(
    input, [this](double fraction) { return this->Continue(vtkCommand::ProgressEvent, fraction); });
  if (intake.Aborted)
  {
    this->Image->Initialize();
    this->Last.Rays.Aborted = true;
    throw Abort();
  }
  if (!intake.Error.empty())
  {
    throw std::invalid_argument(intake.Error);
  }
  this->Last.IntakeSeconds = intakeStopwatch.GetSeconds();

  const Stopwatch meshStopwatch;
  this->Caster.SetMesh(std::make_shared<tetralux::WalkMesh>(std::move(intake.Mesh)));
  this->Intake = std::move(intake.Report);
  this->MeshSignature = std::move(signature);
  this->ScalarsSignature.clear();
  this->LongestEdge = 0;
  this->Last.MeshSeconds = meshStopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("mesh");
  this->WarnOfMesh();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::PrepareScalars(vtkDataObject* input)
{
  tetralux::ScalarSelection selection;
  selection.ScalarMode = this->Self->ScalarMode;
  selection.ArrayAccessMode = this->Self->ArrayAccessMode;
  selection.ArrayId = this->Self->ArrayId;
  selection.ArrayName = this->Self->ArrayName ? this->Self->ArrayName : "";
  selection.VectorMode = this->Self->VectorMode;
  selection.VectorComponent = this->Self->VectorComponent;
  tetralux::Signature signature = tetralux::GetScalarsSignature(input, selection);
  if (signature == this->ScalarsSignature)
  {
    return;
  }
  const Stopwatch stopwatch;
  this->ScalarsSignature.clear();
  const tetralux::TetrahedralMesh& mesh = this->Caster.GetMesh()->GetMesh();
  if (mesh.GetNumberOfCells() > 0)
  {
    tetralux::ExtractedScalars scalars = tetralux::ExtractScalars(input, mesh, selection);
    if (!scalars.Error.empty())
    {
      throw std::invalid_argument(scalars.Error);
    }
    this->CellData = scalars.CellData;
    this->ArrayName = std::move(scalars.ArrayName);
    if (scalars.CellData)
    {
      this->Caster.SetCellScalars(std::move(scalars.Values));
    }
    else
    {
      this->Caster.SetPointScalars(std::move(scalars.Values));
    }
  }
  else
  {
    // Nothing to colour, so no array is missed either.
    this->Caster.SetCellScalars({});
  }
  this->ScalarsSignature = std::move(signature);
  this->Last.ScalarsSeconds = stopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("scalars");
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::PrepareFunction(vtkVolume* volume)
{
  vtkVolumeProperty* property = volume->GetProperty();
  const double longestPath = GetLongestPath(*this->Caster.GetMesh(), volume);
  const double maximumError =
    std::max(FunctionErrorShare * this->Self->MaximumError, SmallestFunctionError);
  tetralux::Signature signature = tetralux::GetPropertySignature(property);
  const OpticalModel model = GetOpticalModel(this->Self->BlendMode);
  this->WarnOfShade(property);
  // Error and path matter only where the property had to be approximated.
  if (signature == this->FunctionSignature && model == this->FunctionModel &&
    (this->FunctionError == 0 ||
      (maximumError == this->FunctionMaximumError && longestPath == this->FunctionLongestPath)))
  {
    return;
  }
  const Stopwatch stopwatch;
  this->FunctionSignature.clear();
  tetralux::PropertyTransferFunction function =
    tetralux::TransferFunctionFromProperty(property, maximumError, longestPath);
  if (model == OpticalModel::MaximumIntensity || model == OpticalModel::Isosurfaces)
  {
    RemoveUnitDistance(function.Function, property->GetScalarOpacityUnitDistance(0));
  }
  if (model == OpticalModel::Isosurfaces)
  {
    this->Caster.SetIsosurfaces(GetIsosurfaces(property, function.Function));
  }
  this->Caster.SetTransferFunction(function.Function);
  this->TableSet = false;
  this->Function = function.Function;
  this->FunctionModel = model;
  this->FunctionError = function.Error;
  this->NumberOfNodes = static_cast<int>(function.Function.Nodes.size());
  this->FunctionMaximumError = maximumError;
  this->FunctionLongestPath = longestPath;
  this->FunctionSignature = std::move(signature);
  this->Last.FunctionSeconds = stopwatch.GetSeconds();
  this->Last.Rebuilt.push_back("transfer function");
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::PrepareTable(vtkVolume* volume)
{
  const tetralux::WalkMesh& mesh = *this->Caster.GetMesh();
  if (this->Self->Integration == CLOSED_FORM ||
    this->FunctionModel != OpticalModel::EmissionAbsorption || this->Caster.HasCellScalars() ||
    mesh.GetNumberOfCells() == 0 || this->Caster.GetPlan().ConstantColor ||
    this->Caster.GetPlan().Transparent)
  {
    if (this->TableSet)
    {
      this->Caster.SetTable(nullptr, 0);
      this->TableSet = false;
    }
    return;
  }
  const Stopwatch stopwatch;
  if (this->LongestEdge == 0)
  {
    this->LongestEdge = tetralux::MeasureCells(mesh.GetMesh()).LongestEdge; // no segment is longer
  }
  const double scale = GetLargestScale(volume);
  tetralux::SegmentTable::Request request;
  request.Interactive = volume->GetAllocatedRenderTime() < InteractiveSeconds;
  tetralux::TableGoal& goal = request.Goal;
  goal.MaximumError = std::max(TableErrorShare * this->Self->MaximumError, SmallestFunctionError);
  goal.MaximumBytes = static_cast<std::size_t>(this->Self->TableMaximumBytes);
  goal.Rays.PathLength = 2 * mesh.GetRadius() * scale;
  goal.Rays.LongestSegment = this->LongestEdge * scale;
  std::copy_n(this->Caster.GetScalarRange(), 2, goal.Rays.ScalarRange);
  goal.AlwaysTable = this->Self->Integration == TABLE;
  goal.ScalarSize = this->Self->TableScalarSize;
  goal.LengthSize = this->Self->TableLengthSize;
  goal.AnyScale = this->Self->TableLengthScale == AUTOMATIC_SCALE;
  goal.Scale = this->Self->TableLengthScale == LOGARITHMIC_SCALE
    ? tetralux::LengthScale::Logarithmic
    : tetralux::LengthScale::Linear;
  goal.AnyAxis = this->Self->TableScalarAxis == AUTOMATIC_AXIS;
  goal.Axis = this->Self->TableScalarAxis == NODES_AXIS ? tetralux::ScalarAxis::Nodes
                                                        : tetralux::ScalarAxis::Uniform;
  goal.AnyFormat = this->Self->TableFormat == AUTOMATIC_FORMAT;
  goal.Format = goal.AnyFormat
    ? tetralux::TexelFormat::Float
    : static_cast<tetralux::TexelFormat>(this->Self->TableFormat - UNORM8_FORMAT);
  const bool changed = this->Table.Update(this->Function, request);
  if (changed || (!this->TableSet && this->Table.GetTable()))
  {
    this->Caster.SetTable(this->Table.GetTable(), this->Table.GetPictureError());
    this->TableSet = this->Table.GetTable() != nullptr;
  }
  if (changed)
  {
    this->Last.Rebuilt.push_back("table");
  }
  this->Last.TableSeconds = stopwatch.GetSeconds();
}

//------------------------------------------------------------------------------------------------
double vtkTetrahedraRayCastMapper::Internals::ChooseSampleDistance(
  vtkRenderer* renderer, vtkVolume* volume) const
{
  if (!this->Self->AutoAdjustSampleDistances)
  {
    return this->Self->ImageSampleDistance;
  }
  int width, height;
  renderer->GetTiledSize(&width, &height);
  const double fullSeconds = this->SecondsPerRay * width * height;
  const double distance = std::sqrt(fullSeconds / volume->GetAllocatedRenderTime());
  return std::max<double>(std::min<double>(distance, this->Self->MaximumImageSampleDistance),
    this->Self->MinimumImageSampleDistance);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::Cast(
  vtkRenderer* renderer, vtkVolume* volume, const CameraRays& rays)
{
  tetralux::RayGrid grid = rays.GetGrid();
  SetMeshFromWorld(volume, grid.MeshFromWorld);

  RayLimits limits;
  rays.AddClippingRange(limits);
  const std::size_t cameraPlanes = limits.Planes.size();
  AddClippingPlanes(this->Self->ClippingPlanes, limits);
  this->Last.Clipped = limits.Planes.size() > cameraPlanes;
  limits.Cropping = this->Self->Cropping != 0;
  std::copy_n(this->Self->CroppingRegionPlanes, 6, limits.CroppingPlanes);
  limits.CroppingFlags = static_cast<std::uint32_t>(this->Self->CroppingRegionFlags);

  // Nothing opaque was drawn before, unless by a render pass, which counts elsewhere, or by another
  // renderer of which this one keeps the depths.
  std::vector<float> opaqueDistances;
  if (this->Self->IntermixIntersectingGeometry &&
    (renderer->GetNumberOfPropsRendered() > 0 || renderer->GetPass() ||
      renderer->GetPreserveDepthBuffer()))
  {
    const Stopwatch stopwatch;
    opaqueDistances = tetralux::ReadOpaqueDistances(renderer, rays);
    this->Last.DepthSeconds = stopwatch.GetSeconds();
  }
  this->Last.Opaque = !opaqueDistances.empty();
  limits.MaximumDistances = opaqueDistances.empty() ? nullptr : opaqueDistances.data();

  tetralux::RayCastOptions options;
  options.MaximumError = this->Self->MaximumError;
  options.NumberOfThreads = this->Self->NumberOfThreads;
  options.Arithmetic = this->Self->Precision == SINGLE_PRECISION ? tetralux::Precision::Single
    : this->Self->Precision == DOUBLE_PRECISION                  ? tetralux::Precision::Double
                                                                 : tetralux::Precision::Automatic;
  options.ReentryBy = this->Self->Reentry == IMAGINARY_CELLS ? tetralux::Reentry::Imaginary
                                                             : tetralux::Reentry::Boundary;
  if (this->FunctionModel == OpticalModel::Isosurfaces && volume->GetProperty()->GetShade(0))
  {
    this->Last.Shaded = options.Shaded = true;
    options.Lights = tetralux::GetRendererLights(renderer);
    options.Surface = tetralux::GetMaterial(volume->GetProperty());
  }
  options.Progress = [this](double fraction)
  { return this->Continue(vtkCommand::VolumeMapperRenderProgressEvent, fraction); };

  const Stopwatch stopwatch;
  this->Image->SetDimensions(grid.Width, grid.Height, 1);
  this->Last.Size[0] = grid.Width;
  this->Last.Size[1] = grid.Height;
  this->Last.Rays =
    this->Caster.Cast(grid, limits, options, this->GetArray("RGBA", 4), this->GetArray("Depth", 1));
  this->Image->GetPointData()->SetActiveScalars("RGBA");
  this->Last.CastSeconds = stopwatch.GetSeconds();
  this->WarnOfReentry();
  this->ErrorEstimate = this->Last.Rays.ErrorEstimate + this->FunctionError;
  if (this->Last.Rays.Aborted)
  {
    throw Abort();
  }
  this->SecondsPerRay = this->Last.CastSeconds / (static_cast<double>(grid.Width) * grid.Height);
}

//------------------------------------------------------------------------------------------------
tetralux::Span<float> vtkTetrahedraRayCastMapper::Internals::GetArray(
  const char* name, int components)
{
  vtkPointData* pointData = this->Image->GetPointData();
  const vtkIdType size = this->Image->GetNumberOfPoints();
  auto* array = vtkFloatArray::SafeDownCast(pointData->GetArray(name));
  if (!array || array->GetNumberOfTuples() != size)
  {
    vtkNew<vtkFloatArray> fresh;
    fresh->SetName(name);
    fresh->SetNumberOfComponents(components);
    fresh->SetNumberOfTuples(size);
    pointData->AddArray(fresh);
    array = fresh;
  }
  array->Modified();
  return { array->GetPointer(0), static_cast<std::size_t>(array->GetNumberOfValues()) };
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::Internals::Continue(unsigned long event, double fraction) const
{
  this->Self->InvokeEvent(event, &fraction);
  return !this->Window->CheckAbortStatus();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::WarnOfMesh()
{
  std::string warning;
  if (this->Caster.GetMesh()->GetNumberOfCells() == 0)
  {
    warning = "nothing is drawn: of the input's " + std::to_string(this->Intake.NumberOfCells) +
      " cells, none can be rendered as a volume";
  }
  if (this->Intake.GetNumberOfSkippedCells() > 0)
  {
    warning += (warning.empty() ? "" : "; ") + std::string("cells that can't be rendered: ") +
      this->Intake.DescribeSkippedCells();
  }
  if (warning != this->MeshWarning)
  {
    this->MeshWarning = warning;
    if (!warning.empty())
    {
      vtkWarningWithObjectMacro(this->Self, << warning);
    }
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::WarnOfShade(vtkVolumeProperty* property)
{
  const bool shade = (property->GetShade(0) != 0 && this->Self->BlendMode != ISOSURFACE_BLEND) ||
    (property->GetDisableGradientOpacity(0) == 0 && property->HasGradientOpacity(0));
  if (shade && !this->WarnedOfShade)
  {
    vtkWarningWithObjectMacro(
      this->Self, "Shade, but of isosurfaces, and gradient opacity of the property are not used");
  }
  this->WarnedOfShade = shade;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::WarnOfReentry()
{
  const tetralux::Convexification* convex = this->Caster.GetMesh()->GetConvexification();
  const std::string warning =
    convex && this->Self->Reentry == IMAGINARY_CELLS ? convex->Refusal : "";
  if (warning != this->ReentryWarning)
  {
    this->ReentryWarning = warning;
    if (!warning.empty())
    {
      vtkWarningWithObjectMacro(
        this->Self, "the mesh can't be made convex, rays enter it by its boundary: " << warning);
    }
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::Clear()
{
  this->Image->Initialize();
  this->ErrorEstimate = 0;
  this->Statistics = "{}";
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::ReportOnce(const std::string& error)
{
  if (error != this->LastError)
  {
    this->LastError = error;
    vtkErrorWithObjectMacro(this->Self, << error);
  }
}

//------------------------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::Internals::GetIntegrationReason()
{
  if (this->FunctionModel != OpticalModel::EmissionAbsorption)
  {
    return "exact for this optical model";
  }
  if (this->Caster.GetPlan().ConstantColor)
  {
    return "all that is visible has one colour";
  }
  if (this->CellData)
  {
    return "closed form: cells are constant";
  }
  if (this->Self->Integration == CLOSED_FORM)
  {
    return "closed form: asked for";
  }
  return this->Table.GetReason();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Internals::WriteStatistics()
{
  const Frame& last = this->Last;
  const tetralux::WalkMesh& mesh = *this->Caster.GetMesh();

  JsonObject times;
  times.Set("intake", last.IntakeSeconds);
  times.Set("mesh", last.MeshSeconds);
  times.Set("scalars", last.ScalarsSeconds);
  times.Set("transfer_function", last.FunctionSeconds);
  times.Set("table", last.TableSeconds);
  times.Set("depth_buffer", last.DepthSeconds);
  times.Set("cast", last.CastSeconds);
  times.Set("composite", last.CompositeSeconds);
  times.Set("frame", last.Seconds);

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
  input.Set("array_of", this->CellData ? "cells" : "points");

  const tetralux::RemovedCells& removed = mesh.GetRemovedCells();
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
  tables.Set("blank_tetrahedra", this->Caster.GetNumberOfBlankCells());
  tables.Set("removed_tetrahedra", removedCells);
  tables.Set("transfer_function_nodes", this->NumberOfNodes);
  tables.Set("bytes", mesh.GetTableSize());
  if (const tetralux::Convexification* convex = mesh.GetConvexification())
  {
    tables.Set("imaginary_cells", convex->GetNumberOfCells());
    tables.Set("steiner_points", convex->GetNumberOfSteinerPoints());
    tables.Set("convexification_seconds", convex->GetSeconds());
    tables.Set("convexification_refusal", convex->Refusal);
  }

  JsonObject segments;
  segments.Set("optical_model", GetModelName(this->FunctionModel));
  segments.Set("integration", last.Rays.Integration);
  const std::shared_ptr<const tetralux::PreIntegrationTable> table =
    this->TableSet ? this->Table.GetTable() : nullptr;
  segments.Set("reason", this->GetIntegrationReason());
  if (table)
  {
    segments.Set("table_scalar_size", table->Scalars.GetSize());
    segments.Set("table_length_size", table->Lengths.Size);
    segments.Set("table_length_scale",
      table->Lengths.Scale == tetralux::LengthScale::Linear ? "linear" : "logarithmic");
    segments.Set("table_scalar_axis",
      table->Settings.Axis == tetralux::ScalarAxis::Uniform ? "uniform" : "nodes");
    segments.Set("table_format", GetFormatName(table->Settings.Format));
    segments.Set("table_bytes", static_cast<std::int64_t>(table->GetNumberOfBytes()));
    segments.Set("table_is_coarse", this->Table.IsCoarse());
  }

  JsonObject rays;
  rays.Set("width", last.Size[0]);
  rays.Set("height", last.Size[1]);
  rays.Set("sample_distance", last.SampleDistance);
  rays.Set("rays", last.Rays.Rays);
  rays.Set("segments", last.Rays.Segments);
  rays.Set("paths", last.Rays.Paths);
  rays.Set("reentry", last.Rays.ImaginaryCells ? "imaginary cells" : "boundary hierarchy");
  rays.Set("transparent_tetrahedra_left_out", last.Rays.TransparentCells);
  rays.Set("lane_use", last.Rays.LaneUse);
  rays.Set("precision", last.Rays.DoublePrecision ? "double" : "single");
  rays.Set("instruction_set", last.Rays.InstructionSet);
  rays.Set("threads", last.Rays.NumberOfThreads);
  rays.Set("aborted", last.Rays.Aborted);

  JsonObject error;
  error.Set("maximum", this->Self->MaximumError);
  error.Set("estimate", this->ErrorEstimate);
  error.Set("early_termination", last.Rays.TerminationError);
  error.Set("integrals", last.Rays.IntegralError);
  error.Set("summation", last.Rays.SummationError);
  error.Set("table", last.Rays.TableError);
  error.Set("geometry", last.Rays.GeometryError);
  error.Set("transfer_function", this->FunctionError);

  JsonObject leftOut;
  const auto leaveOut = [&leftOut](bool leftOutHere, const char* feature, const char* reason)
  {
    if (leftOutHere)
    {
      leftOut.Set(feature, reason);
    }
  };
  const tetralux::IntegrationPlan& plan = this->Caster.GetPlan();
  leaveOut(!last.Clipped, "clipping planes", "there are none");
  leaveOut(!this->Self->Cropping, "cropping", "it is off");
  leaveOut(!last.Opaque, "opaque geometry", "nothing opaque was drawn before");
  leaveOut(!last.Rays.DoublePrecision, "double precision", "single precision is right enough");
  leaveOut(this->FunctionError == 0, "subdivided transfer function", "it is piecewise linear");
  leaveOut(this->CellData, "scalars varying in cells", "the array is of cells");
  leaveOut(!this->CellData, "constant cells", "the array is of points");
  leaveOut(last.Rays.Integration == "optical depth", "colours along rays",
    this->FunctionModel == OpticalModel::AbsorptionOnly ? "absorption has none"
                                                        : "all that is visible has one colour");
  leaveOut(!table, "table", plan.ConstantColor ? "one colour needs none" : "see segments");
  leaveOut(last.Rays.TransparentCells > 0, "transparent tetrahedra", "nothing of them is seen");
  leaveOut(!last.Rays.ImaginaryCells, "imaginary cells", "rays enter by the boundary");
  leaveOut(!(this->FunctionModel == OpticalModel::Isosurfaces && last.Shaded), "shading",
    this->FunctionModel == OpticalModel::Isosurfaces ? "Shade is off" : "of isosurfaces only");

  JsonObject statistics;
  statistics.Set("method", "ray-cast");
  statistics.Set("rebuilt", last.Rebuilt);
  statistics.Set("seconds", times);
  statistics.Set("input", input);
  statistics.Set("tables", tables);
  statistics.Set("segments", segments);
  statistics.Set("rays", rays);
  statistics.Set("error", error);
  statistics.Set("left_out", leftOut);
  this->Statistics = statistics.ToString();
}

//------------------------------------------------------------------------------------------------
vtkStandardNewMacro(vtkTetrahedraRayCastMapper);

//------------------------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::vtkTetrahedraRayCastMapper()
  : Private(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::~vtkTetrahedraRayCastMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  if (renderer->GetSelector())
  {
    return;
  }
  const Stopwatch stopwatch;
  this->InvokeEvent(vtkCommand::VolumeMapperRenderStartEvent);
  std::string error;
  try
  {
    this->GetInputAlgorithm()->Update();
    this->Private->DrawFrame(renderer, volume);
    this->Private->WriteStatistics();
    this->Private->LastError.clear();
  }
  catch (const Abort&)
  {
    if (this->Private->Caster.GetMesh())
    {
      this->Private->WriteStatistics();
    }
  }
  catch (const std::bad_alloc&)
  {
    error = "there is not enough memory";
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  if (!error.empty())
  {
    this->Private->Clear();
    this->Private->ReportOnce(error);
  }
  this->TimeToDraw = stopwatch.GetSeconds();
  this->InvokeEvent(vtkCommand::VolumeMapperRenderEndEvent);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Private->Compositor.ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetInputData(vtkUnstructuredGridBase* input)
{
  this->SetInputDataInternal(0, input);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetInputData(vtkDataSet* input)
{
  this->SetInputDataInternal(0, input);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetInputData(vtkDataObject* input)
{
  this->SetInputDataInternal(0, input);
}

//------------------------------------------------------------------------------------------------
int vtkTetrahedraRayCastMapper::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------------------------
double* vtkTetrahedraRayCastMapper::GetBounds()
{
  vtkBoundingBox box;
  if (this->GetDataObjectInput())
  {
    this->Update();
    for (const auto& block : tetralux::CollectDataSets(this->GetDataObjectInput()))
    {
      box.AddBounds(block.DataSet->GetBounds());
    }
  }
  if (box.IsValid())
  {
    box.GetBounds(this->Bounds);
  }
  else
  {
    vtkMath::UninitializeBounds(this->Bounds);
  }
  return this->Bounds;
}

//------------------------------------------------------------------------------------------------
vtkImageData* vtkTetrahedraRayCastMapper::GetOutputImage() { return this->Private->Image; }

//------------------------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::GetStatistics() { return this->Private->Statistics; }

//------------------------------------------------------------------------------------------------
double vtkTetrahedraRayCastMapper::GetErrorEstimate() { return this->Private->ErrorEstimate; }

//------------------------------------------------------------------------------------------------
vtkIdType vtkTetrahedraRayCastMapper::GetNumberOfSkippedCells()
{
  return this->Private->Intake.GetNumberOfSkippedCells();
}

//------------------------------------------------------------------------------------------------
vtkIdType vtkTetrahedraRayCastMapper::GetNumberOfRemovedCells()
{
  const tetralux::WalkMesh* mesh = this->Private->Caster.GetMesh();
  return mesh ? mesh->GetRemovedCells().Total() : 0;
}

//------------------------------------------------------------------------------------------------
vtkIdType vtkTetrahedraRayCastMapper::GetNumberOfBlankCells()
{
  return this->Private->Caster.GetNumberOfBlankCells();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const double* planes = this->CroppingRegionPlanes;
  os << indent << "MaximumError: " << this->MaximumError << "\n"
     << indent << "BlendMode: " << this->BlendMode << "\n"
     << indent << "Integration: " << this->Integration << "\n"
     << indent << "TableScalarSize: " << this->TableScalarSize << "\n"
     << indent << "TableLengthSize: " << this->TableLengthSize << "\n"
     << indent << "TableLengthScale: " << this->TableLengthScale << "\n"
     << indent << "TableScalarAxis: " << this->TableScalarAxis << "\n"
     << indent << "TableFormat: " << this->TableFormat << "\n"
     << indent << "TableMaximumBytes: " << this->TableMaximumBytes << "\n"
     << indent << "Reentry: " << this->Reentry << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n"
     << indent << "Precision: " << GetPrecisionName(this->Precision) << "\n"
     << indent << "VectorMode: " << this->VectorMode << "\n"
     << indent << "VectorComponent: " << this->VectorComponent << "\n"
     << indent << "ImageSampleDistance: " << this->ImageSampleDistance << "\n"
     << indent << "MinimumImageSampleDistance: " << this->MinimumImageSampleDistance << "\n"
     << indent << "MaximumImageSampleDistance: " << this->MaximumImageSampleDistance << "\n"
     << indent << "AutoAdjustSampleDistances: " << this->AutoAdjustSampleDistances << "\n"
     << indent << "IntermixIntersectingGeometry: " << this->IntermixIntersectingGeometry << "\n"
     << indent << "Cropping: " << this->Cropping << "\n"
     << indent << "CroppingRegionPlanes: " << planes[0] << ", " << planes[1] << ", " << planes[2]
     << ", " << planes[3] << ", " << planes[4] << ", " << planes[5] << "\n"
     << indent << "CroppingRegionFlags: " << this->CroppingRegionFlags << "\n"
     << indent << "Statistics: " << this->Private->Statistics << "\n";
}
