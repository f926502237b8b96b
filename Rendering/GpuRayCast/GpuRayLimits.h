// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GpuRayLimits_h
#define tetralux_GpuRayLimits_h

#include "Base/Span.h"
#include "Frame/CameraRays.h"
#include "Frame/DrawnViewport.h"
#include "Frame/OpaqueDepth.h"
#include "GpuIntegral/RayGridUniforms.h"
#include "TetraluxRenderingModule.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <cstddef>
#include <optional>
#include <string>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace tetralux
{

/// Which parts of each ray count, in shaders; what a frame does not need is not compiled in.
///
///   Ray GetRay(vec2 pixel)
///
/// the ray through a pixel of the picture (gl_FragCoord.xy), relative to the mesh, see
/// RayGridDec.glsl.
///
///   vec2 GetRayPart(Ray ray, vec2 pixel, int part)
///
/// the distances from the ray's point, in units of GetRayLengthUnit, between which the part of that
/// number is, of NUMBER_OF_PARTS; begin above end where there is none. Parts do not overlap and go
/// front to back. They are single precision: within 1e-6 of the distances' size (of the mesh's
/// radius, where a camera is not within a thousandth of it from the edge of a plane).
class TETRALUXRENDERING_EXPORT GpuRayLimits
{
public:
  GpuRayLimits();
  ~GpuRayLimits();

  /// What lies behind opaque geometry is left out.
  struct OpaqueGeometry
  {
    DepthPlaces Places;       ///< of rays
    PixelRectangle Rectangle; ///< of the depth buffer that is bound for drawing, which is copied,
    Span<const float> Depths; ///< unless they are here, 0..1, one a ray
  };

  /// For one frame. grid: the rays, with MeshFromWorld. center and radius: see WalkMesh. limits: as
  /// rays of the CPU have them; MaximumDistances is not read. opaque: nullptr if there is none.
  /// Throws std::runtime_error, as OpaqueDepth does, and std::invalid_argument, as RayGridUniforms
  /// does.
  void Update(vtkOpenGLRenderWindow* window, const RayGrid& grid, const RayLimits& limits,
    const OpaqueGeometry* opaque, const double center[3], double radius);

  /// Whether a rectangle of the depth buffer that is bound for drawing holds what the last Update
  /// with opaque geometry found there. Throws as OpaqueDepth does.
  bool HasDepthOf(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle);

  /// Whether some rays may see nothing, as their depth is 0.
  bool MayHide() const { return this->Hides; }

  /// To be put into a shader before its own functions.
  std::string GetDeclarations() const;

  /// For a program that has the declarations and is in use.
  ///@{
  void Activate(vtkShaderProgram* program);
  void Deactivate();
  ///@}

  int GetNumberOfParts() const;
  bool AreRaysParallel() const { return this->Rays && this->Rays->AreParallel(); }

  std::size_t GetNumberOfBytes() const { return this->Depth.GetNumberOfBytes(); }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  std::optional<RayGridUniforms> Rays;
  OpaqueDepth Depth;
  bool Opaque = false;
  bool Hides = false;
  bool Cropping = false;
  float OpaquePixels[2];
  float OpaqueFar[3][4];
  float OpaqueNearer[4];
  float CroppingPlanes[2][3];
  int CroppingFlags = 0;
};

} // namespace tetralux

#endif
