// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ProjectionPicture_h
#define tetralux_ProjectionPicture_h

#include "Base/Span.h"
#include "Base/TaskThread.h"
#include "GpuIntegral/GpuLighting.h"
#include "GpuIntegral/GpuSegmentIntegral.h"
#include "GpuIntegral/RayGridUniforms.h"
#include "GpuProjection/ProjectedCellDrawer.h"
#include "OpenGL/ContextResources.h"
#include "OpenGL/FloatTarget.h"
#include "OpenGL/ScreenProgram.h"
#include "Projection/ProjectedCells.h"
#include "Projection/ScreenFrame.h"
#include "View/RayGrid.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

class VolumeScene;

/// What a picture of projected cells is drawn from.
struct ProjectionScene
{
  const VolumeScene* Volume = nullptr; ///< with its longest edge, and gradients for smooth shading
  RayGrid Grid;
  std::shared_ptr<const ScreenFrame> Frame; ///< of Grid
  Span<const ScreenPoint> Points;           ///< of the mesh
  Span<const std::int32_t> Order;           ///< the cells that are drawn

  /// Front to back, opacities add up: also those that are too small for 1 - opacity to differ from
  /// 1. Back to front, rounding to few bits does less harm: what is in front is not rounded again.
  bool FrontToBack = true;
  bool Commutes = false; ///< what cells add, so that their order does not matter

  std::vector<ScreenPlane> Planes;   ///< rays are kept on their positive sides
  std::vector<ScreenPlane> Cropping; ///< xmin, xmax, ymin, ymax, zmin, zmax; empty: none
  std::uint32_t CroppingFlags = 0;
  vtkTextureObject* OpaqueDepth = nullptr; ///< of the window, 0..1; nullptr: none
  bool Hides = false;       ///< draws nothing where OpaqueDepth is 0, into a picture apart
  float OpaquePlaces[4][2]; ///< see ProjectedCellFS.glsl

  tetralux::Lighting Lighting = tetralux::Lighting::None; ///< by Lights
  bool SmoothShading = true; ///< by gradients interpolated between points; else those of cells
  std::vector<Light> Lights;
  Material Surface;
  LightSteps Steps;

  bool Interpolate = true; ///< with perspective correction
  ChannelFormat Format = ChannelFormat::Float;
  bool Dither = false; ///< for 8 bits: opacities, or colours where there is no absorption
};

/// Draws pictures of projected cells into textures of its own: colours as they come, and distances
/// to the first contribution where they are asked for. Belongs to one window's context, the last
/// one.
class ProjectionPicture
{
public:
  ProjectionPicture();
  ~ProjectionPicture();
  ProjectionPicture(const ProjectionPicture&) = delete;
  ProjectionPicture& operator=(const ProjectionPicture&) = delete;

  struct Result
  {
    bool Aborted = false;
    std::int64_t Cells = 0; ///< that cover any pixel's centre
    std::int64_t Parts = 0; ///< of these cells, as they are drawn
    std::int64_t Triangles = 0;
    const char* WhyWhole = nullptr; ///< why cells were drawn as they are; nullptr: in parts
    double DivideSeconds = 0;       ///< dividing cells by a new function
    double ProjectSeconds = 0;      ///< waiting for cells to be projected, on the processor
  };

  /// Divides the cells where that is to be done anew, draws the colours, the cells in batches, and
  /// waits until they are drawn. progress: told the share that is done, 0..1; the work ends where
  /// it returns false. Leaves OpenGL's state as it was. Throws std::runtime_error, with one line,
  /// where the graphics card or its driver can't.
  Result Draw(vtkOpenGLRenderWindow* window, const ProjectionScene& scene,
    const std::function<bool(double)>& progress);

  /// The colours, premultiplied, of the last scene that did not hide.
  vtkTextureObject* GetTexture() const;

  /// How segments were integrated.
  Integrator GetIntegrator() const { return this->Integral.GetIntegrator(); }

  /// scene: that of the last Draw, or the last one that did not hide, whose window's context is
  /// current.
  ///@{
  void ReadColors(const ProjectionScene& scene, Span<float> colors);
  /// The distances along the rays to the first contribution, -1 where there is none: those are
  /// drawn for that. Of a scene that does not hide.
  void ReadDistances(const ProjectionScene& scene, Span<float> depths);
  ///@}

  /// Bytes: of the cells that were projected last, for reuse, and how cells are divided; and on the
  /// graphics card of the largest part of them, of the functions of the integral, and of the
  /// pictures.
  ///@{
  std::size_t GetNumberOfCellBytes() const
  {
    return this->Cells.GetNumberOfBytes() + this->NextCells.GetNumberOfBytes() +
      this->Division.GetNumberOfBytes();
  }
  std::size_t GetNumberOfPartBytes() const { return this->Drawer.GetNumberOfBytes(); }
  std::size_t GetNumberOfIntegralBytes() const;
  std::size_t GetNumberOfPictureBytes() const;
  ///@}

  /// window: the one that goes away.
  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  enum class Pass
  {
    Colors,
    LargestScalars,
    FirstDistances
  };
  Result DrawPicture(const ProjectionScene& scene, const std::function<bool(double)>& progress);
  Result DrawCells(Pass pass, FloatTarget& target, const ProjectionScene& scene,
    const std::function<bool(double)>& progress);
  ProjectedCellDrawer::Shader MakeShader(Pass pass, const ProjectionScene& scene) const;
  /// Divides cells. whole: why they are drawn as they are, in plain words; nullptr: they are not.
  /// False after an abort.
  bool DivideCells(
    const ProjectionScene& scene, const std::function<bool(double)>& progress, const char*& whole);
  const char* WhyCellsAreWhole(const ProjectionScene& scene) const;
  void SetUniforms(vtkShaderProgram* program, const ProjectionScene& scene) const;
  /// What is drawn into.
  struct Targets
  {
    FloatTarget Colors;
    FloatTarget Scalars; ///< the largest ones along rays
  };
  void ClassifyLargest(Targets& targets);
  void CoverHidden(const ProjectionScene& scene);

  Targets Whole;
  Targets Apart; ///< of scenes that hide
  FloatTarget Distances;
  ProjectedCellDrawer Drawer;
  GpuSegmentIntegral Integral;
  GpuSegmentIntegral Pieces; ///< in closed form, for the distances
  GpuLighting Lighting;
  std::optional<RayGridUniforms> Rays; ///< where there is light
  ScreenProgram Classifier, Hidden;
  ProjectedCells Cells;     ///< that are drawn
  ProjectedCells NextCells; ///< that are projected meanwhile
  TaskThread Projecting;    ///< for NextCells
  CellDivision Division;    ///< empty: cells are drawn as they are
  CacheStamp DivisionStamp;
  ContextResources Context;
};

} // namespace tetralux

#endif
