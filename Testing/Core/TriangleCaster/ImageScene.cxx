// SPDX-License-Identifier: BSD-3-Clause
#include "ImageScene.h"

#include "ReferenceScenes.h"
#include "SampleFunctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

template <class Value>
void StoreShares(const std::vector<double>& shares, std::vector<unsigned char>& bytes)
{
  std::vector<Value> values;
  for (const double share : shares)
  {
    if constexpr (std::numeric_limits<Value>::is_integer)
    {
      const double low = std::numeric_limits<Value>::min();
      const double high = std::numeric_limits<Value>::max();
      values.push_back(static_cast<Value>(std::lround(low + share * (high - low))));
    }
    else
    {
      values.push_back(static_cast<Value>(share));
    }
  }
  bytes.resize(values.size() * sizeof(Value));
  std::memcpy(bytes.data(), values.data(), bytes.size());
}

/// The values of a volume of Float; of other types none.
std::vector<double> FindFloats(const ImageScene& scene)
{
  std::vector<double> floats;
  for (std::size_t at = 0; scene.Type == ImageScalar::Float && at < scene.Values.size();
       at += sizeof(float))
  {
    float value;
    std::memcpy(&value, &scene.Values[at], sizeof(float));
    floats.push_back(value);
  }
  return floats;
}

/// The largest number that a scalar is made of, or the function.
double FindLargestScalar(const ImageScene& scene)
{
  const double largestOfTypes[] = { 128, 255, 32768, 65535, 0 };
  double largest = largestOfTypes[static_cast<int>(scene.Type)];
  for (const double value : FindFloats(scene))
  {
    largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : largest;
  }
  largest = std::abs(scene.Scale) * largest + std::abs(scene.Offset);
  for (const TransferFunction::Node& node : scene.Optics.Function.Nodes)
  {
    largest = std::max(largest, std::abs(node.Scalar));
  }
  return largest;
}

/// Cells along an axis that a ray passes in a slab, about.
double FindCellsOfSlab(const ImageScene& scene)
{
  double most = 0;
  for (const double(&row)[4] : scene.Grid.MeshFromWorld)
  {
    most = std::max(most, std::hypot(row[0], row[1], row[2]));
  }
  return most * scene.Options.SampleDistance;
}

/// What the caster's samples may be off by.
ReferenceRounding FindRounding(const ImageScene& scene)
{
  // Single precision has 2^-24 of the way through 16 slabs, and three roundings of it; a scalar has
  // seven mixes and its map to the function. Parts begin and end in single precision of a slab.
  constexpr double Epsilon = 1. / (1 << 24);
  ReferenceRounding rounding;
  rounding.Position = 3 * Epsilon * (1 + 16 * FindCellsOfSlab(scene));
  rounding.Scalar = 10 * Epsilon * FindLargestScalar(scene);
  rounding.Length = 8 * Epsilon;
  return rounding;
}

/// What is not a number is larger than any.
double FindLarger(double a, double b) { return a <= b || std::isnan(b) ? b : a; }

Vector Mix(const Vector& a, const Vector& b, double share)
{
  Vector result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result[axis] = a[axis] + share * b[axis];
  }
  return result;
}

/// Shares without any order.
std::vector<double> MakeNoise(std::mt19937_64& generator, const std::array<int, 3>& dimensions)
{
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> shares(
    static_cast<std::size_t>(dimensions[0]) * dimensions[1] * dimensions[2]);
  std::generate(shares.begin(), shares.end(), [&] { return unit(generator); });
  return shares;
}

class SceneMaker
{
public:
  explicit SceneMaker(std::mt19937_64& generator)
    : Generator(generator)
  {
  }

  ImageScene Make()
  {
    ImageScene scene;
    this->MakeVolume(scene);
    this->MakeOptics(scene);
    const double worlds[] = { 1, 1, 1, 1, 1, 1, 1, 1, 1e-30, 1e30 };
    const double world = worlds[this->Below(std::size(worlds))];
    ImagePlacement placement;
    double shortest = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a)
    {
      placement.Spacing[a] = world * std::pow(10, this->Between(-0.4, 0.4));
      shortest = std::min(shortest, placement.Spacing[a]);
    }
    if (world == 1 && this->Chance(0.3))
    {
      placement.Middle = { 1e7, -0.7e7, 0.3e7 };
    }
    placement.Oblique = this->Chance(0.9);
    const auto camera =
      static_cast<ImagePlacement::Camera>(this->Below(ImagePlacement::NumberOfCameras));
    placement.Apply(
      scene, camera, 5 + static_cast<int>(this->Below(20)), 5 + static_cast<int>(this->Below(20)));
    scene.Optics.UnitDistance = shortest * std::pow(10, this->Between(-0.5, 1));
    scene.Options.SampleDistance = shortest * (this->Chance(0.1) ? 100 : this->Between(0.2, 1.5));
    this->MakeLimits(scene, placement);
    this->MakeOptions(scene.Options);
    return scene;
  }

private:
  std::size_t Below(std::size_t n) { return this->Generator() % n; }
  bool Chance(double p) { return this->Between(0, 1) < p; }
  double Between(double lo, double hi)
  {
    return std::uniform_real_distribution<double>(lo, hi)(this->Generator);
  }

  void MakeVolume(ImageScene& scene)
  {
    const std::array<int, 3> sizes[] = { { 2, 2, 2 }, { 9, 7, 5 }, { 33, 20, 17 }, { 2, 30, 3 },
      { 40, 2, 2 } };
    scene.Dimensions = sizes[this->Below(std::size(sizes))];
    std::vector<double> shares = this->Chance(0.5) ? MakeNoise(this->Generator, scene.Dimensions)
                                                   : MakeSmoothShares(scene.Dimensions);
    const auto type = static_cast<ImageScalar>(this->Below(5));
    this->Low = this->Between(-2, 1);
    this->Width = std::pow(10, this->Between(-1, 3));
    if (type == ImageScalar::Float && this->Chance(0.5))
    {
      for (double& share : shares)
      {
        share = this->Low + this->Width * share;
      }
      scene.SetValues(type, shares);
      return;
    }
    const double ends[5][2] = { { -128, 127 }, { 0, 255 }, { -32768, 32767 }, { 0, 65535 },
      { 0, 1 } };
    const double* end = ends[static_cast<int>(type)];
    const bool falls = this->Chance(0.3);
    scene.Scale = (falls ? -1 : 1) * this->Width / (end[1] - end[0]);
    scene.Offset = this->Low - scene.Scale * end[falls ? 1 : 0];
    scene.SetValues(type, shares);
  }

  void MakeOptics(ImageScene& scene)
  {
    scene.Optics.Opacity = this->Chance(0.5) ? StepOpacity::Power : StepOpacity::Attenuation;
    const double most = scene.Optics.Opacity == StepOpacity::Power
      ? this->Between(0.1, 0.95)
      : std::pow(10, this->Between(-1.5, 1));
    const int counts[] = { 1, 2, 3, 7, 8, 9, 15, 16, 17, 40, 300 };
    const int count = counts[this->Below(std::size(counts))];
    TransferFunction& function = scene.Optics.Function;
    function = MakeRandomFunction(this->Generator, std::max(count, 2), most, this->Chance(0.5));
    function.Nodes.resize(count);
    // From a little inside the range to a little outside.
    const double low = this->Low + this->Width * this->Between(-0.1, 0.4);
    const double high = this->Low + this->Width * this->Between(0.6, 1.1);
    for (TransferFunction::Node& node : function.Nodes)
    {
      node.Scalar = low + (high - low) * node.Scalar;
    }
  }

  void MakeLimits(ImageScene& scene, const ImagePlacement& placement)
  {
    double size = 0;
    for (int a = 0; a < 3; ++a)
    {
      size = std::hypot(size, (scene.Dimensions[a] - 1) * placement.Spacing[a]);
    }
    for (int planes = this->Chance(0.4) ? 1 + static_cast<int>(this->Below(2)) : 0; planes > 0;
         --planes)
    {
      Vector normal;
      double offset = 0.3 * size * this->Between(0, 1);
      for (int a = 0; a < 3; ++a)
      {
        normal[a] = this->Between(-1, 1);
        offset -= normal[a] * placement.Middle[a];
      }
      scene.Limits.Planes.push_back({ normal[0], normal[1], normal[2], offset });
    }
    if (this->Chance(0.4))
    {
      scene.Limits.Cropping = true;
      for (int a = 0; a < 3; ++a)
      {
        double* planes = scene.Limits.CroppingPlanes + 2 * a;
        const double last = scene.Dimensions[a] - 1;
        planes[0] = last * this->Between(-0.1, 0.8);
        planes[1] = this->Between(planes[0], 1.1 * last);
      }
      scene.Limits.CroppingFlags = static_cast<std::uint32_t>(this->Below(1u << 27));
    }
    if (this->Chance(0.3))
    {
      double middle = 0;
      for (int a = 0; a < 3; ++a)
      {
        middle = std::hypot(middle, placement.Middle[a] - scene.Grid.Origin[a]);
      }
      for (int p = 0; p < scene.GetNumberOfPixels(); ++p)
      {
        scene.MaximumDistances.push_back(this->Chance(0.1)
            ? std::numeric_limits<float>::infinity()
            : static_cast<float>(middle * this->Between(0.7, 1.3)));
      }
    }
  }

  void MakeOptions(ImageCasterOptions& options)
  {
    options.Shape = this->Chance(0.5) ? SliceShape::Planes : SliceShape::Shells;
    options.CorrectOpacity = this->Chance(0.7);
    options.Threshold = 0;
    options.EndTriangles = this->Chance(0.5);
    options.SkipPixels = this->Chance(0.5);
    options.SkipEmptySpace = this->Chance(0.5);
    const int sizes[] = { 4, 8, 16, 64 };
    options.TileSize = sizes[this->Below(std::size(sizes))];
    options.Triangles = this->Chance(0.5);
    options.NumberOfThreads = this->Chance(0.2) ? 3 : 1;
    options.PortableKernels = this->Chance(0.3);
    options.WideKernels = this->Chance(0.5);
  }

  std::mt19937_64& Generator;
  double Low = 0;   ///< of the scalars
  double Width = 1; ///< of the scalars
};

} // namespace

ImageVolume ImageScene::GetVolume() const
{
  ImageVolume volume;
  std::copy(this->Dimensions.begin(), this->Dimensions.end(), volume.Dimensions);
  volume.Type = this->Type;
  volume.Values = this->Values.data();
  volume.Scale = this->Scale;
  volume.Offset = this->Offset;
  return volume;
}

RayLimits ImageScene::GetLimits() const
{
  RayLimits limits = this->Limits;
  limits.MaximumDistances =
    this->MaximumDistances.empty() ? nullptr : this->MaximumDistances.data();
  return limits;
}

ReferenceSlices ImageScene::GetSlices() const
{
  ReferenceSlices slices;
  slices.Shape = this->Options.Shape;
  slices.Distance = this->Options.SampleDistance;
  slices.CorrectOpacity = this->Options.CorrectOpacity;
  return slices;
}

void ImageScene::SetValues(ImageScalar type, const std::vector<double>& shares)
{
  this->Type = type;
  switch (type)
  {
    case ImageScalar::Int8:
      StoreShares<std::int8_t>(shares, this->Values);
      break;
    case ImageScalar::UInt8:
      StoreShares<std::uint8_t>(shares, this->Values);
      break;
    case ImageScalar::Int16:
      StoreShares<std::int16_t>(shares, this->Values);
      break;
    case ImageScalar::UInt16:
      StoreShares<std::uint16_t>(shares, this->Values);
      break;
    case ImageScalar::Float:
      StoreShares<float>(shares, this->Values);
      break;
  }
}

std::vector<ReferencePixel> ImageScene::RenderReference() const
{
  return SampleReferenceImage(
    this->GetVolume(), this->Optics, this->Grid, this->GetLimits(), this->GetSlices());
}

void ImagePlacement::Apply(ImageScene& scene, Camera camera, int width, int height) const
{
  // An orthogonal matrix of no special angles.
  const double turns[3][3] = { { 9. / 11, -6. / 11, 2. / 11 }, { 6. / 11, 7. / 11, -6. / 11 },
    { 2. / 11, 6. / 11, 9. / 11 } };
  double worldFromMesh[3][4];
  double size = 0;
  for (int a = 0; a < 3; ++a)
  {
    worldFromMesh[a][3] = this->Middle[a];
    for (int b = 0; b < 3; ++b)
    {
      worldFromMesh[a][b] = this->Spacing[b] * (this->Oblique ? turns[a][b] : a == b ? 1 : 0);
      worldFromMesh[a][3] -= worldFromMesh[a][b] * 0.5 * (scene.Dimensions[b] - 1);
    }
    size = std::hypot(size, (scene.Dimensions[a] - 1) * this->Spacing[a]);
  }
  const Vector direction = { 0.61, 0.43, 0.67 };
  const Vector up = { 0.1, 1, 0.2 };
  const Vector eye = Mix(this->Middle, direction, 2 * size);
  switch (camera)
  {
    case Perspective:
      scene.Grid = MakePerspectiveGrid(eye, this->Middle, up, 28, width, height);
      break;
    case Parallel:
      scene.Grid = MakeParallelGrid(eye, this->Middle, up, 0.45 * size, width, height);
      break;
    case Inside:
      scene.Grid = MakePerspectiveGrid(
        Mix(this->Middle, direction, 0.02 * size), this->Middle, up, 100, width, height);
      break;
    case OffAxis:
      scene.Grid = MakeTile(
        MakePerspectiveGrid(eye, Mix(this->Middle, up, 0.6 * size), up, 70, 2 * width, 2 * height),
        width / 2, height / 3, width, height);
      break;
    default:
    {
      // Rays within faces of the volume would be inside or outside by rounding.
      const Vector front =
        Mix(this->Middle, { 0.137 * this->Spacing[0], 0.137 * this->Spacing[1], size }, 1);
      const Vector back = Mix(front, { 0, 0, 1 }, -size);
      scene.Grid =
        MakeParallelGrid(front, back, { 0, 1, 0 }, 0.3 * height * this->Spacing[1], width, height);
      break;
    }
  }
  PlaceMesh(scene.Grid, worldFromMesh);
}

CastPicture Cast(ImageCaster& caster, const ImageScene& scene)
{
  const std::size_t pixels = static_cast<std::size_t>(scene.GetNumberOfPixels());
  CastPicture picture;
  // Whatever is not written is noticed.
  picture.Colors.assign(4 * pixels, std::numeric_limits<float>::quiet_NaN());
  picture.Depths.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  picture.Statistics =
    caster.Cast(scene.Grid, scene.GetLimits(), scene.Options, picture.Colors, picture.Depths);
  return picture;
}

CastPicture Cast(const ImageScene& scene)
{
  ImageCaster caster;
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  return Cast(caster, scene);
}

bool IsSame(const CastPicture& a, const CastPicture& b)
{
  return a.Colors.size() == b.Colors.size() &&
    std::memcmp(a.Colors.data(), b.Colors.data(), a.Colors.size() * sizeof(float)) == 0 &&
    std::memcmp(a.Depths.data(), b.Depths.data(), a.Depths.size() * sizeof(float)) == 0;
}

double FindDifference(const CastPicture& a, const CastPicture& b)
{
  double largest = 0;
  for (std::size_t k = 0; k < a.Colors.size(); ++k)
  {
    largest = FindLarger(largest, std::abs(a.Colors[k] - b.Colors[k]));
  }
  return largest;
}

ImageDifference ExpectReference(const ImageScene& scene, const CastPicture& picture)
{
  constexpr double DepthRounding = 1e-6;
  const std::vector<ReferencePixel> reference = scene.RenderReference();
  ReferenceSlices slices = scene.GetSlices();
  slices.Rounding = FindRounding(scene);
  ImageDifference result;
  std::string wrong;
  for (int p = 0; p < scene.GetNumberOfPixels(); ++p)
  {
    const ReferencePixel& pixel = reference[p];
    const float* color = &picture.Colors[4 * static_cast<std::size_t>(p)];
    double difference = 0;
    for (int c = 0; c < 4; ++c)
    {
      difference = FindLarger(difference, std::abs(color[c] - pixel.Rgba[c]));
    }
    result.Visible += pixel.Rgba[3] > 0;
    result.Off += !(difference <= ErrorOfMost);
    result.FarOff += !(difference <= ErrorOfAll);
    result.Largest = FindLarger(result.Largest, difference);
    double doubt = 0;
    if (!(difference <= SampleRounding))
    {
      doubt = SampleReferenceRay(scene.GetVolume(), scene.Optics, scene.Grid, scene.GetLimits(),
        slices, p % scene.Grid.Width, p / scene.Grid.Width)
                .Doubt;
    }
    if (!(difference <= SampleRounding + doubt) && wrong.empty())
    {
      wrong = "pixel " + std::to_string(p % scene.Grid.Width) + ", " +
        std::to_string(p / scene.Grid.Width) + " is off by " + std::to_string(difference) +
        ", may be by " + std::to_string(doubt);
    }
    // Single precision, of the depth and of where in its slab the part begins.
    result.DepthsOff += !(std::abs(picture.Depths[p] - pixel.Depth) <=
      DepthRounding * (std::abs(pixel.Depth) + slices.Distance));
  }
  EXPECT_EQ(wrong, "");
  return result;
}

ImageScene MakeRandomImageScene(std::mt19937_64& generator) { return SceneMaker(generator).Make(); }

std::vector<double> MakeSmoothShares(const std::array<int, 3>& dimensions)
{
  std::vector<double> shares;
  for (int k = 0; k < dimensions[2]; ++k)
  {
    for (int j = 0; j < dimensions[1]; ++j)
    {
      for (int i = 0; i < dimensions[0]; ++i)
      {
        const double x = i / (dimensions[0] - 1.);
        const double y = j / (dimensions[1] - 1.);
        const double z = k / (dimensions[2] - 1.);
        shares.push_back(0.5 + 0.25 * std::sin(5 * x + 2 * y) * std::cos(4 * z - x) +
          0.25 * std::sin(3 * y + 7 * z * x));
      }
    }
  }
  return shares;
}

ImageScene MakeBallImageScene()
{
  ImageScene scene = MakeSmoothImageScene();
  std::vector<double> shares;
  for (int p = 0; p < 33 * 20 * 17; ++p)
  {
    shares.push_back(1 - std::hypot(p % 33 - 26., p / 33 % 20 - 14., p / 660 - 12.) / 6);
  }
  scene.SetValues(ImageScalar::Float, shares);
  scene.Options.SampleDistance = 0.3;
  return scene;
}

ImageScene MakeSmoothImageScene()
{
  ImageScene scene;
  scene.Dimensions = { 33, 20, 17 };
  scene.SetValues(ImageScalar::Float, MakeSmoothShares(scene.Dimensions));
  scene.Optics.Function =
    MakeLinearFunction({ { 0.45, 0, 0, 1, 0 }, { 0.6, 1, 0.5, 0.2, 0.1 }, { 0.9, 0, 1, 0, 0.6 } });
  ImagePlacement().Apply(scene, ImagePlacement::Perspective, 70, 41);
  scene.Options.SampleDistance = 0.75;
  scene.Options.Threshold = 0;
  return scene;
}

} // namespace tetralux
