// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraGPURayCastMapper.h"

#include "Base/Stopwatch.h"
#include "Frame/CameraRays.h"
#include "Frame/ImageCompositor.h"
#include "Frame/MapperFrame.h"
#include "GpuIntegral/GpuLighting.h"
#include "GpuIntegral/GpuSegmentIntegral.h"
#include "GpuIntegral/ShaderError.h"
#include "GpuRayCast/GpuRayCaster.h"
#include "GpuRayCast/GpuRayLimits.h"
#include "GpuRayCast/PixelProjection.h"
#include "GpuRayCast/WalkTextures.h"
#include "OpenGL/GraphicsCard.h"
#include "Report/JsonObject.h"
#include "Report/OnceWarning.h"
#include "Scene/VolumeScene.h"
#include "Walk/CellOrientation.h"

#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

using tetralux::CameraRays;
using tetralux::GpuReentry;
using tetralux::JsonObject;
using tetralux::MapperFrame;

namespace
{

/// Error of a segment's weights in single precision, see GpuSegmentIntegral.h.
constexpr double IntegralError = 5e-7;

/// Cells that a ray goes through, of a mesh of n of them: about this times the cube root of n.
constexpr double PathOfCubeRoot = 3;

} // namespace

//------------------------------------------------------------------------------------------------
class vtkTetrahedraGPURayCastMapper::Internals
{
public:
  explicit Internals(vtkTetrahedraGPURayCastMapper* self)
    : Self(self)
  {
  }

  void DrawFrame(MapperFrame& frame);

  bool IsSupported(vtkRenderWindow* window);

  void ReleaseGraphicsResources(vtkWindow* window);

  std::string SupportReason;

private:
  const tetralux::WalkTables* ChooseTables(MapperFrame& frame, GpuReentry& reentry);
  void UpdateOrientation(const tetralux::VolumeScene& scene);
  void Upload(MapperFrame& frame, const tetralux::RayGrid& grid, const tetralux::WalkTables& tables,
    GpuReentry reentry);
  void Read(vtkImageData* image);
  void Describe(const tetralux::GpuRayCastStatistics& statistics,
    const tetralux::GpuRayCastOptions& options, MapperFrame& frame);
  void WarnOfReentry(const tetralux::WalkMesh& mesh);

  vtkTetrahedraGPURayCastMapper* Self;
  vtkWeakPointer<vtkOpenGLRenderWindow> Window; ///< that has the resources
  tetralux::WalkTextures Mesh;
  tetralux::GpuSegmentIntegral Integral;
  tetralux::GpuRayLimits Limits;
  tetralux::GpuLighting Lighting;
  tetralux::GpuRayCaster Caster;
  tetralux::ImageCompositor Compositor;

  std::vector<std::uint8_t> Positive; ///< orientation of the cells of the scene's mesh
  std::uint64_t PositiveVersion = 0;  ///< the mesh's
  tetralux::OnceWarning ReentryWarning;
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::DrawFrame(MapperFrame& frame)
{
  frame.Method = "gpu-ray-cast";
  const CameraRays rays(frame.Renderer, 1);
  tetralux::VolumeScene& scene = *frame.Scene;
  if (rays.GetVisible().Width == 0 || scene.GetMesh()->GetNumberOfCells() == 0)
  {
    frame.Image->Initialize(); // a tile that shows nothing of the viewport
    return;
  }
  const tetralux::RayGrid grid = frame.MakeGrid(rays);
  const tetralux::RayLimits limits = frame.MakeLimits(rays);
  const double geometryError =
    scene.EstimateGeometryError(scene.GetWorldRadius(grid), tetralux::RayShaderRounding);
  if (!std::isfinite(geometryError))
  {
    throw std::invalid_argument(
      "the mesh is too small or too large, in world units, for the single "
      "precision of a graphics card");
  }

  if (this->Window && this->Window != frame.Window)
  {
    this->ReleaseGraphicsResources(this->Window);
    frame.Window->MakeCurrent(); // releasing may have made the other one current
  }
  this->Window = frame.Window;

  const tetralux::Stopwatch uploadStopwatch;
  GpuReentry reentry = GpuReentry::Boundary;
  const tetralux::WalkTables* tables = this->ChooseTables(frame, reentry);
  if (!tables)
  {
    frame.Aborted = true;
    frame.Image->Initialize();
    return;
  }
  this->Upload(frame, grid, *tables, reentry);
  frame.Seconds.emplace_back("upload", uploadStopwatch.GetSeconds());

  const tetralux::Stopwatch castStopwatch;
  frame.Opaque = frame.MayHaveOpaqueGeometry();
  this->Limits.Update(frame.Window, rays, grid, limits, frame.Opaque, scene.GetMesh()->GetCenter(),
    scene.GetMesh()->GetRadius());
  const tetralux::OpticalModel model = scene.GetOpticalModel();
  const bool endsEarly = model != tetralux::OpticalModel::EmissionOnly &&
    model != tetralux::OpticalModel::MaximumIntensity;
  const double terminationError = endsEarly ? 0.5 * this->Self->MaximumError : 0;
  tetralux::GpuRayCastOptions options;
  options.Reentry = reentry;
  const tetralux::PixelProjection projection(
    grid, scene.GetMesh()->GetCenter(), scene.GetMesh()->GetRadius());
  if (this->Self->Reentry == BOUNDARY_LAYERS && projection.Regular)
  {
    options.Layers = &projection;
  }
  options.NumberOfCells = scene.GetMesh()->GetNumberOfCells();
  options.CellData = scene.HasCellScalars();
  options.LargestScalar = model == tetralux::OpticalModel::MaximumIntensity;
  const double brightness = frame.Shaded && model == tetralux::OpticalModel::EmissionAbsorption
    ? tetralux::FindLargestBrightness(frame.Lights, frame.Surface)
    : 1;
  options.MaximumOpacity = endsEarly ? static_cast<float>(1 - terminationError / brightness) : 2.f;
  if (frame.Shaded)
  {
    this->Lighting.Update(frame.Lights, frame.Surface, grid, scene.GetMesh()->GetCenter(),
      scene.GetMesh()->GetRadius());
    options.Lighting = &this->Lighting;
    options.SmoothGradients = this->Self->SmoothShading != 0;
  }
  options.StepsPerPass = this->Self->StepsPerPass;
  options.CountFragments = this->Self->CountFragments != 0;
  options.Continue = [&frame](double share) { return frame.Continue(share); };
  const tetralux::GpuRayCastStatistics statistics = this->Caster.Cast(
    frame.Window, grid.Width, grid.Height, this->Limits, this->Mesh, this->Integral, options);
  frame.Aborted = statistics.Aborted;
  frame.Integration = this->Integral.GetName();
  if (frame.Aborted)
  {
    frame.Image->Initialize();
  }
  else
  {
    frame.Continue(1); // too late to abort
    this->Compositor.Composite(
      frame.Window, rays.GetVisible(), this->Caster.GetPicture().GetTexture(0));
    frame.ReadPicture = [this](vtkImageData* image) { this->Read(image); };
  }
  frame.Seconds.emplace_back("cast", castStopwatch.GetSeconds());

  // A sum is rounded once for each segment.
  const double segments =
    PathOfCubeRoot * std::cbrt(static_cast<double>(scene.GetMesh()->GetNumberOfCells()));
  frame.Errors = { { "early_termination", terminationError }, { "integrals", IntegralError },
    { "summation", segments * std::numeric_limits<float>::epsilon() / 2 },
    { "table", frame.Integration == "table" ? scene.GetTableError() : 0 },
    { "geometry", geometryError } };
  frame.LeaveOut(
    tables == scene.GetVisibleTables(), "transparent tetrahedra", "nothing of them is seen");
  frame.LeaveOut(reentry != GpuReentry::Imaginary, "imaginary cells",
    reentry == GpuReentry::None ? "rays do not enter again" : "rays enter by the boundary");
  this->Describe(statistics, options, frame);
  this->WarnOfReentry(*scene.GetMesh());
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::Describe(
  const tetralux::GpuRayCastStatistics& statistics, const tetralux::GpuRayCastOptions& options,
  MapperFrame& frame)
{
  const tetralux::FloatTarget::Settings& picture = this->Caster.GetPicture().GetSettings();
  JsonObject rays;
  rays.Set("width", picture.Width);
  rays.Set("height", picture.Height);
  rays.Set("rays", static_cast<std::int64_t>(picture.Width) * picture.Height);
  rays.Set("passes", statistics.Passes);
  rays.Set("steps_per_pass", this->Self->StepsPerPass);
  rays.Set("fragments_per_pass", statistics.Fragments);
  if (this->Self->CountFragments)
  {
    rays.Set("segments", statistics.Steps);
  }
  const char* boundary = options.Layers ? "boundary layers" : "boundary hierarchy";
  rays.Set("first_entry", boundary);
  rays.Set("reentry",
    options.Reentry == GpuReentry::Imaginary    ? "imaginary cells"
      : options.Reentry == GpuReentry::Boundary ? boundary
                                                : "none");
  rays.Set("shader_variant", statistics.Variant);
  frame.Sections.emplace_back("rays", rays);

  const tetralux::GraphicsCard card = tetralux::DescribeGraphicsCard(frame.Window);
  JsonObject graphics;
  graphics.Set("renderer", card.Renderer);
  graphics.Set("software", card.Software);
  graphics.Set("mesh_bytes", this->Mesh.GetNumberOfBytes());
  graphics.Set("tetrahedra_and_points_bytes", this->Mesh.GetNumberOfCellAndPointBytes());
  graphics.Set("uploaded_bytes", this->Mesh.GetUploadedBytes());
  graphics.Set("integral_bytes", this->Integral.GetNumberOfBytes());
  graphics.Set("picture_bytes", this->Caster.GetNumberOfBytes() + this->Limits.GetNumberOfBytes());
  frame.Sections.emplace_back("graphics_card", graphics);
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraGPURayCastMapper::Internals::IsSupported(vtkRenderWindow* window)
{
  auto* openGL = vtkOpenGLRenderWindow::SafeDownCast(window);
  if (!openGL)
  {
    this->SupportReason = "the window is not one of OpenGL";
    return false;
  }
  openGL->Initialize();
  openGL->MakeCurrent();
  const tetralux::GraphicsCard card = tetralux::DescribeGraphicsCard(openGL);
  this->SupportReason = card.Renderer;
  if (std::make_pair(card.Version[0], card.Version[1]) < std::make_pair(3, 2))
  {
    this->SupportReason += " has OpenGL " + std::to_string(card.Version[0]) + '.' +
      std::to_string(card.Version[1]) + ", and 3.2 is needed";
    return false;
  }
  if (card.Software)
  {
    this->SupportReason += " runs on the processor, where rays are cast faster without OpenGL";
    return false;
  }
  // Without making its tetrahedra: a hexahedron becomes five or six of them.
  constexpr std::int64_t TetrahedraOfCell = 6;
  if (auto* input = vtkDataSet::SafeDownCast(this->Self->GetDataObjectInput()))
  {
    const std::int64_t cells = TetrahedraOfCell * input->GetNumberOfCells();
    const std::string obstacle = tetralux::FindObstacle(
      { { "faces", 4 * cells, 8 }, { "points", input->GetNumberOfPoints(), 16 } }, card.Limits);
    if (!obstacle.empty())
    {
      this->SupportReason += ": there may be no room, " + obstacle;
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------------------------
const tetralux::WalkTables* vtkTetrahedraGPURayCastMapper::Internals::ChooseTables(
  MapperFrame& frame, GpuReentry& reentry)
{
  tetralux::VolumeScene& scene = *frame.Scene;
  tetralux::WalkMesh* mesh = scene.GetMesh();
  reentry = this->Self->Reentry == NO_REENTRY ? GpuReentry::None : GpuReentry::Boundary;
  if (this->Self->Reentry == IMAGINARY_CELLS)
  {
    mesh->MakeConvex([&frame](double fraction) { return frame.Continue(fraction); });
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
  const tetralux::WalkTables* visible =
    reentry == GpuReentry::None ? nullptr : scene.GetVisibleTables();
  if (!visible && this->Self->Reentry == AUTOMATIC_REENTRY && mesh->IsConvex())
  {
    reentry = GpuReentry::None;
  }
  return visible ? visible : &mesh->GetTables();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::UpdateOrientation(const tetralux::VolumeScene& scene)
{
  if (this->PositiveVersion == scene.GetMeshVersion())
  {
    return;
  }
  const tetralux::WalkMesh& mesh = *scene.GetMesh();
  this->Positive =
    tetralux::OrientCells(mesh.GetMesh().Points, mesh.GetMesh().Cells, mesh.GetTables().Faces);
  this->PositiveVersion = scene.GetMeshVersion();
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::Upload(MapperFrame& frame,
  const tetralux::RayGrid& grid, const tetralux::WalkTables& tables, GpuReentry reentry)
{
  tetralux::VolumeScene& scene = *frame.Scene;
  this->Mesh.ResetUploadedBytes();
  const bool directed = reentry == GpuReentry::Boundary;
  if (directed)
  {
    this->UpdateOrientation(scene);
    if (this->Positive.empty())
    {
      throw std::runtime_error(
        "the cells of the mesh can't be oriented, since a ring of them comes "
        "back mirrored: vtkTetrahedraRayCastMapper renders it all the same");
    }
  }
  const tetralux::WalkPoint<float>* points = scene.GetPoints<float>();
  const std::size_t numberOfPoints = scene.GetMesh()->GetNumberOfTablePoints();
  const std::uint64_t meshVersion = scene.GetMeshVersion();
  const tetralux::WalkTextures::Version topologyVersion{ meshVersion,
    static_cast<std::uint64_t>(reentry),
    &tables == scene.GetVisibleTables() ? scene.GetVisibleTablesVersion() : 0 };
  if (!this->Mesh.HasTopology(frame.Window, topologyVersion))
  {
    const std::string obstacle =
      tetralux::WalkTextures::FindObstacle(frame.Window, tables, numberOfPoints);
    if (!obstacle.empty())
    {
      throw std::runtime_error(obstacle);
    }
    this->Mesh.SetTopology(frame.Window, tables,
      directed ? tetralux::Span<const std::uint8_t>(this->Positive)
               : tetralux::Span<const std::uint8_t>(),
      topologyVersion);
  }
  this->Mesh.UpdatePoints(frame.Window, { points, numberOfPoints },
    { meshVersion, scene.GetPointsVersion(), numberOfPoints });

  if (frame.Shaded && this->Self->SmoothShading)
  {
    this->Mesh.UpdateGradients(
      frame.Window, scene.GetPointGradients(), { meshVersion, scene.GetPointsVersion() });
  }

  tetralux::SegmentSource source = tetralux::MakeSegmentSource(scene);
  source.LongestSegment = scene.GetLongestSegment(grid);
  source.Shaded = frame.Shaded;
  this->Integral.Update(frame.Window, source);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::Read(vtkImageData* image)
{
  tetralux::FloatTarget& picture = this->Caster.GetPicture();
  const int width = picture.GetSettings().Width;
  const int height = picture.GetSettings().Height;
  tetralux::Span<float> colors, depths;
  MapperFrame::PrepareImage(image, width, height, colors, depths);
  picture.Read(0, colors);
  std::vector<float> pairs(2 * depths.size());
  picture.Read(1, pairs);
  for (std::size_t k = 0; k < depths.size(); ++k)
  {
    depths[k] = pairs[2 * k];
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::WarnOfReentry(const tetralux::WalkMesh& mesh)
{
  const tetralux::Convexification* convex = mesh.GetConvexification();
  const bool refused = this->Self->Reentry == IMAGINARY_CELLS && convex && !convex->Refusal.empty();
  this->ReentryWarning.Update(this->Self,
    refused ? "the mesh can't be made convex, rays enter it by its boundary: " + convex->Refusal
            : "");
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::Internals::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Mesh.ReleaseGraphicsResources(window);
  this->Integral.ReleaseGraphicsResources(window);
  this->Limits.ReleaseGraphicsResources(window);
  this->Caster.ReleaseGraphicsResources(window);
  this->Compositor.ReleaseGraphicsResources(window);
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
  return this->Private->IsSupported(window);
}

//------------------------------------------------------------------------------------------------
std::string vtkTetrahedraGPURayCastMapper::GetSupportReason()
{
  return this->Private->SupportReason;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Private->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraGPURayCastMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Reentry: " << this->Reentry << "\n"
     << indent << "StepsPerPass: " << this->StepsPerPass << "\n"
     << indent << "CountFragments: " << this->CountFragments << "\n";
}
