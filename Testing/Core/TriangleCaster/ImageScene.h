// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageScene_h
#define tetralux_ImageScene_h

#include "ReferenceImage.h"
#include "TriangleCaster/ImageCaster.h"

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace tetralux
{

/// All that makes a picture of image data: the triangle caster and the reference render it.
struct ImageScene
{
  std::array<int, 3> Dimensions = { 2, 2, 2 };
  ImageScalar Type = ImageScalar::Float;
  std::vector<unsigned char> Values;
  double Scale = 1;
  double Offset = 0;
  ImageOptics Optics;
  RayGrid Grid;
  RayLimits Limits;
  std::vector<float> MaximumDistances; ///< empty: none
  ImageCasterOptions Options;

  ImageVolume GetVolume() const;
  RayLimits GetLimits() const;
  ReferenceSlices GetSlices() const;
  int GetNumberOfPixels() const { return this->Grid.Width * this->Grid.Height; }

  /// Stores shares 0..1 of the range of the type, or with Float as they are.
  void SetValues(ImageScalar type, const std::vector<double>& shares);

  /// The same samples in extended precision, at threshold 0.
  std::vector<ReferencePixel> RenderReference() const;
};

/// Places a volume of these spacings in the world, oblique to its axes, its middle at a point, and
/// looks at it.
struct ImagePlacement
{
  std::array<double, 3> Spacing = { 1, 1, 1 }; ///< world units
  std::array<double, 3> Middle = { 0, 0, 0 };
  bool Oblique = true;

  enum Camera
  {
    Perspective,
    Parallel,
    Inside,    ///< perspective, of a wide angle
    OffAxis,   ///< a part of a perspective picture, beside its middle
    AlongAxis, ///< parallel, along the world's z
    NumberOfCameras
  };
  void Apply(ImageScene& scene, Camera camera, int width, int height) const;
};

struct CastPicture
{
  std::vector<float> Colors;
  std::vector<float> Depths;
  ImageCastStatistics Statistics;
};

CastPicture Cast(ImageCaster& caster, const ImageScene& scene);
CastPicture Cast(const ImageScene& scene);

/// Bit by bit.
bool IsSame(const CastPicture& a, const CastPicture& b);

/// The largest difference of a channel.
double FindDifference(const CastPicture& a, const CastPicture& b);

/// How a picture differs from the reference.
struct ImageDifference
{
  double Largest = 0; ///< of a channel
  int Visible = 0;    ///< pixels
  int Off = 0;        ///< pixels beyond ErrorOfMost
  int FarOff = 0;     ///< pixels beyond ErrorOfAll
  int DepthsOff = 0;  ///< pixels whose depth is that of another slab
};

/// Of a channel: rounding in single precision of a ray's samples.
constexpr double SampleRounding = 2e-5;
/// Of a channel: what most pixels are within, even where the function is steep.
constexpr double ErrorOfMost = 1e-4;
/// Of a channel: a step of a picture of 8 bits. No pixel is off by more, unless a sample is where
/// the function steps, or changes as much within the rounding of a scalar, or at an empty cell.
constexpr double ErrorOfAll = 1. / 255;

/// Fails where a picture of threshold 0 differs from the reference by more than its samples may be
/// off by in single precision.
ImageDifference ExpectReference(const ImageScene& scene, const CastPicture& picture);

/// Any scene: type, size, field, function, model, camera, placement, limits and options. Threshold
/// is 0.
ImageScene MakeRandomImageScene(std::mt19937_64& generator);

/// A smooth field of shares between 0 and 1, without symmetry, over a volume.
std::vector<double> MakeSmoothShares(const std::array<int, 3>& dimensions);

/// A smooth volume of 33 x 20 x 17 points seen in perspective, empty in part, and a function over
/// its scalars 0..1, of unit distance 1.
ImageScene MakeSmoothImageScene();

/// The same with a ball in a corner, around which there is nothing: slices of tiles are skipped.
ImageScene MakeBallImageScene();

} // namespace tetralux

#endif
