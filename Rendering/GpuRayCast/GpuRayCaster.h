// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GpuRayCaster_h
#define tetralux_GpuRayCaster_h

#include "GpuRayCast/RayBands.h"
#include "GpuRayCast/RayPicture.h"
#include "GpuRayCast/RayTargets.h"
#include "OpenGL/ScreenProgram.h"
#include "TetraluxRenderingModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace tetralux
{

class GpuLighting;
class GpuRayLimits;
class GpuSegmentIntegral;
class WalkTextures;
struct PixelProjection;

/// How rays that left the mesh are to go on.
enum class GpuReentry
{
  None,     ///< they are done: the mesh is convex
  Boundary, ///< where they cross the boundary next
  Imaginary ///< they go on through imaginary cells, and are done where they leave those
};

struct GpuRayCastOptions
{
  GpuReentry Reentry = GpuReentry::Boundary;
  /// Whether the boundary's faces tell rays that come in from those that leave, see OrientCells.
  bool Oriented = true;
  std::int32_t NumberOfCells = 0;    ///< that are not imaginary
  std::int64_t NumberOfAllCells = 0; ///< with imaginary ones, see FindMostPasses
  bool CellData = false;
  bool LargestScalar = false;            ///< look for the largest scalar, instead of compositing
  const GpuLighting* Lighting = nullptr; ///< nullptr: nothing is lit
  bool SmoothGradients = false;          ///< light by gradients of points, see WalkTextures
  /// Entries are found by drawing the boundary, layer after layer, with this projection; nullptr:
  /// by the hierarchy. It has to be regular, and the faces oriented.
  const PixelProjection* Layers = nullptr;
  float MaximumOpacity = 1; ///< a ray that is this opaque is done; more than 1: never
  int StepsPerPass = 1;
  /// Of what rays keep between passes; the picture is cast in bands of rows where it is not enough.
  std::int64_t MaximumBytes = 0;
  bool CountFragments = false; ///< wait for the count of each pass, and count steps
  /// Called between passes, with the share of the rays that is known to be done, 0..1; returns
  /// false to abort.
  std::function<bool(double)> Continue;
};

struct GpuRayCastStatistics
{
  bool Aborted = false;
  int Bands = 0;
  int Passes = 0; ///< of all bands
  /// Rays that took part in each pass, as far as they are known; one band after the other.
  std::vector<std::int64_t> Fragments;
  std::int64_t Steps = 0; ///< of all rays through cells, where fragments are counted
  std::string Variant;    ///< of the shader that walks: its defines
};

/// The most passes that rays of so many parts can take through so many cells: each pass takes each
/// ray that is not done through one more cell at least, or to its next part. A ray walks through a
/// cell at most twice, to tell and to gather, and may start anew once, see RayWalkFS.glsl.
TETRALUXRENDERING_EXPORT std::int64_t FindMostPasses(std::int64_t cells, int parts);

/// Cell-to-cell ray casting on the graphics card (Weiler et al. 2003), see RayWalkFS.glsl: passes
/// of a bounded number of steps, each for the rays that are not done.
class TETRALUXRENDERING_EXPORT GpuRayCaster
{
public:
  /// Casts a picture of rays, whatever limits says of them. A band that the graphics card has no
  /// memory for is halved. Leaves OpenGL's state as it was. Throws std::runtime_error, with one
  /// line, where the graphics card lacks something, or where rays do not end.
  GpuRayCastStatistics Cast(vtkOpenGLRenderWindow* window, int width, int height,
    GpuRayLimits& limits, WalkTextures& mesh, GpuSegmentIntegral& integral,
    const GpuRayCastOptions& options);

  RayPicture& GetPicture() { return this->Picture; }

  std::size_t GetNumberOfBytes() const
  {
    return this->Targets.GetNumberOfBytes() + this->Picture.GetNumberOfBytes();
  }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  class Frame;

  void Prepare(
    vtkOpenGLRenderWindow* window, int width, int height, const GpuRayCastOptions& options);

  RayTargets Targets;
  RayPicture Picture;
  ScreenProgram Hidden, Entry, Layer, Walk, Done;
  RayBandRequest Request; ///< that RowsOfBand were found for
  int RowsOfBand = 0;
};

} // namespace tetralux

#endif
