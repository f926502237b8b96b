// SPDX-License-Identifier: BSD-3-Clause
#include "GpuProjection/ProjectionPicture.h"
#include "OpenGL/LoadedFunctions.h"

#include "AlphaDitherDec.h"
#include "Base/Stopwatch.h"
#include "FirstPieceDec.h"
#include "FirstSurfaceDec.h"
#include "HiddenPixelsFS.h"
#include "LargestPictureFS.h"
#include "RayGridDec.h"
#include "Scene/VolumeScene.h"
#include "View/MeshToWorld.h"
#include "View/RayLimits.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// Cells that are projected at once, 4 MB. Enough for all threads. The first batch is projected
/// while nothing is drawn, so it has to be a small part of a frame.
constexpr std::size_t BatchSize = 32768;

/// Cells are drawn in parts where they have no more slices of parts on the average. Measured: at
/// 1024 x 1024 pixels what is drawn takes less time up to about two a cell, at 512 x 512 up to 1.7.
constexpr double MostSlicesPerCell = 1.8;

/// Of the progress of a picture whose cells have to be divided, what dividing them takes.
constexpr double DivideShare = 0.1;

/// No scalar and no distance; as in ProjectedCellFS.glsl and ClassifyLargestDec.glsl.
constexpr float Beyond = 1e38f;

/// Parts of cells that may wait for the graphics card. Drivers keep what they make of each part
/// until it is drawn, without a limit of their own: Mesa's llvmpipe a kilobyte a cell.
constexpr std::size_t MaximumPartsInFlight = 2;

/// The parts that were sent and may not be drawn yet.
class PartQueue
{
public:
  PartQueue() = default;
  PartQueue(const PartQueue&) = delete;
  PartQueue& operator=(const PartQueue&) = delete;

  ~PartQueue()
  {
    for (const GLsync fence : this->Fences)
    {
      glDeleteSync(fence);
    }
  }

  /// Waits until there is room for one more.
  void MakeRoom()
  {
    if (this->Fences.size() == MaximumPartsInFlight)
    {
      this->WaitForFirst();
    }
  }

  /// Waits until all are drawn.
  void Finish()
  {
    while (!this->Fences.empty())
    {
      this->WaitForFirst();
    }
  }

  void Add() { this->Fences.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)); }

private:
  void WaitForFirst()
  {
    glClientWaitSync(this->Fences.front(), GL_SYNC_FLUSH_COMMANDS_BIT, LongestWait);
    glDeleteSync(this->Fences.front());
    this->Fences.pop_front();
  }

  static constexpr GLuint64 LongestWait = GLuint64(60) * 1000 * 1000 * 1000; // nanoseconds

  std::deque<GLsync> Fences;
};

/// What is set while cells are drawn, and set back.
class DrawingState
{
public:
  explicit DrawingState(vtkOpenGLState* state)
    : State(state)
    , Blend(state, GL_BLEND)
    , DepthTest(state, GL_DEPTH_TEST)
    , CullFace(state, GL_CULL_FACE)
    , Scissor(state, GL_SCISSOR_TEST)
    , DepthMask(state)
    , DepthFunction(state)
    , ColorMask(state)
    , ClearColor(state)
    , BlendFunction(state)
    , Unit(state)
  {
    glGetIntegerv(GL_BLEND_EQUATION_RGB, &this->ColorEquation);
    glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &this->AlphaEquation);
    glGetIntegerv(GL_PROVOKING_VERTEX, &this->ProvokingVertex);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION); // as ProjectedCells::Triangles has it
    state->vtkglEnable(GL_BLEND);
    state->vtkglDisable(GL_DEPTH_TEST);
    state->vtkglDisable(GL_CULL_FACE);
    state->vtkglDisable(GL_SCISSOR_TEST);
    state->vtkglDepthMask(GL_FALSE);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  ~DrawingState()
  {
    this->State->vtkglBlendEquationSeparate(this->ColorEquation, this->AlphaEquation);
    glProvokingVertex(this->ProvokingVertex);
  }
  DrawingState(const DrawingState&) = delete;
  DrawingState& operator=(const DrawingState&) = delete;

private:
  vtkOpenGLState* State;
  const vtkOpenGLState::ScopedglEnableDisable Blend;
  const vtkOpenGLState::ScopedglEnableDisable DepthTest;
  const vtkOpenGLState::ScopedglEnableDisable CullFace;
  const vtkOpenGLState::ScopedglEnableDisable Scissor;
  const vtkOpenGLState::ScopedglDepthMask DepthMask;
  const vtkOpenGLState::ScopedglDepthFunc DepthFunction;
  const vtkOpenGLState::ScopedglColorMask ColorMask;
  const vtkOpenGLState::ScopedglClearColor ClearColor;
  const vtkOpenGLState::ScopedglBlendFuncSeparate BlendFunction;
  const vtkOpenGLState::ScopedglActiveTexture Unit;
  GLint ColorEquation = GL_FUNC_ADD;
  GLint AlphaEquation = GL_FUNC_ADD;
  GLint ProvokingVertex = GL_LAST_VERTEX_CONVENTION;
};

FloatTarget::Settings MakeSettings(
  const RayGrid& grid, int components, ChannelFormat format, bool hides)
{
  FloatTarget::Settings settings;
  settings.Width = grid.Width;
  settings.Height = grid.Height;
  settings.Pictures[0].Components = components;
  settings.Pictures[0].Format = format;
  settings.DepthStencil = hides;
  return settings;
}

} // namespace

ProjectionPicture::ProjectionPicture()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        for (Targets* targets : { &this->Whole, &this->Apart })
        {
          targets->Colors.ReleaseGraphicsResources(window);
          targets->Scalars.ReleaseGraphicsResources(window);
        }
        this->Distances.ReleaseGraphicsResources(window);
        this->Drawer.ReleaseGraphicsResources(window);
        this->Integral.ReleaseGraphicsResources(window);
        this->Pieces.ReleaseGraphicsResources(window);
        this->Classifier.ReleaseGraphicsResources(window);
        this->Hidden.ReleaseGraphicsResources(window);
      })
{
}

ProjectionPicture::~ProjectionPicture() = default;

ProjectionPicture::Result ProjectionPicture::Draw(vtkOpenGLRenderWindow* window,
  const ProjectionScene& scene, const std::function<bool(double)>& progress)
{
  this->Context.Set(window);
  SegmentSource source = MakeSegmentSource(*scene.Volume, scene.Lighting);
  source.LongestSegment = scene.Volume->Mesh.GetLongestEdge() *
    MeasureMeshToWorld(scene.Grid.MeshFromWorld).Largest; // no segment is longer
  this->Integral.Update(window, source);
  if (scene.Lighting != Lighting::None)
  {
    const WalkMesh& mesh = *scene.Volume->Mesh.GetMesh();
    this->Lighting.Update(
      scene.Lights, scene.Surface, scene.Steps, scene.Grid, mesh.GetCenter(), mesh.GetRadius());
    this->Rays.emplace(scene.Grid, RayLimits(), mesh.GetCenter(), mesh.GetRadius());
  }
  const Stopwatch stopwatch;
  double divided = 0; // of the progress
  const char* whole = nullptr;
  Result result;
  result.Aborted = !this->DivideCells(
    scene,
    [&](double share)
    {
      divided = DivideShare * share;
      return !progress || progress(divided);
    },
    whole);
  const double divideSeconds = stopwatch.GetSeconds();
  if (!result.Aborted)
  {
    result = this->DrawPicture(
      scene, [&](double share) { return !progress || progress(divided + share * (1 - divided)); });
  }
  result.WhyWhole = whole;
  result.DivideSeconds = divideSeconds;
  return result;
}

ProjectionPicture::Result ProjectionPicture::DrawPicture(
  const ProjectionScene& scene, const std::function<bool(double)>& progress)
{
  vtkOpenGLRenderWindow* window = this->Context.Get();
  const vtkOpenGLState::ScopedglActiveTexture unit(window->GetState());
  Targets& targets = scene.Hides ? this->Apart : this->Whole;
  targets.Colors.Prepare(window, MakeSettings(scene.Grid, 4, scene.Format, scene.Hides));
  if (scene.Volume->Optics.GetModel() == OpticalModel::MaximumIntensity)
  {
    targets.Scalars.Prepare(window, MakeSettings(scene.Grid, 1, ChannelFormat::Float, scene.Hides));
    const Result result = this->DrawCells(Pass::LargestScalars, targets.Scalars, scene, progress);
    this->ClassifyLargest(targets);
    return result;
  }
  return this->DrawCells(Pass::Colors, targets.Colors, scene, progress);
}

const char* ProjectionPicture::WhyCellsAreWhole(const ProjectionScene& scene) const
{
  if (!this->Integral.HasPartDeclarations())
  {
    return "segments are not integrated interval by interval of a function of points";
  }
  if (scene.Lighting != Lighting::None)
  {
    return "lights shine";
  }
  if (scene.Frame->IsPerspective() && !scene.Interpolate)
  {
    return "PerspectiveInterpolation is off";
  }
  return scene.Format != ChannelFormat::Float ? "ColorBuffer is not of 32-bit floats" : nullptr;
}

bool ProjectionPicture::DivideCells(
  const ProjectionScene& scene, const std::function<bool(double)>& progress, const char*& whole)
{
  whole = this->WhyCellsAreWhole(scene);
  if (whole)
  {
    this->Division.Clear();
    this->DivisionStamp.Reset();
    return true;
  }
  const VolumeScene& volume = *scene.Volume;
  // What cropping leaves of a ray in a cell is in several stretches. Each would be cut into slices
  // of its own, and those drawn out of order.
  const bool cropped = !scene.Cropping.empty();
  DivisionSource source;
  const TetrahedralMesh& mesh = volume.Mesh.GetMesh()->GetMesh();
  source.Intervals = volume.Optics.GetIntervalTable().Intervals;
  source.Points = scene.Points;
  source.Coordinates = mesh.Points;
  source.Cells = mesh.Cells;
  source.LengthScale = MeasureMeshToWorld(scene.Grid.MeshFromWorld).Largest;
  source.LongestEdge = volume.Mesh.GetLongestEdge();
  source.LargestDepth = this->Integral.GetLargestPartDepth();
  source.MostSlices = MostSlicesPerCell;
  const CacheKey key = CacheKey::Of(volume.Mesh.GetCellsVersion(), volume.Mesh.GetPointsVersion(),
    volume.Mesh.GetScalarsVersion(), volume.Optics.GetFunctionVersion(), source.LengthScale,
    source.LargestDepth, cropped);
  if (!this->DivisionStamp.Has(key))
  {
    this->DivisionStamp.Reset();
    const CellDivision::Outcome outcome = this->Division.Make(source, progress);
    if (outcome == CellDivision::Outcome::Aborted)
    {
      return false;
    }
    if (cropped && this->Division.HasSlices())
    {
      this->Division.Clear();
    }
    this->DivisionStamp.Set(key);
  }
  whole = this->Division.IsEmpty()
    ? "cells have too many parts, are too thick, or are thick and cropped"
    : nullptr;
  return true;
}

ProjectionPicture::Result ProjectionPicture::DrawCells(Pass pass, FloatTarget& target,
  const ProjectionScene& scene, const std::function<bool(double)>& progress)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  const DrawingState drawing(state);
  const FloatTarget::Use use(target);
  switch (pass)
  {
    case Pass::Colors:
      state->vtkglBlendEquation(GL_FUNC_ADD);
      if (scene.Volume->Optics.GetModel() == OpticalModel::EmissionOnly)
      {
        state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
      }
      else
      {
        const GLenum source = scene.FrontToBack ? GL_ONE_MINUS_DST_ALPHA : GL_ONE;
        const GLenum destination = scene.FrontToBack ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA;
        state->vtkglBlendFuncSeparate(source, destination, source, destination);
      }
      state->vtkglClearColor(0, 0, 0, 0);
      break;
    case Pass::LargestScalars:
      state->vtkglBlendEquation(GL_MAX);
      state->vtkglClearColor(-Beyond, 0, 0, 0);
      break;
    case Pass::FirstDistances:
      state->vtkglBlendEquation(GL_MIN);
      state->vtkglClearColor(Beyond, 0, 0, 0);
      break;
  }
  state->vtkglClear(GL_COLOR_BUFFER_BIT);
  if (scene.Hides)
  {
    this->CoverHidden(scene);
  }

  vtkShaderProgram* program = this->Drawer.Use(this->Context.Get(), this->MakeShader(pass, scene));
  this->SetUniforms(program, scene);
  GpuSegmentIntegral& integral = pass == Pass::FirstDistances ? this->Pieces : this->Integral;
  integral.Activate(program);
  const bool shaded = scene.Lighting != Lighting::None && pass == Pass::Colors;
  if (shaded)
  {
    this->Lighting.Set(program);
    this->Rays->Set(program);
  }
  if (scene.OpaqueDepth)
  {
    scene.OpaqueDepth->Activate();
    program->SetUniformi("opaqueDepth", scene.OpaqueDepth->GetTextureUnit());
    program->SetUniform2fv("opaquePlaces", 4, scene.OpaquePlaces);
  }
  const bool ofLargest = pass == Pass::FirstDistances &&
    scene.Volume->Optics.GetModel() == OpticalModel::MaximumIntensity;
  if (ofLargest)
  {
    this->Whole.Scalars.GetTexture(0)->Activate();
    program->SetUniformi("largestScalars", this->Whole.Scalars.GetTexture(0)->GetTextureUnit());
  }

  const std::vector<std::int32_t>& cells = scene.Volume->Mesh.GetMesh()->GetMesh().Cells;
  ProjectionSettings settings;
  settings.Width = scene.Grid.Width;
  settings.Height = scene.Grid.Height;
  settings.Interpolate = scene.Interpolate;
  // Corners are rounded to a grid that the driver tells, after they were rounded as they are sent.
  int subpixelBits = 4;
  glGetIntegerv(GL_SUBPIXEL_BITS, &subpixelBits);
  constexpr double PositionRounding = 1. / (1 << 21);
  settings.Margin =
    1. / (1 << subpixelBits) + PositionRounding * std::max(settings.Width, settings.Height);
  settings.Shift = FindShift(*scene.Frame, settings, scene.Points, cells);
  CellData data;
  data.Keys = scene.Dither;
  data.Ids = scene.Volume->Mesh.HasCellScalars();
  data.FaceScalars = scene.Volume->Optics.GetModel() == OpticalModel::Isosurfaces;
  if (shaded && scene.SmoothShading)
  {
    data.Gradients = CellData::Gradient::Points;
    data.PointGradients = scene.Volume->Mesh.GetPointGradients();
  }
  else if (shaded)
  {
    data.Gradients = CellData::Gradient::Cells;
    data.Coordinates = scene.Volume->Mesh.GetMesh()->GetMesh().Points;
  }

  const bool divided = pass == Pass::Colors && !this->Division.IsEmpty();
  data.Division = divided ? &this->Division : nullptr;
  data.FrontToBack = scene.FrontToBack;

  const std::size_t size = scene.Order.size();
  const auto project = [&](std::size_t begin)
  {
    ProjectCells(*scene.Frame, settings, scene.Points, cells,
      Span<const std::int32_t>(scene.Order.data() + begin, std::min(BatchSize, size - begin)), data,
      this->NextCells);
  };
  // One batch is projected while the last one is drawn.
  const TaskThread::Scope scope(this->Projecting);
  const auto begin = [&](std::size_t first)
  {
    if (first < size)
    {
      this->Projecting.Start([&project, first] { project(first); });
    }
  };
  Result result;
  PartQueue queue;
  begin(0);
  for (std::size_t first = 0; first < size && !result.Aborted; first += BatchSize)
  {
    const Stopwatch stopwatch;
    this->Projecting.Wait();
    std::swap(this->Cells, this->NextCells);
    begin(first + BatchSize);
    result.ProjectSeconds += stopwatch.GetSeconds();
    result.Cells += this->Cells.NumberOfTetrahedra;
    result.Parts += this->Cells.GetNumberOfCells();
    result.Triangles += static_cast<std::int64_t>(this->Cells.Triangles.size() / 3);
    for (std::int64_t part = 0; part < this->Cells.GetNumberOfParts(); ++part)
    {
      queue.MakeRoom();
      this->Drawer.Draw(this->Cells, part);
      queue.Add();
    }
    result.Aborted = progress &&
      !progress(static_cast<double>(std::min(first + BatchSize, size)) / static_cast<double>(size));
  }

  queue.Finish();

  if (ofLargest)
  {
    this->Whole.Scalars.GetTexture(0)->Deactivate();
  }
  if (scene.OpaqueDepth)
  {
    scene.OpaqueDepth->Deactivate();
  }
  integral.Deactivate();
  return result;
}

ProjectedCellDrawer::Shader ProjectionPicture::MakeShader(
  Pass pass, const ProjectionScene& scene) const
{
  ProjectedCellDrawer::Shader shader;
  std::string& defines = shader.Projection;
  const bool perspective = scene.Frame->IsPerspective();
  if (perspective)
  {
    defines += scene.Interpolate ? "#define PERSPECTIVE\n" : "#define LINEAR\n";
  }
  if (!scene.Planes.empty() || !scene.Cropping.empty() || scene.OpaqueDepth)
  {
    defines +=
      "#define LIMITED\n#define NUMBER_OF_LIMITS " + std::to_string(scene.Planes.size()) + "\n";
    defines += !scene.OpaqueDepth ? "" : "#define OPAQUE\n";
    defines += scene.Cropping.empty() ? "" : "#define CROPPED\n";
  }
  const OpticalModel model = scene.Volume->Optics.GetModel();
  const bool ofCells = scene.Volume->Mesh.HasCellScalars();
  const bool largest = model == OpticalModel::MaximumIntensity;
  const std::string cell = "int(cellData.x) * " + std::to_string(CellIdBase) + " + int(cellData.y)";
  shader.Segment = (pass == Pass::FirstDistances ? this->Pieces : this->Integral).GetDeclarations();
  defines += scene.Dither ? "#define KEYS\n" : "";
  defines += model == OpticalModel::Isosurfaces ? "#define SURFACES\n" : "";
  switch (pass)
  {
    case Pass::Colors:
      defines += model == OpticalModel::EmissionOnly
        ? "#define GATHER before + added\n"
        : "#define GATHER before + (1.0 - before.a) * added\n";
      defines += "#define NOTHING 0.0\n";
      if (scene.Lighting != Lighting::None)
      {
        defines += "#define SHADED\n";
        shader.Segment =
          this->Rays->GetDefines() + RayGridDec + this->Lighting.GetDeclarations() + shader.Segment;
        shader.Output = "Ray ray = GetRay(gl_FragCoord.xy);\n"
                        "  vec3 point = ray.Point + (begin / rayLengthUnit - ray.Distance) * "
                        "ray.Direction;\n"
                        "  return IntegrateShadedSegment(front, back, len, frontGradient, "
                        "backGradient, point, point + len / rayLengthUnit * ray.Direction, "
                        "ray.Direction);";
      }
      else
      {
        if (!this->Division.IsEmpty())
        {
          defines += "#define ONE_INTERVAL\n";
          defines += this->Integral.IsCurved() ? "#define CURVED_COLORS\n" : "";
          defines +=
            this->Division.HasSlices() ? "#define SLICES " + std::to_string(SliceBase) + "\n" : "";
          shader.Segment = this->Integral.GetPartDeclarations();
        }
        shader.Output = ofCells ? "return IntegrateCell(" + cell + ", len);"
                                : "return IntegrateSegment(front, back, len);";
      }
      break;
    case Pass::LargestScalars:
      defines += "#define GATHER max(before, added)\n#define NOTHING -Beyond\n";
      shader.Output =
        ofCells ? "return vec4(GetCellScalar(" + cell + "));" : "return vec4(max(front, back));";
      break;
    case Pass::FirstDistances:
      defines += "#define FIRST\n#define GATHER min(before, added)\n#define NOTHING Beyond\n";
      if (largest)
      {
        // The same sums as in the first pass have the same result.
        shader.Segment += "uniform sampler2D largestScalars;\n";
        shader.Output = "float largest = texelFetch(largestScalars, ivec2(gl_FragCoord.xy), 0).x;\n"
                        "  bool seen = ClassifyLargest(largest).a > 0.0;\n";
        shader.Output += ofCells
          ? "  float found = GetCellScalar(" + cell + ");\n  float share = 0.0;\n"
          : "  float found = max(front, back);\n  float share = front < back ? 1.0 : 0.0;\n";
        shader.Output += "  share = seen && found >= largest ? share : 2.0;\n";
      }
      else if (ofCells)
      {
        shader.Output = "float share = GetCellValue(" + cell + ").x > 0.0 ? 0.0 : 2.0;\n";
      }
      else
      {
        shader.Segment += model == OpticalModel::Isosurfaces ? FirstSurfaceDec : FirstPieceDec;
        shader.Output = "float share = FindFirst(front, back);\n";
      }
      shader.Output += "  return vec4(share > 1.0 ? Beyond : GetDistance(begin, share, len));";
      break;
  }
  if (pass == Pass::Colors && scene.Dither)
  {
    shader.Segment += AlphaDitherDec;
    shader.Dither = std::string("color = ") +
      (model == OpticalModel::EmissionOnly ? "DitherColor" : "DitherAlpha") +
      "(color, GetRandomNumber(gl_FragCoord.xy, key));";
  }
  return shader;
}

void ProjectionPicture::SetUniforms(vtkShaderProgram* program, const ProjectionScene& scene) const
{
  const RayGrid& grid = scene.Grid;
  const float size[2] = { static_cast<float>(grid.Width), static_cast<float>(grid.Height) };
  program->SetUniform2f("pictureSize", size);
  // Relative to the length of one of them, so that none leaves the range of single precision.
  const double unit = std::hypot(grid.Direction[0], grid.Direction[1], grid.Direction[2]);
  const auto setVector = [&](const char* name, const double vector[3])
  {
    float relative[3];
    for (int c = 0; c < 3; ++c)
    {
      relative[c] = static_cast<float>(vector[c] / unit);
    }
    program->SetUniform3f(name, relative);
  };
  setVector("rayDirection", grid.Direction);
  setVector("rayStepX", grid.DirectionStepX);
  setVector("rayStepY", grid.DirectionStepY);
  program->SetUniformf("depthUnit", static_cast<float>(unit * scene.Frame->GetDepthUnit()));

  constexpr double Half = 0.5; // from pixels to the coordinates of gl_FragCoord
  const float middle[2] = { static_cast<float>(scene.Frame->GetMiddle()[0] + Half),
    static_cast<float>(scene.Frame->GetMiddle()[1] + Half) };
  const auto setPlanes = [&](const char* name, const std::vector<ScreenPlane>& planes)
  {
    if (!planes.empty())
    {
      std::vector<float> values;
      for (const ScreenPlane& plane : planes)
      {
        values.insert(values.end(), { plane.X, plane.Y, plane.Constant, plane.Z });
      }
      program->SetUniform4fv(
        name, static_cast<int>(planes.size()), reinterpret_cast<const float(*)[4]>(values.data()));
    }
  };
  program->SetUniform2f("pictureMiddle", middle);
  setPlanes("limitPlanes", scene.Planes);
  setPlanes("croppingPlanes", scene.Cropping);
  program->SetUniformi("croppingFlags", static_cast<int>(scene.CroppingFlags));
}

/// Keeps cells out of pixels of depth 0, in the target that is drawn into.
void ProjectionPicture::CoverHidden(const ProjectionScene& scene)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  const GLfloat farthest = 1;
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LESS);
  state->vtkglDepthMask(GL_TRUE); // clearing, too, heeds it
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  std::string fragment = HiddenPixelsFS;
  vtkShaderProgram::Substitute(fragment, "//VTK::System::Dec", "#version 150\n");
  vtkShaderProgram* program = this->Hidden.Use(this->Context.Get(), "HiddenPixelsFS", fragment);
  scene.OpaqueDepth->Activate();
  program->SetUniformi("opaqueDepth", scene.OpaqueDepth->GetTextureUnit());
  state->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  this->Hidden.Draw();
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  scene.OpaqueDepth->Deactivate();
  state->vtkglDepthMask(GL_FALSE);
}

void ProjectionPicture::ClassifyLargest(Targets& targets)
{
  vtkOpenGLState* state = this->Context.Get()->GetState();
  const DrawingState drawing(state);
  const FloatTarget::Use use(targets.Colors);
  state->vtkglDisable(GL_BLEND);
  std::string fragment = LargestPictureFS;
  vtkShaderProgram::Substitute(fragment, "//VTK::Segment::Dec", this->Integral.GetDeclarations());
  vtkShaderProgram::Substitute(fragment, "//VTK::System::Dec", "#version 150\n");
  vtkShaderProgram* program =
    this->Classifier.Use(this->Context.Get(), "LargestPictureFS", fragment);
  this->Integral.Activate(program);
  vtkTextureObject* scalars = targets.Scalars.GetTexture(0);
  scalars->Activate();
  program->SetUniformi("largestScalars", scalars->GetTextureUnit());
  this->Classifier.Draw();
  scalars->Deactivate();
  this->Integral.Deactivate();
}

vtkTextureObject* ProjectionPicture::GetTexture() const { return this->Whole.Colors.GetTexture(0); }

void ProjectionPicture::ReadColors(const ProjectionScene& scene, Span<float> colors)
{
  (scene.Hides ? this->Apart : this->Whole).Colors.Read(0, colors);
}

void ProjectionPicture::ReadDistances(const ProjectionScene& scene, Span<float> depths)
{
  const vtkOpenGLState::ScopedglActiveTexture unit(this->Context.Get()->GetState());
  // A table does not tell where in a segment the function first contributes.
  SegmentSource source = MakeSegmentSource(*scene.Volume, Lighting::None);
  source.Integrator = IsTabulated(source.Integrator) ? Integrator::ClosedForm : source.Integrator;
  this->Pieces.Update(this->Context.Get(), source);
  this->Distances.Prepare(
    this->Context.Get(), MakeSettings(scene.Grid, 1, ChannelFormat::Float, false));
  this->DrawCells(Pass::FirstDistances, this->Distances, scene, {});
  this->Distances.Read(0, depths);
  for (float& depth : depths)
  {
    constexpr float None = -1;
    depth = depth < Beyond ? depth : None;
  }
}

std::size_t ProjectionPicture::GetNumberOfIntegralBytes() const
{
  return this->Integral.GetNumberOfBytes() + this->Pieces.GetNumberOfBytes();
}

std::size_t ProjectionPicture::GetNumberOfPictureBytes() const
{
  return this->Whole.Colors.GetNumberOfBytes() + this->Whole.Scalars.GetNumberOfBytes() +
    this->Apart.Colors.GetNumberOfBytes() + this->Apart.Scalars.GetNumberOfBytes() +
    this->Distances.GetNumberOfBytes();
}

} // namespace tetralux
