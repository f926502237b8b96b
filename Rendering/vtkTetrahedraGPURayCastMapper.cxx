// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraGPURayCastMapper.h"

#include "Base/Cached.h"
#include "Base/Stopwatch.h"
#include "Frame/CameraRays.h"
#include "Frame/ImageCompositor.h"
#include "Frame/MapperFrame.h"
#include "Frame/PictureDrawing.h"
#include "GpuIntegral/GpuLighting.h"
#include "GpuIntegral/GpuSegmentIntegral.h"
#include "GpuIntegral/ShaderError.h"
#include "GpuRayCast/GpuRayCaster.h"
#include "GpuRayCast/GpuRayLimits.h"
#include "GpuRayCast/PixelProjection.h"
#include "GpuRayCast/WalkTextures.h"
#include "Intake/DataSetBlocks.h"
#include "Integral/SegmentWeightError.h"
#include "OpenGL/ContextResources.h"
#include "OpenGL/EnteredContext.h"
#include "OpenGL/GraphicsCard.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"
#include "Scene/IntegratorChoice.h"
#include "Scene/VolumeScene.h"
#include "View/MeshToWorld.h"
#include "Walk/CellOrientation.h"

#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

using tetralux::CameraRays;
using tetralux::GpuReentry;
using tetralux::Integrator;
using tetralux::Json;
using tetralux::MapperFrame;
using tetralux::PixelRectangle;

namespace
{

/// Cells that a ray goes through, of a mesh of n of them: about this times the cube root of n.
constexpr double PathOfCubeRoot = 3;

} // namespace

//------------------------------------------------------------------------------------------------
class vtkTetrahedraGPURayCastMapper::Internals
{
public:
  explicit Internals(vtkTetrahedraGPURayCastMapper* self)
    : Self(self)
    , Context(
        [this](vtkOpenGLRenderWindow* window)
        {
          this->Mesh.ReleaseGraphicsResources(window);
          this->Integral.ReleaseGraphicsResources(window);
          this->Limits.ReleaseGraphicsResources(window);
          this->Caster.ReleaseGraphicsResources(window);
          this->Compositor.ReleaseGraphicsResources(window);
        })
  {
  }

  void DrawFrame(MapperFrame& frame);

  void ReleaseGraphicsResources(vtkWindow* window)
  {
    this->Context.Release(window);
    this->Drawing.ReleaseGraphicsResources(window);
  }

private:
  /// The rays of a picture, and what ends them.
  struct View
  {
    tetralux::RayGrid Grid;
    tetralux::RayLimits Limits;
    const tetralux::GpuRayLimits::OpaqueGeometry* Opaque; ///< nullptr: none
    double SampleDistance;                                ///< pixels from ray to ray
  };

  void DrawIntoWindow(MapperFrame& frame, const CameraRays& rays);
  PixelRectangle MakePicture(MapperFrame& frame, const tetralux::PictureTask& task);
  void Cast(MapperFrame& frame, const View& view);
  const tetralux::WalkTables* ChooseTables(MapperFrame& frame, GpuReentry& reentry);
  void UpdateOrientation(const tetralux::VolumeScene& scene);
  void Upload(MapperFrame& frame, const tetralux::RayGrid& grid, const tetralux::WalkTables& tables,
    GpuReentry reentry);
  void Read(tetralux::Span<float> colors, tetralux::Span<float> depths);
  void Composite(MapperFrame& frame, const CameraRays& rays);
  void Describe(const tetralux::GpuRayCastStatistics& statistics,
    const tetralux::GpuRayCastOptions& options, const View& view, MapperFrame& frame);

  vtkTetrahedraGPURayCastMapper* Self;
  tetralux::WalkTextures Mesh;
  tetralux::GpuSegmentIntegral Integral;
  tetralux::GpuRayLimits Limits;
  tetralux::GpuLighting Lighting;
  tetralux::GpuRayCaster Caster;
  tetralux::ImageCompositor Compositor;
  tetralux::PictureDrawing Drawing;

  tetralux::Cached<std::vector<std::uint8_t>> Positive; ///< orientation of the mesh's cells
  tetralux::CacheStamp Last;                            ///< of the picture that Caster has
  tetralux::ContextResources Context;
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::DrawFrame(MapperFrame& frame)
{
  frame.Method = "gpu-ray-cast";
  if (frame.Scene->Mesh.GetMesh()->GetNumberOfCells() == 0)
  {
    frame.MakeEmptyPicture(CameraRays(frame.Renderer, 1));
    this->Last.Reset();
    return;
  }
  this->Context.Set(frame.Window);
  const bool isInMemory = this->Drawing.Draw(
    frame, this->Self->GetRayDistances(),
    [this](MapperFrame& drawn, const tetralux::PictureTask& task)
    { return this->MakePicture(drawn, task); },
    [this](MapperFrame& drawn, const CameraRays& rays) { this->DrawIntoWindow(drawn, rays); });
  if (isInMemory)
  {
    this->Last.Reset();
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::DrawIntoWindow(
  MapperFrame& frame, const CameraRays& rays)
{
  View view = { frame.MakeGrid(rays), frame.MakeLimits(rays), nullptr, 1 };
  frame.Opaque = frame.HasOpaqueGeometry();
  frame.AddViewToKey(rays, view.Grid, view.Limits);
  frame.Key.Add(frame.Opaque);
  if (frame.HasPicture && this->Last.Has(frame.Key) &&
    (!frame.Opaque || this->Limits.HasDepthOf(frame.Window, rays.GetVisible())))
  {
    frame.Kept = true;
    frame.ReportProgress(1); // too late to abort
    this->Composite(frame, rays);
    return;
  }
  const tetralux::GpuRayLimits::OpaqueGeometry opaque = { rays.GetDepthPlaces(), rays.GetVisible(),
    {} };
  view.Opaque = frame.Opaque ? &opaque : nullptr;
  this->Cast(frame, view);
  if (!frame.Aborted)
  {
    frame.ReportProgress(1); // too late to abort
    this->Composite(frame, rays);
    this->Last.Set(frame.Key);
    frame.ReadPicture = [this](vtkImageData* image)
    {
      const tetralux::EnteredContext context(this->Context.Get());
      const tetralux::RayPicture& picture = this->Caster.GetPicture();
      tetralux::Span<float> colors, depths;
      MapperFrame::PrepareImage(image, picture.GetWidth(), picture.GetHeight(), colors, depths);
      this->Read(colors, depths);
    };
  }
}

//------------------------------------------------------------------------------------------------
PixelRectangle vtkTetrahedraGPURayCastMapper::Internals::MakePicture(
  MapperFrame& frame, const tetralux::PictureTask& task)
{
  View view = { task.Grid, task.Limits, nullptr, task.SampleDistance };
  tetralux::GpuRayLimits::OpaqueGeometry opaque;
  if (task.OpaqueDepths)
  {
    opaque = { task.Places, {}, *task.OpaqueDepths };
    view.Opaque = &opaque;
  }
  this->Cast(frame, view);
  if (frame.Aborted)
  {
    return {};
  }
  this->Read(task.Colors, task.Depths);
  return FindCovered(task);
}

//------------------------------------------------------------------------------------------------
// Into the picture of Caster.
void vtkTetrahedraGPURayCastMapper::Internals::Cast(MapperFrame& frame, const View& view)
{
  tetralux::VolumeScene& scene = *frame.Scene;
  const tetralux::RayGrid& grid = view.Grid;
  this->Last.Reset();
  const double worldRadius =
    scene.Mesh.GetMesh()->GetRadius() * tetralux::MeasureMeshToWorld(grid.MeshFromWorld).Largest;
  tetralux::VolumeScene::CheckWorldRadius(worldRadius);
  const double geometryError =
    scene.EstimateGeometryError(worldRadius, tetralux::RayShaderRounding);

  const tetralux::Stopwatch uploadStopwatch;
  GpuReentry reentry = GpuReentry::Boundary;
  const tetralux::WalkTables* tables = this->ChooseTables(frame, reentry);
  if (!tables)
  {
    frame.Aborted = true;
    return;
  }
  this->Upload(frame, grid, *tables, reentry);
  frame.Seconds.emplace_back("upload", uploadStopwatch.GetSeconds());

  const tetralux::Stopwatch castStopwatch;
  this->Limits.Update(frame.Window, grid, view.Limits, view.Opaque,
    scene.Mesh.GetMesh()->GetCenter(), scene.Mesh.GetMesh()->GetRadius());
  const Integrator integrator = this->Integral.GetIntegrator();
  frame.Budget = tetralux::MakeErrorBudget(frame.MaximumError,
    { EndsEarly(integrator), IsTabulated(integrator), false, scene.Optics.GetFunctionError() > 0,
      integrator == Integrator::VaryingLight });
  frame.Budget.CoverGeometry(geometryError);
  tetralux::GpuRayCastOptions options;
  options.Reentry = reentry;
  options.Oriented = reentry != GpuReentry::Boundary || !this->Positive.Get().empty();
  const tetralux::PixelProjection projection(
    grid, scene.Mesh.GetMesh()->GetCenter(), scene.Mesh.GetMesh()->GetRadius());
  if (this->Self->Reentry == BOUNDARY_LAYERS_REENTRY && projection.Regular && options.Oriented)
  {
    options.Layers = &projection;
  }
  options.NumberOfCells = scene.Mesh.GetMesh()->GetNumberOfCells();
  options.NumberOfAllCells = static_cast<std::int64_t>(tables->Faces.size() / 4);
  options.CellData = scene.Mesh.HasCellScalars();
  options.LargestScalar = integrator == Integrator::Maximum;
  const double brightness = IsLit(integrator)
    ? tetralux::FindLargestBrightness(frame.Lights, frame.Surface, grid.MeshFromWorld,
        scene.Mesh.GetMesh()->GetCenter(), scene.Mesh.GetMesh()->GetRadius(),
        tetralux::MeasureMeshToWorld(grid.MeshFromWorld).Smallest)
    : 1;
  frame.Brightness = brightness;
  options.MaximumOpacity =
    EndsEarly(integrator) ? static_cast<float>(1 - frame.Budget.Termination / brightness) : 2.f;
  if (frame.Shaded)
  {
    this->Lighting.Update(frame.Lights, frame.Surface,
      tetralux::FindLightSteps(frame.Lights, frame.Surface, frame.Budget.Light), grid,
      scene.Mesh.GetMesh()->GetCenter(), scene.Mesh.GetMesh()->GetRadius());
    options.Lighting = &this->Lighting;
    options.SmoothGradients = frame.Settings.SmoothShading;
  }
  options.StepsPerPass = this->Self->StepsPerPass;
  options.MaximumBytes = this->Self->RayMaximumBytes;
  options.CountFragments = this->Self->CountFragments != 0;
  options.Continue = [&frame](double share) { return frame.ReportProgress(share); };
  const tetralux::GpuRayCastStatistics statistics = this->Caster.Cast(
    frame.Window, grid.Width, grid.Height, this->Limits, this->Mesh, this->Integral, options);
  frame.Aborted = statistics.Aborted;
  frame.Integration = integrator;
  frame.RaySeconds = castStopwatch.GetSeconds();
  frame.Seconds.emplace_back("cast", frame.RaySeconds);

  // A sum is rounded once for each segment.
  const double segments =
    PathOfCubeRoot * std::cbrt(static_cast<double>(scene.Mesh.GetMesh()->GetNumberOfCells()));
  frame.Errors = { { "early_termination", frame.Budget.Termination },
    { "integrals", HasWeights(integrator) ? tetralux::SegmentWeightError : 0 },
    { "summation",
      segments * scene.EstimateLargestChannel(worldRadius) * std::numeric_limits<float>::epsilon() /
        2 },
    { "table", IsTabulated(integrator) ? scene.Optics.GetTableError() : 0 },
    { "geometry", geometryError } };
  frame.ReportOmission(
    tables == scene.GetVisibleTables(), "transparent tetrahedra", "nothing of them is seen");
  frame.ReportOmission(reentry != GpuReentry::Imaginary, "imaginary cells",
    reentry == GpuReentry::None ? "rays do not enter again" : "rays enter by the boundary");
  this->Describe(statistics, options, view, frame);
  this->Self->WarnOfReentry(*scene.Mesh.GetMesh());
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::Describe(
  const tetralux::GpuRayCastStatistics& statistics, const tetralux::GpuRayCastOptions& options,
  const View& view, MapperFrame& frame)
{
  const tetralux::RayPicture& picture = this->Caster.GetPicture();
  const std::int64_t pixels = static_cast<std::int64_t>(picture.GetWidth()) * picture.GetHeight();
  Json rays;
  rays["width"] = picture.GetWidth();
  rays["height"] = picture.GetHeight();
  rays["sample_distance"] = view.SampleDistance;
  rays["rays"] = pixels;
  rays["bands"] = statistics.Bands;
  rays["rows_per_band"] = picture.GetRowsOfBand();
  rays["passes"] = statistics.Passes;
  rays["steps_per_pass"] = this->Self->StepsPerPass;
  rays["fragments_per_pass"] = statistics.Fragments;
  if (this->Self->CountFragments)
  {
    rays["segments"] = statistics.Steps;
  }
  const char* boundary = options.Layers ? "boundary layers" : "boundary hierarchy";
  rays["first_entry"] = boundary;
  rays["reentry"] = options.Reentry == GpuReentry::Imaginary ? "imaginary cells"
    : options.Reentry == GpuReentry::Boundary                ? boundary
                                                             : "none";
  rays["shader_variant"] = statistics.Variant;
  frame.Sections.emplace_back("rays", rays);

  const tetralux::GraphicsCard card = tetralux::DescribeGraphicsCard(frame.Window);
  Json graphics;
  graphics["renderer"] = card.Renderer;
  graphics["software"] = card.Software;
  graphics["mesh_bytes"] = this->Mesh.GetNumberOfBytes();
  graphics["tetrahedra_and_points_bytes"] = this->Mesh.GetNumberOfCellAndPointBytes();
  graphics["uploaded_bytes"] = this->Mesh.GetUploadedBytes();
  graphics["integral_bytes"] = this->Integral.GetNumberOfBytes();
  const std::size_t bytes = this->Caster.GetNumberOfBytes() + this->Limits.GetNumberOfBytes();
  graphics["picture_bytes"] = bytes;
  graphics["picture_bytes_per_pixel"] = static_cast<double>(bytes) / static_cast<double>(pixels);
  frame.Sections.emplace_back("graphics_card", graphics);
  frame.Memory.emplace_back("cell_orientation", this->Positive.Get().capacity());
  frame.Memory.emplace_back("card_mesh", this->Mesh.GetNumberOfBytes());
  frame.Memory.emplace_back("card_integral", this->Integral.GetNumberOfBytes());
  frame.Memory.emplace_back("card_rays", bytes);
}

//------------------------------------------------------------------------------------------------
const tetralux::WalkTables* vtkTetrahedraGPURayCastMapper::Internals::ChooseTables(
  MapperFrame& frame, GpuReentry& reentry)
{
  tetralux::VolumeScene& scene = *frame.Scene;
  tetralux::WalkMesh* mesh = scene.Mesh.GetMesh();
  reentry = this->Self->Reentry == NO_REENTRY ? GpuReentry::None : GpuReentry::Boundary;
  if (this->Self->Reentry == IMAGINARY_CELLS_REENTRY)
  {
    mesh->MakeConvex([&frame](double fraction) { return frame.ReportProgress(fraction); });
    if (!mesh->GetConvexification())
    {
      return nullptr;
    }
    if (!mesh->GetConvexTables().Faces.empty())
    {
      reentry = GpuReentry::Imaginary;
      return &mesh->GetConvexTables();
    }
    reentry = mesh->GetConvexification()->Convex ? GpuReentry::None : GpuReentry::Boundary;
  }
  const tetralux::WalkTables* visible = nullptr;
  if (reentry != GpuReentry::None)
  {
    tetralux::SceneNeeds needs;
    needs.VisibleTables = true;
    scene.Prepare(needs);
    visible = scene.GetVisibleTables();
  }
  if (!visible && this->Self->Reentry == AUTOMATIC_REENTRY && mesh->IsConvex())
  {
    reentry = GpuReentry::None;
  }
  return visible ? visible : &mesh->GetTables();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::UpdateOrientation(const tetralux::VolumeScene& scene)
{
  const tetralux::WalkMesh& mesh = *scene.Mesh.GetMesh();
  this->Positive.Update(tetralux::CacheKey::Of(scene.Mesh.GetPointsVersion()),
    [&mesh]
    {
      return tetralux::OrientCells(
        mesh.GetMesh().Points, mesh.GetMesh().Cells, mesh.GetTables().Faces);
    });
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::Upload(MapperFrame& frame,
  const tetralux::RayGrid& grid, const tetralux::WalkTables& tables, GpuReentry reentry)
{
  tetralux::VolumeScene& scene = *frame.Scene;
  tetralux::SceneNeeds needs;
  needs.SinglePoints = true;
  needs.LongestEdge = true;
  needs.PointGradients = frame.Shaded && frame.Settings.SmoothShading;
  scene.Prepare(needs);
  this->Mesh.ResetUploadedBytes();
  const bool directed = reentry == GpuReentry::Boundary;
  if (directed)
  {
    this->UpdateOrientation(scene);
  }
  const tetralux::WalkPoint<float>* points = scene.GetPoints<float>();
  const std::size_t numberOfPoints = scene.Mesh.GetMesh()->GetNumberOfTablePoints();
  const std::uint64_t pointsVersion = scene.Mesh.GetPointsVersion();
  const tetralux::CacheKey facesKey = tetralux::CacheKey::Of(scene.Mesh.GetCellsVersion(),
    &tables == scene.GetVisibleTables() ? scene.GetVisibleTablesVersion() : 0,
    // Imaginary cells follow from the points.
    reentry == GpuReentry::Imaginary ? pointsVersion : 0);
  if (!this->Mesh.HasFaces(frame.Window, facesKey))
  {
    std::string obstacle =
      tetralux::RayTargets::FindObstacle(static_cast<std::int64_t>(tables.Faces.size() / 4));
    if (obstacle.empty())
    {
      obstacle = tetralux::WalkTextures::FindObstacle(frame.Window, tables, numberOfPoints);
    }
    if (!obstacle.empty())
    {
      throw std::runtime_error(obstacle);
    }
    this->Mesh.UpdateFaces(frame.Window, tables, facesKey);
  }
  tetralux::CacheKey boundaryKey = facesKey;
  boundaryKey.Add(pointsVersion);
  boundaryKey.Add(directed);
  this->Mesh.UpdateBoundary(frame.Window, tables,
    directed ? tetralux::Span<const std::uint8_t>(this->Positive.Get())
             : tetralux::Span<const std::uint8_t>(),
    boundaryKey);
  this->Mesh.UpdatePoints(frame.Window, { points, numberOfPoints },
    tetralux::CacheKey::Of(scene.GetPointsVersion(), numberOfPoints));

  if (needs.PointGradients)
  {
    this->Mesh.UpdateGradients(frame.Window, scene.Mesh.GetPointGradients(),
      tetralux::CacheKey::Of(pointsVersion, scene.Mesh.GetScalarsVersion(), numberOfPoints));
  }

  tetralux::SegmentSource source = tetralux::MakeSegmentSource(scene, frame.GetLighting());
  source.LongestSegment = scene.Mesh.GetLongestEdge() *
    tetralux::MeasureMeshToWorld(grid.MeshFromWorld).Largest; // no segment is longer
  this->Integral.Update(frame.Window, source);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::Read(
  tetralux::Span<float> colors, tetralux::Span<float> depths)
{
  tetralux::RayPicture& picture = this->Caster.GetPicture();
  picture.Read(tetralux::RayPicture::Colors, colors);
  picture.Read(tetralux::RayPicture::Distances, depths);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::Composite(MapperFrame& frame, const CameraRays& rays)
{
  const tetralux::Stopwatch stopwatch;
  const tetralux::WalkMesh& mesh = *frame.Scene->Mesh.GetMesh();
  const PixelRectangle covered =
    rays.FindCovered(frame.Volume->GetMatrix()->GetData(), mesh.GetCenter(), mesh.GetHalfSize());
  tetralux::RayPicture& picture = this->Caster.GetPicture();
  for (int band = 0; band < picture.GetNumberOfBands(); ++band)
  {
    PixelRectangle rectangle = rays.GetVisible();
    const int firstRow = picture.GetFirstRow(band);
    rectangle.Y += firstRow;
    rectangle.Height = picture.GetBand(band).GetSettings().Height;
    PixelRectangle part = covered;
    part.Y = std::max(covered.Y - firstRow, 0);
    part.Height = std::min(covered.Y + covered.Height - firstRow, rectangle.Height) - part.Y;
    if (part.Width > 0 && part.Height > 0)
    {
      this->Compositor.Composite(frame.Window, rectangle,
        picture.GetBand(band).GetTexture(tetralux::RayPicture::Colors), part);
    }
  }
  frame.Seconds.emplace_back("composite", stopwatch.GetSeconds());
}

//------------------------------------------------------------------------------------------------
vtkStandardNewMacro(vtkTetrahedraGPURayCastMapper);

//------------------------------------------------------------------------------------------------
vtkTetrahedraGPURayCastMapper::vtkTetrahedraGPURayCastMapper()
  : Private(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraGPURayCastMapper::~vtkTetrahedraGPURayCastMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::DrawFrame(MapperFrame& frame)
{
  this->Private->DrawFrame(frame);
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraGPURayCastMapper::IsSupported(vtkRenderWindow* window)
{
  if (!this->Superclass::IsSupported(window))
  {
    return false;
  }
  // Without making its tetrahedra: a hexahedron becomes five or six of them.
  constexpr std::int64_t TetrahedraOfCell = 6;
  std::int64_t cells = 0;
  std::int64_t points = 0;
  for (const auto& block : tetralux::CollectDataSets(this->GetDataObjectInput()))
  {
    cells += TetrahedraOfCell * block.DataSet->GetNumberOfCells();
    points += block.DataSet->GetNumberOfPoints();
  }
  auto* openGL = vtkOpenGLRenderWindow::SafeDownCast(window);
  const tetralux::EnteredContext context(openGL);
  const tetralux::GraphicsCard card = tetralux::DescribeGraphicsCard(openGL);
  std::string obstacle = tetralux::RayTargets::FindObstacle(cells);
  if (obstacle.empty())
  {
    obstacle =
      tetralux::FindObstacle({ { "faces", 4 * cells, 8 }, { "points", points, 16 } }, card.Limits);
  }
  if (!obstacle.empty())
  {
    this->SetSupportReason(card.Renderer + ": there may be no room, " + obstacle);
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraGPURayCastMapper::IsAccelerated(vtkRenderWindow* window)
{
  if (!this->IsSupported(window))
  {
    return false;
  }
  auto* openGL = vtkOpenGLRenderWindow::SafeDownCast(window);
  const tetralux::EnteredContext context(openGL);
  const tetralux::GraphicsCard card = tetralux::DescribeGraphicsCard(openGL);
  if (card.Software)
  {
    this->SetSupportReason(
      card.Renderer + " runs on the processor, where rays are cast faster without OpenGL");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::ReleaseResources(vtkWindow* window)
{
  this->Private->ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
tetraluxSetNumberMacro(vtkTetrahedraGPURayCastMapper, StepsPerPass, int);
tetraluxSetNumberMacro(vtkTetrahedraGPURayCastMapper, RayMaximumBytes, vtkIdType);

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintProperties(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("StepsPerPass", this->StepsPerPass);
  printer.Print("RayMaximumBytes", this->RayMaximumBytes);
  printer.Print("CountFragments", this->CountFragments);
}
