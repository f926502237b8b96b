// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageCaster_h
#define tetralux_ImageCaster_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"
#include "TriangleCaster/ImageCasterOptions.h"
#include "TriangleCaster/ImageOptics.h"
#include "TriangleCaster/ImageVolume.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <cstdint>
#include <memory>
#include <string>

namespace tetralux
{

struct ImageCastStatistics
{
  bool Aborted = false;
  std::string InstructionSet;
  int NumberOfThreads = 0;
  std::int64_t Rays = 0;       ///< through the volume, but those of tiles that show nothing
  std::int64_t Slices = 0;     ///< planes or shells of the picture
  std::int64_t Triangles = 0;  ///< P-triangles that were cast
  std::int64_t Samples = 0;    ///< interpolated, over all rays
  double TerminationError = 0; ///< at most, by ending rays early
};

/// Image data in tiles (Knittel 1999): the picture is cut into S-triangles, and all slices of one
/// S-triangle are composited, front to back, before the next one begins, so that its pixels and its
/// part of the volume stay in the first-level cache. Tiles go over the threads of OpenMP; the
/// picture does not depend on the number of threads.
///
/// Keeps what it finds out about a volume: smallest and largest scalar of its blocks, and gradients
/// where options ask for stored ones.
class TETRALUXCORE_EXPORT ImageCaster
{
public:
  ImageCaster();
  ~ImageCaster();
  ImageCaster(const ImageCaster&) = delete;
  ImageCaster& operator=(const ImageCaster&) = delete;

  /// The volume that is cast. Its values are read in each Cast, so they must stay until then. To be
  /// called whenever a value, label or flag changed. Throws std::invalid_argument, with one line,
  /// if there are fewer than 2 points along an axis, or more than 2^31 - 1 values in all.
  void SetVolume(const ImageVolume& volume);

  /// Throws std::invalid_argument, with one line, if a function is not valid (MakeIntervalTable), a
  /// unit distance not above 0, a weight negative or LabelShare not within 0..1.
  void SetOptics(const ImageOptics& optics);

  /// Makes a picture. Throws std::invalid_argument, with one line, if the optics are not those of
  /// the volume's components. grid.MeshFromWorld and limits' cropping planes are in coordinates of
  /// the volume, that is in indices of its points.
  ///
  /// colors: four floats a pixel, premultiplied red, green, blue and opacity. depths: one float a
  /// pixel, the distance along the ray to the first slab that contributes, world units, or -1. Both
  /// have the lowest row first, and are incomplete after an abort.
  ImageCastStatistics Cast(const RayGrid& grid, const RayLimits& limits,
    const ImageCasterOptions& options, Span<float> colors, Span<float> depths);

private:
  class Internals;
  std::unique_ptr<Internals> Private;
};

} // namespace tetralux

#endif
