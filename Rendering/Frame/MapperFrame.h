// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MapperFrame_h
#define tetralux_MapperFrame_h

#include "Base/Cached.h"
#include "Base/Span.h"
#include "Frame/CameraRays.h"
#include "Frame/FrameSettings.h"
#include "Integral/ErrorBudget.h"
#include "Integral/Integrator.h"
#include "Optics/LightSteps.h"
#include "Optics/OpticalModel.h"
#include "Report/Json.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

class vtkAbstractMapper;
class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkVolume;
class vtkVolumeProperty;

namespace tetralux
{

class VolumeScene;

/// One frame of a mapper: what it is drawn from, and what it tells about itself. The mapper fills
/// the first part, its method the second.
struct MapperFrame
{
  FrameSettings Settings;
  double MaximumError = 1e-4;
  vtkRenderer* Renderer = nullptr;
  vtkVolume* Volume = nullptr;
  vtkVolumeProperty* Property = nullptr; ///< of the volume when the frame began
  vtkOpenGLRenderWindow* Window = nullptr;
  VolumeScene* Scene = nullptr; ///< complete; of mappers of cells alone
  vtkImageData* Image = nullptr;

  /// Whether isosurfaces, or what emits and absorbs, are lit, by what, and how they answer.
  bool Shaded = false;
  std::vector<Light> Lights;
  Material Surface;
  tetralux::Lighting GetLighting() const
  {
    return FindLighting(this->Shaded, this->Settings.SmoothShading, this->Lights);
  }

  /// Told how much of the drawing is done, 0..1; returns whether to go on. Empty: go on.
  std::function<bool(double)> Progress;
  bool ReportProgress(double fraction) const { return !this->Progress || this->Progress(fraction); }

  /// All that the picture follows from, but for what the depth buffer holds: what the mapper knows
  /// of it, then AddViewToKey.
  CacheKey Key;
  void AddViewToKey(const CameraRays& rays, const RayGrid& grid, const RayLimits& limits);

  bool HasPicture = false; ///< that of the last frame, which may be kept

  // What was drawn, for the statistics.

  std::string Method; ///< as the command line calls it
  bool Aborted = false;
  bool Kept = false; ///< composited as it is: the picture of the last frame has the same Key
  bool Final = true; ///< false: the next frame refines the picture, if nothing changes
  /// The picture is a mean that frames refine, which other rays would begin anew.
  bool IsMean = false;
  std::vector<std::pair<std::string, double>> Seconds; ///< of the stages of DrawFrame
  double RaySeconds = 0;                               ///< of what grows with the number of rays
  double FixedSeconds = 0;                             ///< of what each new view takes besides
  Integrator Integration = Integrator::ClosedForm;
  std::vector<std::pair<std::string, Json>> Sections; ///< of the mapper itself

  /// Bytes of what the mapper itself keeps, beside the scene. What is on the graphics card has
  /// names that begin with "card_"; in the memory of the process it is where OpenGL is software.
  std::vector<std::pair<std::string, std::size_t>> Memory;

  /// What the method spent of MaximumError.
  ErrorBudget Budget;

  /// How much brighter lights make what is lit, FindLargestBrightness: as much larger are errors of
  /// what they shine on.
  double Brightness = 1;

  /// Contributions to the largest error of a channel, absolute, 0..1; their sum is the estimate.
  std::vector<std::pair<std::string, double>> Errors;

  /// Error by rays that are coarser than pixels. It belongs to the estimate, but is asked for: no
  /// warning tells of it.
  double CoarseRaysError = 0;

  /// What the scene did not need, and why.
  Json LeftOut = Json::object();
  void ReportOmission(bool omitted, const char* feature, const char* reason);

  bool Opaque = false; ///< opaque geometry was drawn before and is honoured

  /// What the depth buffer is to hold of what is opaque, one a ray, 1 where nothing is; empty: it
  /// stays as it is. Of memory that the mapper keeps.
  Span<const float> WindowDepths;

  /// The colours of a picture that is opaque wherever WindowDepths is below 1, as the frame buffer
  /// holds them, 0..255; in place of those of Image, which ReadPicture fills. Else empty.
  Span<const std::uint8_t> WindowColors;

  /// Fills Image, if the picture is not read from the graphics card in each frame: called when
  /// somebody asks for the picture.
  std::function<void(vtkImageData*)> ReadPicture;

  /// The rays with the inverse of the volume's matrix. Throws std::invalid_argument, with one line,
  /// if it has none.
  RayGrid MakeGrid(const CameraRays& rays) const;

  /// Near and far plane, clipping planes and cropping; no opaque geometry.
  RayLimits MakeLimits(const CameraRays& rays) const;

  /// Whether the renderer allocates so little time that the frame belongs to an interaction.
  bool IsInteractive() const;

  /// Whether the depth buffer may hold geometry that rays have to end at.
  bool HasOpaqueGeometry() const;

  /// A picture in which nothing is, of one ray a pixel; without pixels for a tile that shows
  /// nothing of the viewport.
  void MakeEmptyPicture(const CameraRays& rays) const;

  /// The arrays RGBA, the scalars, and Depth of an image of this size, made where they are missing.
  static void PrepareImage(
    vtkImageData* image, int width, int height, Span<float>& colors, Span<float>& depths);
};

/// The clipping planes of a mapper, as FrameSettings has them.
std::vector<std::array<double, 4>> GetClippingPlanes(vtkAbstractMapper* mapper);

} // namespace tetralux

#endif
