// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraProjectionMapper.h"

#include "Base/Cached.h"
#include "Base/Stopwatch.h"
#include "Frame/CameraRays.h"
#include "Frame/ImageCompositor.h"
#include "Frame/MapperFrame.h"
#include "Frame/OpaqueDepth.h"
#include "Frame/PictureDrawing.h"
#include "GpuIntegral/ShaderError.h"
#include "GpuProjection/ProjectionPicture.h"
#include "Integral/SegmentWeightError.h"
#include "OpenGL/EnteredContext.h"
#include "Projection/PerspectiveShift.h"
#include "Projection/ScreenFrame.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"
#include "Report/OnceWarning.h"
#include "Scene/IntegratorChoice.h"
#include "Scene/VolumeScene.h"
#include "View/MeshToWorld.h"
#include "Visibility/MeshOrder.h"

#include "vtkCellCenterDepthSort.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

using tetralux::CameraRays;
using Sort = vtkMeshedPolyhedraVisibilitySort;
using tetralux::ChannelFormat;
using tetralux::Integrator;
using tetralux::Json;
using tetralux::MapperFrame;
using tetralux::ScreenFrame;
using tetralux::Span;
using tetralux::VisibilityMethod;
using tetralux::VolumeScene;

namespace
{

/// The largest number of half precision.
constexpr double LargestHalf = 65504;

/// Rounding of a number from 1/2 to 1 in a format. OpenGL does not say how blending rounds to 16
/// bits: some graphics cards and Mesa's llvmpipe cut bits off.
double GetRounding(ChannelFormat format)
{
  switch (format)
  {
    case ChannelFormat::UNorm8:
      return 0.5 / 255;
    case ChannelFormat::Half:
      return 1. / (1 << 11);
    default:
      return 0.5 * std::numeric_limits<float>::epsilon();
  }
}

/// Error of a channel by adding up what the cells along a ray contribute.
double EstimateSummationError(
  VolumeScene& volume, ChannelFormat format, double worldRadius, bool dithered)
{
  const tetralux::EightBitErrors errors = format == ChannelFormat::UNorm8
    ? volume.EstimateEightBitErrors(worldRadius)
    : tetralux::EightBitErrors();
  const double measured = dithered ? errors.Random.Largest : errors.Nearest.Largest;
  if (measured > 0)
  {
    return measured;
  }
  const double largest = volume.EstimateLargestChannel(worldRadius);
  if (format == ChannelFormat::Half && largest > LargestHalf)
  {
    return std::numeric_limits<double>::infinity();
  }
  // A ray goes through at most some four cells for each that lie side by side along the mesh. The
  // largest scalar is not summed up: what it is seen as is written once.
  const double sums = volume.Optics.GetModel() == tetralux::OpticalModel::MaximumIntensity
    ? 1
    : 4 * std::cbrt(static_cast<double>(volume.Mesh.GetMesh()->GetNumberOfCells()));
  return sums * GetRounding(format) * std::exp2(std::ceil(std::log2(largest)));
}

const char* GetFormatName(ChannelFormat format)
{
  switch (format)
  {
    case ChannelFormat::UNorm8:
      return "8-bit";
    case ChannelFormat::Half:
      return "half";
    default:
      return "float";
  }
}

const char* GetMethodName(VisibilityMethod method)
{
  switch (method)
  {
    case VisibilityMethod::Meshed:
      return "meshed polyhedra";
    case VisibilityMethod::MeshedAcrossGaps:
      return "meshed polyhedra, across gaps";
    case VisibilityMethod::MeshedNonConvex:
      return "meshed polyhedra, not convex";
    default:
      return "distance of centroids";
  }
}

/// Whether it does not matter in which order cells contribute.
bool Commutes(Integrator integrator)
{
  return integrator == Integrator::OpticalDepth || integrator == Integrator::Emission ||
    integrator == Integrator::Maximum;
}

tetralux::VisibilityView MakeView(const tetralux::RayGrid& grid, bool perspective)
{
  tetralux::VisibilityView view;
  view.Parallel = !perspective;
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    const double* o = grid.Origin;
    const double* d = grid.Direction;
    view.Eye[a] = row[0] * o[0] + row[1] * o[1] + row[2] * o[2] + row[3];
    view.Direction[a] = row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
  }
  return view;
}

} // namespace

//------------------------------------------------------------------------------------------------
// The stages of a frame, and what they keep.
class vtkTetrahedraProjectionMapper::Internals
{
public:
  explicit Internals(vtkTetrahedraProjectionMapper* self)
    : Self(self)
  {
  }

  void DrawFrame(MapperFrame& frame);

  void ReleaseGraphicsResources(vtkWindow* window)
  {
    this->Picture.ReleaseGraphicsResources(window);
    this->Compositor.ReleaseGraphicsResources(window);
    this->Drawing.ReleaseGraphicsResources(window);
    this->OfPicture.Opaque.ReleaseGraphicsResources(window);
    this->OfSamples.Opaque.ReleaseGraphicsResources(window);
  }

  bool Sorted = false; ///< in the last frame, by Method
  VisibilityMethod Method = VisibilityMethod::Meshed;

private:
  /// The rays of a picture.
  struct View
  {
    tetralux::RayGrid Grid;
    tetralux::RayLimits Limits;
    double SampleDistance; ///< pixels from ray to ray
  };

  /// The mesh as it is seen, which scenes point to.
  struct Sight
  {
    std::vector<tetralux::ScreenPoint> Points;
    std::vector<std::uint8_t> DrawnCells; ///< empty: all
    tetralux::OpaqueDepth Opaque;
  };

  void DrawIntoWindow(MapperFrame& frame, const CameraRays& rays);
  tetralux::PixelRectangle MakePicture(MapperFrame& frame, const tetralux::PictureTask& task);
  void MakeSamples(MapperFrame& frame, const tetralux::PictureTask& task);

  /// Finds what all pictures of the frame have in common.
  void PrepareScene(MapperFrame& frame, const tetralux::RayGrid& grid);

  /// Projects the points of the mesh, and finds what limits rays and which cells are drawn.
  static void PlaceScene(
    MapperFrame& frame, const View& view, tetralux::ProjectionScene& scene, Sight& sight);
  static void PlaceDepths(
    const tetralux::DepthPlaces& places, tetralux::ProjectionScene& scene, Sight& sight);

  /// Orders, draws and describes the scene.
  void Draw(MapperFrame& frame, const View& view);

  /// The order of the cells that are drawn. False after an abort.
  bool PrepareOrder(MapperFrame& frame);

  ChannelFormat ChooseFormat(const MapperFrame& frame) const;
  double EstimatePerspectiveError(VolumeScene& volume) const;
  void Composite(MapperFrame& frame, const CameraRays& rays);
  void Describe(
    const tetralux::ProjectionPicture::Result& drawn, const View& view, MapperFrame& frame);
  void WarnOfOrder(const std::string& refusal);

  vtkTetrahedraProjectionMapper* Self;
  tetralux::ProjectionPicture Picture;
  tetralux::ImageCompositor Compositor;
  tetralux::PictureDrawing Drawing;
  tetralux::CacheStamp Last; ///< of the picture that Picture has
  tetralux::ProjectionScene Scene;
  Sight OfPicture; ///< Scene's
  Sight OfSamples;
  double WorldRadius = 1;          ///< of the mesh, world units
  std::vector<std::int32_t> Order; ///< of cells that are not sorted
  std::unique_ptr<tetralux::MeshOrder> Sorter;
  tetralux::CacheStamp SorterStamp; ///< of the points
  tetralux::OnceWarning OrderWarning;
};

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::Internals::DrawFrame(MapperFrame& frame)
{
  frame.Method = "projection";
  if (frame.Scene->Mesh.GetMesh()->GetNumberOfCells() == 0)
  {
    frame.MakeEmptyPicture(CameraRays(frame.Renderer, 1));
    this->Last.Reset();
    return;
  }
  frame.Scene->CheckComplete();
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
void vtkTetrahedraProjectionMapper::Internals::DrawIntoWindow(
  MapperFrame& frame, const CameraRays& rays)
{
  const View view = { frame.MakeGrid(rays), frame.MakeLimits(rays), 1 };
  frame.Opaque = frame.HasOpaqueGeometry();
  frame.AddViewToKey(rays, view.Grid, view.Limits);
  frame.Key.Add(frame.Opaque);
  if (frame.HasPicture && this->Last.Has(frame.Key) &&
    (!frame.Opaque || this->OfPicture.Opaque.IsSame(frame.Window, rays.GetVisible())))
  {
    frame.Kept = true;
    frame.ReportProgress(1); // too late to abort
    this->Composite(frame, rays);
    return;
  }
  this->Last.Reset();
  this->PrepareScene(frame, view.Grid);
  PlaceScene(frame, view, this->Scene, this->OfPicture);
  if (frame.Opaque)
  {
    const tetralux::Stopwatch stopwatch;
    this->OfPicture.Opaque.Copy(frame.Window, rays.GetVisible());
    PlaceDepths(rays.GetDepthPlaces(), this->Scene, this->OfPicture);
    frame.Seconds.emplace_back("depth_buffer", stopwatch.GetSeconds());
  }
  this->Draw(frame, view);
  if (frame.Aborted)
  {
    return;
  }
  this->Composite(frame, rays);
  this->Last.Set(frame.Key);
  frame.ReadPicture = [this, window = frame.Window](vtkImageData* image)
  {
    const tetralux::EnteredContext context(window);
    Span<float> colors, depths;
    MapperFrame::PrepareImage(
      image, this->Scene.Grid.Width, this->Scene.Grid.Height, colors, depths);
    this->Picture.ReadColors(this->Scene, colors);
    this->Picture.ReadDistances(this->Scene, depths);
  };
}

//------------------------------------------------------------------------------------------------
tetralux::PixelRectangle vtkTetrahedraProjectionMapper::Internals::MakePicture(
  MapperFrame& frame, const tetralux::PictureTask& task)
{
  if (task.OfSamples)
  {
    this->MakeSamples(frame, task);
    return FindColored(task);
  }
  const View view = { task.Grid, task.Limits, task.SampleDistance };
  this->PrepareScene(frame, view.Grid);
  PlaceScene(frame, view, this->Scene, this->OfPicture);
  if (task.OpaqueDepths)
  {
    this->OfPicture.Opaque.Upload(
      frame.Window, task.Grid.Width, task.Grid.Height, *task.OpaqueDepths);
    PlaceDepths(task.Places, this->Scene, this->OfPicture);
  }
  this->Draw(frame, view);
  if (frame.Aborted)
  {
    return {};
  }
  this->Picture.ReadColors(this->Scene, task.Colors);
  // Distances take another drawing, for who asks for them.
  frame.ReadPicture = [this, window = frame.Window, depths = task.Depths](vtkImageData*)
  {
    const tetralux::EnteredContext context(window);
    this->Picture.ReadDistances(this->Scene, depths);
  };
  return FindColored(task);
}

//------------------------------------------------------------------------------------------------
// The cells of the frame's picture in the same order, seen by rays beside the middles of pixels.
void vtkTetrahedraProjectionMapper::Internals::MakeSamples(
  MapperFrame& frame, const tetralux::PictureTask& task)
{
  tetralux::ProjectionScene scene = this->Scene;
  PlaceScene(frame, { task.Grid, task.Limits, task.SampleDistance }, scene, this->OfSamples);
  this->OfSamples.Opaque.Upload(
    frame.Window, task.Grid.Width, task.Grid.Height, *task.OpaqueDepths);
  PlaceDepths(task.Places, scene, this->OfSamples);
  scene.Hides = true;
  const auto goOn = [&frame](double fraction) { return frame.ReportProgress(fraction); };
  frame.Aborted = this->Picture.Draw(frame.Window, scene, goOn).Aborted;
  if (!frame.Aborted)
  {
    this->Picture.ReadColors(scene, task.Colors);
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::Internals::Draw(MapperFrame& frame, const View& view)
{
  if (!this->PrepareOrder(frame))
  {
    frame.Aborted = true;
    return;
  }
  const tetralux::Stopwatch stopwatch;
  const tetralux::ProjectionPicture::Result result = this->Picture.Draw(frame.Window, this->Scene,
    [&frame](double fraction) { return frame.ReportProgress(fraction); });
  frame.RaySeconds = stopwatch.GetSeconds() - result.ProjectSeconds - result.DivideSeconds;
  frame.Seconds.emplace_back("divide", result.DivideSeconds);
  frame.Seconds.emplace_back("project", result.ProjectSeconds);
  for (const auto& [stage, seconds] : frame.Seconds)
  {
    const bool ofView = stage == "points" || stage == "order" || stage == "project";
    frame.FixedSeconds += ofView ? seconds : 0;
  }
  frame.Seconds.emplace_back("draw", frame.RaySeconds);
  frame.Aborted = result.Aborted;
  frame.Integration = this->Picture.GetIntegrator();
  this->Describe(result, view, frame);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::Internals::Composite(MapperFrame& frame, const CameraRays& rays)
{
  const tetralux::Stopwatch stopwatch;
  const tetralux::WalkMesh& mesh = *frame.Scene->Mesh.GetMesh();
  const tetralux::PixelRectangle covered =
    rays.FindCovered(frame.Volume->GetMatrix()->GetData(), mesh.GetCenter(), mesh.GetHalfSize());
  if (covered.Width > 0)
  {
    this->Compositor.Composite(
      frame.Window, rays.GetVisible(), this->Picture.GetTexture(), covered);
  }
  frame.Seconds.emplace_back("composite", stopwatch.GetSeconds());
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::Internals::PrepareScene(
  MapperFrame& frame, const tetralux::RayGrid& grid)
{
  VolumeScene& volume = *frame.Scene;
  tetralux::SceneNeeds needs;
  needs.VisibleCells = true;
  needs.LongestEdge = true;
  needs.PointGradients = frame.Shaded && frame.Settings.SmoothShading;
  volume.Prepare(needs);
  tetralux::ProjectionScene& scene = this->Scene;
  scene.Volume = &volume;
  this->WorldRadius =
    volume.Mesh.GetMesh()->GetRadius() * tetralux::MeasureMeshToWorld(grid.MeshFromWorld).Largest;
  VolumeScene::CheckWorldRadius(this->WorldRadius);
  scene.Interpolate = this->Self->PerspectiveInterpolation != 0;
  scene.Dither = this->Self->AlphaDithering && this->Self->ColorBuffer == UNORM8_BUFFER &&
    volume.EstimateEightBitErrors(this->WorldRadius).IsRandomBetter();
  scene.Format = this->ChooseFormat(frame);
  scene.FrontToBack = scene.Format == ChannelFormat::Float;

  scene.Lighting = frame.GetLighting();
  scene.SmoothShading = frame.Settings.SmoothShading;
  scene.Steps = tetralux::FindLightSteps(frame.Lights, frame.Surface,
    tetralux::MakeErrorBudget(frame.MaximumError, { false, false, false, false, true }).Light);
  scene.Lights = frame.Lights;
  scene.Surface = frame.Surface;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::Internals::PlaceScene(
  MapperFrame& frame, const View& view, tetralux::ProjectionScene& scene, Sight& sight)
{
  const tetralux::Stopwatch stopwatch;
  const VolumeScene& volume = *scene.Volume;
  const tetralux::WalkMesh& mesh = *volume.Mesh.GetMesh();
  const tetralux::TetrahedralMesh& tetrahedra = mesh.GetMesh();
  scene.Grid = view.Grid;
  scene.Frame = std::make_shared<ScreenFrame>(scene.Grid, mesh.GetCenter(), mesh.GetRadius());
  sight.Points.resize(tetrahedra.GetNumberOfPoints());
  const tetralux::ScalarMap map = volume.GetScalarMap();
  const Span<const double> none;
  scene.Frame->Project(tetrahedra.Points,
    volume.Mesh.HasCellScalars() ? none : Span<const double>(volume.Mesh.GetScalars()), map.Offset,
    map.Scale, sight.Points);
  scene.Points = sight.Points;

  ScreenFrame::Limits found = scene.Frame->FindLimits(
    view.Limits.Planes, sight.Points, tetrahedra.Cells, volume.GetVisibleCells());
  sight.DrawnCells = found.Planes.empty() ? volume.GetVisibleCells() : found.Cells;
  scene.Planes = std::move(found.Planes);
  scene.Cropping.clear();
  if (view.Limits.Cropping)
  {
    for (int plane = 0; plane < 6; ++plane)
    {
      const double* row = scene.Grid.MeshFromWorld[plane / 2];
      scene.Cropping.push_back(scene.Frame->ProjectPlane(
        { row[0], row[1], row[2], row[3] - view.Limits.CroppingPlanes[plane] }));
    }
    scene.CroppingFlags = view.Limits.CroppingFlags;
  }
  scene.OpaqueDepth = nullptr;
  frame.Seconds.emplace_back("points", stopwatch.GetSeconds());
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::Internals::PlaceDepths(
  const tetralux::DepthPlaces& places, tetralux::ProjectionScene& scene, Sight& sight)
{
  scene.OpaqueDepth = sight.Opaque.GetTexture();
  tetralux::DepthPlaces ofMiddle = places;
  ofMiddle.Shift(scene.Frame->GetMiddle()[0], scene.Frame->GetMiddle()[1]);
  const double* points[4] = { ofMiddle.Farthest, ofMiddle.FarthestStepX, ofMiddle.FarthestStepY,
    ofMiddle.Nearer };
  for (int k = 0; k < 4; ++k)
  {
    const std::array<double, 2> depth = scene.Frame->ProjectDepth(ofMiddle.Position, points[k]);
    scene.OpaquePlaces[k][0] = static_cast<float>(depth[0]);
    scene.OpaquePlaces[k][1] = static_cast<float>(depth[1]);
  }
}

//------------------------------------------------------------------------------------------------
ChannelFormat vtkTetrahedraProjectionMapper::Internals::ChooseFormat(const MapperFrame& frame) const
{
  switch (this->Self->ColorBuffer)
  {
    case FLOAT_BUFFER:
      return ChannelFormat::Float;
    case HALF_BUFFER:
      return ChannelFormat::Half;
    case UNORM8_BUFFER:
      return ChannelFormat::UNorm8;
    default:
      return EstimateSummationError(*frame.Scene, ChannelFormat::Half, this->WorldRadius, false) <=
          tetralux::MakeErrorBudget(frame.MaximumError, { false, false, true, false }).Buffer
        ? ChannelFormat::Half
        : ChannelFormat::Float;
  }
}

//------------------------------------------------------------------------------------------------
bool vtkTetrahedraProjectionMapper::Internals::PrepareOrder(MapperFrame& frame)
{
  tetralux::WalkMesh& mesh = *frame.Scene->Mesh.GetMesh();
  this->Scene.Commutes = Commutes(tetralux::ChooseIntegrator(*frame.Scene, frame.GetLighting()));
  this->Sorted = !this->Scene.Commutes;
  if (this->Sorted)
  {
    const tetralux::Stopwatch stopwatch;
    this->Scene.Order = {}; // the sorter's
    const tetralux::CacheKey key = tetralux::CacheKey::Of(frame.Scene->Mesh.GetPointsVersion());
    if (!this->SorterStamp.Has(key))
    {
      this->Sorter = std::make_unique<tetralux::MeshOrder>(mesh);
      this->SorterStamp.Set(key);
    }
    const std::vector<std::int32_t>* order =
      this->Sorter->Sort(MakeView(this->Scene.Grid, this->Scene.Frame->IsPerspective()),
        Sort::GetWishOf(this->Self->Order),
        this->Scene.FrontToBack ? tetralux::VisibilityDirection::FrontToBack
                                : tetralux::VisibilityDirection::BackToFront,
        this->OfPicture.DrawnCells,
        [&frame](double fraction) { return frame.ReportProgress(fraction); });
    if (!order)
    {
      return false;
    }
    this->Scene.Order = *order;
    this->Method = this->Sorter->Get().GetUsedMethod();
    this->WarnOfOrder(
      this->Self->Order == Sort::EXACT_ORDER && this->Method == VisibilityMethod::MeshedNonConvex
        ? this->Sorter->GetRefusal()
        : "");
    const double convexification = this->Sorter->GetConvexificationSeconds();
    const double tables = this->Sorter->GetTableSeconds();
    if (convexification > 0)
    {
      frame.Seconds.emplace_back("convexification", convexification);
    }
    if (tables > 0)
    {
      frame.Seconds.emplace_back("order_tables", tables);
    }
    frame.Seconds.emplace_back("order", stopwatch.GetSeconds() - convexification - tables);
    return true;
  }
  this->Order.resize(mesh.GetNumberOfCells()); // else empty: the sorter keeps its own
  std::iota(this->Order.begin(), this->Order.end(), 0);
  if (!this->OfPicture.DrawnCells.empty())
  {
    this->Order.erase(std::remove_if(this->Order.begin(), this->Order.end(),
                        [this](std::int32_t cell) { return !this->OfPicture.DrawnCells[cell]; }),
      this->Order.end());
  }
  this->Scene.Order = this->Order;
  return true;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::Internals::WarnOfOrder(const std::string& refusal)
{
  this->OrderWarning.Update(this->Self,
    refusal.empty()
      ? ""
      : "the mesh can't be made convex, and there are too many faces that rays may leave "
        "and enter it by: the order of its cells may be wrong: " +
        refusal);
}

//------------------------------------------------------------------------------------------------
double vtkTetrahedraProjectionMapper::Internals::EstimatePerspectiveError(VolumeScene& volume) const
{
  if (this->Scene.Interpolate || !this->Scene.Frame->IsPerspective())
  {
    return 0;
  }
  const tetralux::WalkMesh& mesh = *volume.Mesh.GetMesh();
  const double shift = tetralux::FindPerspectiveShift(
    *this->Scene.Frame, this->OfPicture.Points, mesh.GetMesh(), this->OfPicture.DrawnCells);
  return volume.EstimateShiftError(this->WorldRadius, shift / mesh.GetRadius());
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::Internals::Describe(
  const tetralux::ProjectionPicture::Result& drawn, const View& view, MapperFrame& frame)
{
  VolumeScene& volume = *frame.Scene;
  const tetralux::ProjectionScene& scene = this->Scene;

  Json section;
  section["width"] = scene.Grid.Width;
  section["height"] = scene.Grid.Height;
  section["sample_distance"] = view.SampleDistance;
  section["perspective_interpolation"] = scene.Interpolate;
  section["color_buffer"] = GetFormatName(scene.Format);
  section["alpha_dithering"] = scene.Dither;
  if (scene.Format == ChannelFormat::UNorm8)
  {
    const tetralux::EightBitErrors errors = volume.EstimateEightBitErrors(this->WorldRadius);
    section["rms_of_rounding_to_nearest"] = std::sqrt(errors.Nearest.MeanSquare);
    section["rms_of_rounding_at_random"] = std::sqrt(errors.Random.MeanSquare);
  }
  section["tetrahedra_in_order"] = static_cast<std::int64_t>(scene.Order.size());
  section["tetrahedra_drawn"] = drawn.Cells;
  section["parts_drawn"] = drawn.Parts;
  section["triangles"] = drawn.Triangles;
  frame.ReportOmission(drawn.WhyWhole, "cells in parts", drawn.WhyWhole);
  section["order"] = this->Sorted ? GetMethodName(this->Method) : "none";
  if (this->Sorted)
  {
    const tetralux::VisibilityCycles& cycles = this->Sorter->Get().GetCycles();
    section["cycles"] = cycles.GetNumberOfCycles();
    section["tetrahedra_in_cycles"] = static_cast<std::int64_t>(cycles.Cells.size());
    section["ignored_faces"] = cycles.IgnoredFaces;
    section["ignored_area"] = cycles.IgnoredArea;
    section["looks_for_gaps"] = this->Sorter->Get().GetLooksForGaps();
  }
  frame.Sections.emplace_back("projection", section);
  frame.Memory.emplace_back("screen_points",
    (this->OfPicture.Points.capacity() + this->OfSamples.Points.capacity()) *
      sizeof(tetralux::ScreenPoint));
  frame.Memory.emplace_back(
    "drawn_cells", this->OfPicture.DrawnCells.capacity() + this->OfSamples.DrawnCells.capacity());
  frame.Memory.emplace_back("order",
    this->Order.capacity() * sizeof(std::int32_t) +
      (this->Sorter && this->Sorted ? this->Sorter->Get().GetSize() : 0));
  frame.Memory.emplace_back("projected_cells", this->Picture.GetNumberOfCellBytes());
  frame.Memory.emplace_back("card_cells", this->Picture.GetNumberOfPartBytes());
  frame.Memory.emplace_back("card_integral", this->Picture.GetNumberOfIntegralBytes());
  frame.Memory.emplace_back("card_pictures", this->Picture.GetNumberOfPictureBytes());

  const bool isOrderWrong = this->Sorted &&
    (this->Method == VisibilityMethod::CentroidDistance ||
      this->Method == VisibilityMethod::MeshedNonConvex ||
      this->Sorter->Get().GetCycles().GetNumberOfCycles() > 0);
  const Integrator integrator = frame.Integration;
  if (IsLit(integrator))
  {
    const auto& meshFromWorld = scene.Grid.MeshFromWorld;
    const tetralux::WalkMesh& mesh = *volume.Mesh.GetMesh();
    frame.Brightness = tetralux::FindLargestBrightness(frame.Lights, frame.Surface, meshFromWorld,
      mesh.GetCenter(), mesh.GetRadius(), tetralux::MeasureMeshToWorld(meshFromWorld).Smallest);
  }
  frame.Budget = tetralux::MakeErrorBudget(frame.MaximumError,
    { false, IsTabulated(integrator), scene.Format != ChannelFormat::Float,
      volume.Optics.GetFunctionError() > 0, integrator == Integrator::VaryingLight });
  frame.Errors = { { "integrals", HasWeights(integrator) ? tetralux::SegmentWeightError : 0 },
    { "summation", EstimateSummationError(volume, scene.Format, this->WorldRadius, scene.Dither) },
    { "table", IsTabulated(integrator) ? volume.Optics.GetTableError() : 0 },
    { "geometry", volume.EstimateGeometryError(this->WorldRadius, tetralux::CellShaderRounding) },
    { "perspective", this->EstimatePerspectiveError(volume) },
    { "order", isOrderWrong ? volume.EstimateOrderError(this->WorldRadius) : 0 } };

  frame.ReportOmission(!this->Sorted, "order", "what cells add commutes");
  frame.ReportOmission(scene.Planes.empty(), "near and far plane", "they cut nothing");
  frame.ReportOmission(
    scene.Order.size() < static_cast<std::size_t>(volume.Mesh.GetMesh()->GetNumberOfCells()),
    "unseen tetrahedra", "they are transparent or clipped");
  frame.ReportOmission(!scene.Dither, "alpha dithering",
    this->Self->ColorBuffer != UNORM8_BUFFER ? "colours have more than 8 bits"
      : !this->Self->AlphaDithering          ? "it is off"
                                             : "rounding to the nearest is nearer to the picture");
  frame.ReportOmission(
    !scene.Frame->IsPerspective(), "perspective interpolation", "the view is parallel");
}

//------------------------------------------------------------------------------------------------
vtkStandardNewMacro(vtkTetrahedraProjectionMapper);

//------------------------------------------------------------------------------------------------
vtkTetrahedraProjectionMapper::vtkTetrahedraProjectionMapper()
  : Private(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraProjectionMapper::~vtkTetrahedraProjectionMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::DrawFrame(MapperFrame& frame)
{
  this->Private->DrawFrame(frame);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::ReleaseResources(vtkWindow* window)
{
  this->Private->ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
tetraluxEnumerationMacro(vtkTetrahedraProjectionMapper, ColorBuffer);
tetraluxEnumerationMacro(vtkTetrahedraProjectionMapper, Order);

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::SetVisibilitySort(vtkVisibilitySort* sort)
{
  if (this->VisibilitySort != sort)
  {
    this->VisibilitySort = sort;
    this->Modified();
  }
  if (auto* meshed = Sort::SafeDownCast(sort))
  {
    this->SetOrder(meshed->GetOrder());
  }
  else if (!sort)
  {
    this->SetOrder(Sort::AUTOMATIC_ORDER);
  }
  else if (vtkCellCenterDepthSort::SafeDownCast(sort))
  {
    this->SetOrder(Sort::CENTROID_ORDER);
  }
  else
  {
    this->WarnOfCall(
      "VisibilitySort", "Order has what " + std::string(sort->GetClassName()) + " may be set for");
  }
}

//------------------------------------------------------------------------------------------------
vtkVisibilitySort* vtkTetrahedraProjectionMapper::GetVisibilitySort()
{
  return this->VisibilitySort;
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::SetUseFloatingPointFrameBuffer(bool use)
{
  if (use != this->GetUseFloatingPointFrameBuffer())
  {
    this->SetColorBuffer(use ? AUTOMATIC_BUFFER : UNORM8_BUFFER);
  }
}

//------------------------------------------------------------------------------------------------
int vtkTetrahedraProjectionMapper::GetUsedOrder()
{
  return this->Private->Sorted ? Sort::GetOrderOf(this->Private->Method) : Sort::AUTOMATIC_ORDER;
}

//------------------------------------------------------------------------------------------------
const char* vtkTetrahedraProjectionMapper::GetUsedOrderAsString()
{
  return this->Private->Sorted ? tetralux::GetValueName("Order", this->GetUsedOrder()) : "none";
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintProperties(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("PerspectiveInterpolation", this->PerspectiveInterpolation);
  printer.Print("ColorBuffer", this->ColorBuffer);
  printer.Print("AlphaDithering", this->AlphaDithering);
  printer.Print("Order", this->Order);
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraProjectionMapper::PrintResults(ostream& os, vtkIndent indent)
{
  os << indent << "UsedOrder: " << this->GetUsedOrderAsString() << "\n";
  this->Superclass::PrintResults(os, indent);
}
