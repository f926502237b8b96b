// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/GpuRayCaster.h"

#include "BoundaryEntryDec.h"
#include "BoundaryNodesDec.h"
#include "FirstPieceDec.h"
#include "FirstSurfaceDec.h"
#include "GpuIntegral/GpuLighting.h"
#include "GpuIntegral/GpuSegmentIntegral.h"
#include "GpuRayCast/GpuRayLimits.h"
#include "GpuRayCast/PixelProjection.h"
#include "GpuRayCast/WalkTextures.h"
#include "OpenGL/LoadedFunctions.h"
#include "RayDoneFS.h"
#include "RayEntryFS.h"
#include "RayFrameDec.h"
#include "RayHiddenFS.h"
#include "RayLayerFS.h"
#include "RayLayerVS.h"
#include "RayStatesDec.h"
#include "RayWalkFS.h"
#include "View/RayDisplacements.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <deque>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// Passes that may be under way before the count of an earlier one is waited for: so that the
/// graphics card never waits for the processor, and an abort not for long.
constexpr std::size_t PassesAhead = 2;

/// Of rays, the first one is none.
constexpr int NumberOfDisplacements = 1 + NumberOfRayDisplacements;
static_assert(NumberOfDisplacements <= RayTargets::MostDisplacements);

void SetDisplacements(vtkShaderProgram* program)
{
  float displacements[NumberOfDisplacements][2] = { { 0, 0 } };
  for (int k = 0; k < NumberOfRayDisplacements; ++k)
  {
    std::transform(RayDisplacements[k], RayDisplacements[k] + 2, displacements[k + 1],
      [](double x) { return static_cast<float>(x); });
  }
  program->SetUniform2fv("displacements", NumberOfDisplacements, displacements);
}

/// A program's source from its file.
std::string MakeSource(const char* file, const std::vector<std::string>& defines,
  const std::string& rays = {}, const std::string& integral = {}, const std::string& lighting = {},
  const std::string& firstContribution = {})
{
  std::string source = file;
  std::string system = "#version 150\n";
  // What RayFrameDec.glsl needs `precise` from, where there is any.
  system += "#extension GL_ARB_gpu_shader5 : enable\n";
  system += "#define NUMBER_OF_DISPLACEMENTS " + std::to_string(NumberOfDisplacements) + '\n';
  for (const std::string& define : defines)
  {
    system += "#define " + define + '\n';
  }
  vtkShaderProgram::Substitute(source, "//VTK::System::Dec", system);
  vtkShaderProgram::Substitute(source, "//VTK::RayStates::Dec", RayStatesDec);
  vtkShaderProgram::Substitute(source, "//VTK::GetRay::Dec", rays);
  vtkShaderProgram::Substitute(source, "//VTK::RayFrame::Dec", RayFrameDec);
  vtkShaderProgram::Substitute(source, "//VTK::BoundaryEntry::Dec", BoundaryEntryDec);
  vtkShaderProgram::Substitute(source, "//VTK::BoundaryNodes::Dec", BoundaryNodesDec);
  vtkShaderProgram::Substitute(source, "//VTK::Lighting::Dec", lighting);
  vtkShaderProgram::Substitute(source, "//VTK::RayIntegral::Dec", integral);
  vtkShaderProgram::Substitute(source, "//VTK::FirstContribution::Dec", firstContribution);
  return source;
}

/// Counts of the pixels that passes drew, as far as they are known without waiting.
class PassCounts
{
public:
  explicit PassCounts(std::vector<std::int64_t>& counts)
    : Counts(counts)
  {
  }
  ~PassCounts()
  {
    for (const GLuint query : this->Waiting)
    {
      glDeleteQueries(1, &query);
    }
  }
  PassCounts(const PassCounts&) = delete;
  PassCounts& operator=(const PassCounts&) = delete;

  void Begin()
  {
    GLuint query = 0;
    glGenQueries(1, &query);
    this->Waiting.push_back(query);
    glBeginQuery(GL_SAMPLES_PASSED, query);
  }
  void End() { glEndQuery(GL_SAMPLES_PASSED); }

  /// Takes the counts that are there, and waits for those before the last `ahead` passes; true
  /// where a pass drew nothing.
  bool Take(std::size_t ahead)
  {
    while (!this->Waiting.empty())
    {
      const GLuint query = this->Waiting.front();
      GLuint available = GL_TRUE;
      if (this->Waiting.size() <= ahead)
      {
        glGetQueryObjectuiv(query, GL_QUERY_RESULT_AVAILABLE, &available);
      }
      if (!available)
      {
        return false;
      }
      GLuint count = 0;
      glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
      glDeleteQueries(1, &query);
      this->Waiting.pop_front();
      if (count == 0)
      {
        return true;
      }
      this->Counts.push_back(count);
    }
    return false;
  }

private:
  std::vector<std::int64_t>& Counts;
  std::deque<GLuint> Waiting;
};

/// A texture bound to a unit while a program draws.
class ActiveTexture
{
public:
  ActiveTexture(vtkShaderProgram* program, const char* sampler, vtkTextureObject* texture)
    : Texture(texture)
  {
    texture->Activate();
    program->SetUniformi(sampler, texture->GetTextureUnit());
  }
  ~ActiveTexture() { this->Texture->Deactivate(); }
  ActiveTexture(const ActiveTexture&) = delete;
  ActiveTexture& operator=(const ActiveTexture&) = delete;

private:
  vtkTextureObject* Texture;
};

} // namespace

//------------------------------------------------------------------------------------------------
std::int64_t FindMostPasses(std::int64_t cells, int parts)
{
  constexpr std::int64_t Walks = 2;
  constexpr std::int64_t Starts = 2;
  // The last pass of a ray finds out that it is done, and counts are known some passes later.
  constexpr auto Spare = static_cast<std::int64_t>(PassesAhead) + 2;
  return Starts * parts * (Walks * cells + 1) + Spare;
}

//------------------------------------------------------------------------------------------------
// The passes of one frame. What it changes of OpenGL's state is set back when it ends.
class GpuRayCaster::Frame
{
public:
  Frame(GpuRayCaster& self, vtkOpenGLRenderWindow* window, GpuRayLimits& limits, WalkTextures& mesh,
    GpuSegmentIntegral& integral, const GpuRayCastOptions& options)
    : Self(self)
    , Window(window)
    , State(window->GetState())
    , Limits(limits)
    , Mesh(mesh)
    , Integral(integral)
    , Options(options)
    , Unit(State)
    , Blend(State, GL_BLEND)
    , DepthTest(State, GL_DEPTH_TEST)
    , CullFace(State, GL_CULL_FACE)
    , Scissor(State, GL_SCISSOR_TEST)
    , Stencil(State, GL_STENCIL_TEST)
    , DepthMask(State)
    , DepthFunction(State)
    , BlendFunction(State)
    , ColorMask(State)
  {
    for (const unsigned int capability :
      { GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST })
    {
      this->State->vtkglDisable(capability);
    }
    this->State->vtkglEnable(GL_DEPTH_TEST);
    this->State->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    this->State->vtkglDepthMask(GL_TRUE);
    self.Targets.BeginDrawing();
  }
  ~Frame()
  {
    this->Deactivate();
    this->Self.Targets.EndDrawing();
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  GpuRayCastStatistics Draw()
  {
    GpuRayCastStatistics statistics;
    for (const std::string& name : this->GetWalkDefines())
    {
      statistics.Variant += (statistics.Variant.empty() ? "" : " ") + name;
    }
    RayPicture& picture = this->Self.Picture;
    statistics.Bands = picture.GetNumberOfBands();
    for (this->Band = 0; this->Band < statistics.Bands && !statistics.Aborted; ++this->Band)
    {
      this->Self.Targets.SetBand(picture.GetBand(this->Band));
      this->DrawBand(statistics);
    }
    if (!statistics.Aborted)
    {
      statistics.Steps = this->Options.CountFragments ? picture.CountSteps() : 0;
    }
    return statistics;
  }

private:
  const FloatTarget::Settings& GetBandSettings() const
  {
    return this->Self.Picture.GetBand(this->Band).GetSettings();
  }

  /// Of the picture, where a share of the band is done.
  double FindShare(double ofBand) const
  {
    const RayPicture& picture = this->Self.Picture;
    return (picture.GetFirstRow(this->Band) + ofBand * this->GetBandSettings().Height) /
      picture.GetHeight();
  }

  void DrawBand(GpuRayCastStatistics& statistics)
  {
    this->State->vtkglDepthMask(GL_TRUE); // clearing, too, heeds it
    this->Self.Targets.Clear(this->Options.LargestScalar);
    if (this->Limits.MayHide())
    {
      this->CoverHidden();
    }
    std::vector<std::int64_t> fragments;
    PassCounts counts(fragments);
    const int parts = this->Limits.GetNumberOfParts();
    const std::int64_t most = FindMostPasses(this->Options.NumberOfAllCells, parts);
    for (std::int64_t pass = 0;; ++pass)
    {
      if (pass == most)
      {
        throw std::runtime_error("rays on the graphics card do not end: " + std::to_string(most) +
          " passes are the most that a mesh of " + std::to_string(this->Options.NumberOfAllCells) +
          " tetrahedra needs");
      }
      const int from = static_cast<int>(pass % 2);
      if (pass == 0 || this->EntersAgain() || (pass == 1 && this->MayBeDisplaced()))
      {
        if (this->Options.Layers)
        {
          this->DrawLayer(from);
        }
        else
        {
          this->FindEntries(from);
        }
      }
      this->FinishDone(from);
      counts.Begin();
      this->WalkOn(from);
      counts.End();
      glFlush();
      ++statistics.Passes;
      if (counts.Take(this->Options.CountFragments ? 0 : PassesAhead))
      {
        break;
      }
      const double running = fragments.empty()
        ? 1
        : static_cast<double>(fragments.back()) / static_cast<double>(fragments.front());
      if (this->Options.Continue && !this->Options.Continue(this->FindShare(1 - running)))
      {
        statistics.Aborted = true;
        break;
      }
    }
    statistics.Fragments.insert(statistics.Fragments.end(), fragments.begin(), fragments.end());
  }

  void Deactivate()
  {
    this->Limits.Deactivate();
    this->Mesh.Deactivate();
    this->Integral.Deactivate();
  }

  bool MayEnterAgain() const { return this->Options.Reentry == GpuReentry::Boundary; }

  /// Where nothing touches the boundary, only parallel rays in a side of the mesh: see RayAcross.h.
  bool MayBeDisplaced() const { return this->MayEnterAgain() || this->Limits.AreRaysParallel(); }

  /// Of a part of a ray, or the next one.
  bool EntersAgain() const { return this->MayEnterAgain() || this->Limits.GetNumberOfParts() > 1; }

  /// What finds the place of the first contribution in a segment; empty where there is no place.
  std::string GetFirstContribution() const
  {
    const Integrator integrator = this->Integral.GetIntegrator();
    if (this->Options.CellData || IsTabulated(integrator) || integrator == Integrator::Maximum)
    {
      return {};
    }
    return integrator == Integrator::Isosurfaces ? FirstSurfaceDec : FirstPieceDec;
  }

  std::vector<std::string> GetEntryDefines() const
  {
    std::vector<std::string> names;
    if (this->MayBeDisplaced())
    {
      names.emplace_back("DISPLACES");
    }
    if (this->MayEnterAgain() && this->Options.Oriented)
    {
      names.emplace_back("DIRECTED");
    }
    return names;
  }

  std::string GetLighting() const
  {
    return this->Options.Lighting ? this->Options.Lighting->GetDeclarations() : std::string();
  }

  std::vector<std::string> GetWalkDefines() const
  {
    std::vector<std::string> names;
    const auto define = [&names](bool defined, const char* name)
    {
      if (defined)
      {
        names.emplace_back(name);
      }
    };
    define(this->Options.CellData, "CELL_DATA");
    define(this->Options.LargestScalar, "GATHER_LARGEST");
    define(this->Options.Reentry == GpuReentry::Imaginary, "IMAGINARY_CELLS");
    define(this->MayEnterAgain(), "REENTRY");
    define(this->MayEnterAgain() && !this->Options.Oriented, "PAIRED");
    const bool lit = this->Options.Lighting != nullptr;
    define(lit, "LIT");
    define(lit && this->Options.SmoothGradients, "SMOOTH_GRADIENTS");
    define(this->Integral.GetIntegrator() == Integrator::Isosurfaces, "ISOSURFACES");
    define(!this->GetFirstContribution().empty(), "FIND_FIRST");
    define(this->Options.CountFragments, "COUNT_STEPS");
    return names;
  }

  /// Leaves pixels alone that are covered: they have depth 0, others 1, and so has what is drawn.
  void TestDepth()
  {
    this->State->vtkglDepthFunc(GL_LEQUAL);
    this->State->vtkglDepthMask(GL_FALSE);
  }

  /// For programs that read states.
  void SetBand(vtkShaderProgram* program)
  {
    program->SetUniformf(
      "firstRow", static_cast<float>(this->Self.Picture.GetFirstRow(this->Band)));
  }

  void CoverHidden()
  {
    vtkShaderProgram* program = this->Self.Hidden.Use(
      this->Window, "RayHiddenFS", MakeSource(RayHiddenFS, {}, this->Limits.GetDeclarations()));
    this->SetBand(program);
    this->Limits.Activate(program);
    this->Self.Targets.DrawInto(RayTargets::OfColors);
    this->State->vtkglDepthFunc(GL_LESS);
    const vtkOpenGLState::ScopedglColorMask mask(this->State);
    this->State->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    this->Self.Hidden.Draw();
    this->Deactivate();
  }

  void FindEntries(int from)
  {
    RayTargets& targets = this->Self.Targets;
    vtkShaderProgram* program = this->Self.Entry.Use(this->Window, "RayEntryFS",
      MakeSource(RayEntryFS, this->GetEntryDefines(), this->Limits.GetDeclarations()));
    this->SetBand(program);
    this->Limits.Activate(program);
    this->Mesh.ActivateForEntry(program);
    SetDisplacements(program);
    const ActiveTexture states(program, "rayStates", targets.GetTexture(from, RayTargets::States));
    targets.DrawInto(RayTargets::OfNextEntries);
    this->TestDepth();
    this->Self.Entry.Draw();
    this->Deactivate();
  }

  void DrawLayer(int from)
  {
    RayTargets& targets = this->Self.Targets;
    this->State->vtkglDepthMask(GL_TRUE); // clearing, too, heeds it
    targets.ClearLayer();
    vtkShaderProgram* program = this->Self.Layer.Use(this->Window, "RayLayerFS",
      MakeSource(RayLayerFS, this->GetEntryDefines(), this->Limits.GetDeclarations()),
      MakeSource(RayLayerVS, {}));
    this->SetBand(program);
    this->Limits.Activate(program);
    this->Mesh.ActivateForEntry(program);
    float rows[3][4];
    for (int row = 0; row < 3; ++row)
    {
      std::transform(this->Options.Layers->Rows[row], this->Options.Layers->Rows[row] + 4,
        rows[row], [](double x) { return static_cast<float>(x); });
    }
    program->SetUniform4fv("pixelFromRay", 3, rows);
    const FloatTarget::Settings& band = this->GetBandSettings();
    const float size[2] = { static_cast<float>(band.Width), static_cast<float>(band.Height) };
    program->SetUniform2f("bandSize", size);
    SetDisplacements(program);
    const ActiveTexture states(program, "rayStates", targets.GetTexture(from, RayTargets::States));
    targets.DrawInto(RayTargets::OfLayer);
    this->State->vtkglDepthFunc(GL_LESS);
    constexpr int VerticesOfEntry = 6;
    this->Self.Layer.Draw(VerticesOfEntry * this->Mesh.GetNumberOfEntries());
    this->Deactivate();
  }

  void FinishDone(int from)
  {
    RayTargets& targets = this->Self.Targets;
    const bool largest = this->Options.LargestScalar;
    std::vector<std::string> defines = { "NUMBER_OF_PARTS " +
      std::to_string(this->Limits.GetNumberOfParts()) };
    if (largest)
    {
      defines.emplace_back("GATHER_LARGEST");
    }
    vtkShaderProgram* program = this->Self.Done.Use(this->Window, "RayDoneFS",
      MakeSource(
        RayDoneFS, defines, {}, largest ? this->Integral.GetDeclarations() : std::string()));
    if (largest)
    {
      this->Integral.Activate(program);
    }
    const ActiveTexture states(program, "rayStates", targets.GetTexture(from, RayTargets::States));
    const ActiveTexture sums(program, "raySums", targets.GetTexture(from, RayTargets::Sums));
    const ActiveTexture next(program, "nextEntries", targets.GetNextEntries());
    targets.DrawInto(RayTargets::OfColors);
    this->State->vtkglDepthFunc(GL_LESS);
    this->State->vtkglDepthMask(GL_TRUE);
    const vtkOpenGLState::ScopedglColorMask mask(this->State);
    this->State->vtkglColorMask(largest, largest, largest, GL_TRUE);
    this->Self.Done.Draw();
    this->Deactivate();
  }

  void WalkOn(int from)
  {
    RayTargets& targets = this->Self.Targets;
    vtkShaderProgram* program = this->Self.Walk.Use(this->Window, "RayWalkFS",
      MakeSource(RayWalkFS, this->GetWalkDefines(), this->Limits.GetDeclarations(),
        this->Integral.GetDeclarations(), this->GetLighting(), this->GetFirstContribution()));
    this->SetBand(program);
    this->Limits.Activate(program);
    program->SetUniformi("numberOfCells", this->Options.NumberOfCells);
    program->SetUniformi("stepsOfPass", this->Options.StepsPerPass);
    program->SetUniformf("maximumOpacity", this->Options.MaximumOpacity);
    this->Mesh.ActivateForWalk(program, this->Options.Lighting && this->Options.SmoothGradients);
    if (this->Options.Lighting)
    {
      this->Options.Lighting->Set(program);
    }
    this->Integral.Activate(program);
    SetDisplacements(program);
    const ActiveTexture states(program, "rayStates", targets.GetTexture(from, RayTargets::States));
    const ActiveTexture sums(program, "raySums", targets.GetTexture(from, RayTargets::Sums));
    const ActiveTexture next(program, "nextEntries", targets.GetNextEntries());
    targets.DrawInto(1 - from);
    this->TestDepth();
    targets.BeginAdding();
    this->Self.Walk.Draw();
    targets.EndAdding();
    this->Deactivate();
  }

  GpuRayCaster& Self;
  vtkOpenGLRenderWindow* Window;
  vtkOpenGLState* State;
  GpuRayLimits& Limits;
  WalkTextures& Mesh;
  GpuSegmentIntegral& Integral;
  const GpuRayCastOptions& Options;
  int Band = 0; ///< that is drawn

  vtkOpenGLState::ScopedglActiveTexture Unit;
  vtkOpenGLState::ScopedglEnableDisable Blend, DepthTest, CullFace, Scissor, Stencil;
  vtkOpenGLState::ScopedglDepthMask DepthMask;
  vtkOpenGLState::ScopedglDepthFunc DepthFunction;
  vtkOpenGLState::ScopedglBlendFuncSeparate BlendFunction;
  vtkOpenGLState::ScopedglColorMask ColorMask;
};

//------------------------------------------------------------------------------------------------
void GpuRayCaster::Prepare(
  vtkOpenGLRenderWindow* window, int width, int height, const GpuRayCastOptions& options)
{
  const bool layers = options.Layers != nullptr;
  int largestTexture = 0;
  int largestViewport[2] = { 0, 0 };
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largestTexture);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, largestViewport);
  RayBandRequest request;
  request.Width = width;
  request.Height = height;
  request.BytesPerPixel = static_cast<std::int64_t>(RayTargets::GetPixelSize(layers));
  request.MaximumBytes = options.MaximumBytes;
  request.LargestSize = std::min({ largestTexture, largestViewport[0], largestViewport[1] });
  if (this->RowsOfBand == 0 || !(request == this->Request))
  {
    this->RowsOfBand = FindRowsOfBand(request);
    this->Request = request;
  }
  this->RowsOfBand = HalveRowsUntilMade(this->RowsOfBand,
    [&](int rows)
    {
      this->Targets.Prepare(window, width, rows, layers);
      this->Picture.Prepare(window, width, height, rows, options.CountFragments);
    });
}

//------------------------------------------------------------------------------------------------
GpuRayCastStatistics GpuRayCaster::Cast(vtkOpenGLRenderWindow* window, int width, int height,
  GpuRayLimits& limits, WalkTextures& mesh, GpuSegmentIntegral& integral,
  const GpuRayCastOptions& options)
{
  this->Prepare(window, width, height, options);
  Frame frame(*this, window, limits, mesh, integral, options);
  return frame.Draw();
}

void GpuRayCaster::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Targets.ReleaseGraphicsResources(window);
  this->Picture.ReleaseGraphicsResources(window);
  this->RowsOfBand = 0;
  for (ScreenProgram* program :
    { &this->Hidden, &this->Entry, &this->Layer, &this->Walk, &this->Done })
  {
    program->ReleaseGraphicsResources(window);
  }
}

} // namespace tetralux
