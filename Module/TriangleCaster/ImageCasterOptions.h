// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageCasterOptions_h
#define tetralux_ImageCasterOptions_h

#include "Optics/OpticalModel.h"
#include "TriangleCaster/SlicePlanes.h"

#include <functional>
#include <optional>
#include <vector>

namespace tetralux
{

struct HullDepths;

/// Where gradients come from (Knittel 1999, section 7).
enum class GradientSource
{
  OnTheFly, ///< differences of values, for each sample
  Bytes     ///< stored at the points of the volume, 8 bits a component, 4 bytes a point
};

/// How lights are summed up (section 7).
enum class LightSum
{
  Direct,       ///< for each sample
  NearestEntry, ///< once for each direction of a map of 5 bits; distant lights only
  Interpolated  ///< between four directions of that map
};

struct ImageCasterOptions
{
  double SampleDistance = 1; ///< from slice to slice, world units, above 0
  SliceShape Shape = SliceShape::Planes;

  /// The box that slices are laid through, where the volume is a part of it: parts then have the
  /// slices of the whole. None: the volume's own.
  std::optional<IndexBox> Whole;

  /// Whether a sample's opacity is that of its own ray's step. Else it is that of the step of a ray
  /// along the normal of the planes (section 1.1).
  bool CorrectOpacity = true;

  /// Whether what is between two slices comes from a table over the scalars at both (SlabTable.h),
  /// so that thin features of the transfer function are not missed. ImageBlend::Composite only. Not
  /// with Shaded, nor where opacity depends on gradients.
  bool PreIntegrated = false;

  /// Whether lights shine on samples, or on isosurfaces, from the side of the viewer, by gradients
  /// as normals: ambient and diffuse light times the colour, and Blinn's highlights. What is lit is
  /// not clamped. ImageBlend::Composite and Isosurfaces only.
  bool Shaded = false;
  std::vector<Light> Lights;
  Material Surface;
  LightSum SumOfLights = LightSum::Direct;

  GradientSource Gradients = GradientSource::OnTheFly;

  /// Depth cueing (section 2.2): factors of the colours, red, green and blue, at the front and at
  /// the back of the volume, or at the camera where that is inside. Linear in the depth of
  /// SlicePlanes; finite. ImageBlend::Composite only.
  ///@{
  float NearColor[3] = { 1, 1, 1 };
  float FarColor[3] = { 1, 1, 1 };
  ///@}

  /// A pixel is opaque when its translucency is below this, 0..1 (section 3.2).
  double Threshold = 1. / 255;
  bool EndTriangles = true; ///< TT: an S-triangle ends when all its pixels are opaque
  bool SkipPixels = true;   ///< OP: opaque pixels of others are not sampled any more

  /// Whether slices of an S-triangle are left out that meet nothing visible, by ranges of scalars
  /// in blocks of cells.
  bool SkipEmptySpace = true;

  /// The same by the hulls of what is visible (section 2.1), of tiles of TileSize: what is in front
  /// of them and behind them is left out. nullptr: nothing is. It costs more than it brings beside
  /// SkipEmptySpace, which knows what is empty inside, too. ImageBlend::Composite and Additive
  /// only: others depend on what is transparent.
  const HullDepths* Hulls = nullptr;

  /// Tiles are squares of this many pixels, 4 to 64.
  int TileSize = 8;
  bool Triangles = false; ///< tiles are cast in two triangles; else as they are

  int NumberOfThreads = 0; ///< 0: as many as OpenMP offers

  /// Use the kernels that run on any processor even where there are faster ones; the pictures
  /// differ by rounding. For tests of those kernels.
  bool PortableKernels = false;

  /// Use the kernels of 16 lanes where HasFastWideLanes() (InstructionSet.h), and samples are
  /// composited by a function of their scalar alone. The pictures are the same bits. For tests of
  /// the others.
  bool WideKernels = true;

  /// As in RayCastOptions. May be empty.
  std::function<bool(double)> Progress;
};

} // namespace tetralux

#endif
