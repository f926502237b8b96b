// SPDX-License-Identifier: BSD-3-Clause
// Blend modes of the triangle caster: against plain loops in double precision, and closed forms.
#include "Optics/IntervalTable.h"
#include "TriangleCaster/ImageCaster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

constexpr std::array<ImageBlend, 6> Blends = { ImageBlend::MaximumIntensity,
  ImageBlend::MinimumIntensity, ImageBlend::AverageIntensity, ImageBlend::Additive,
  ImageBlend::Isosurfaces, ImageBlend::Slice };

const char* GetName(ImageBlend blend)
{
  const char* const names[] = { "composite", "maximum", "minimum", "average", "additive",
    "isosurfaces", "slice" };
  return names[static_cast<int>(blend)];
}

/// Values in the bytes of their type.
std::vector<std::uint8_t> Pack(const std::vector<float>& values, ImageScalar type)
{
  std::vector<std::uint8_t> bytes(values.size() * GetSize(type));
  const auto fill = [&](auto zero)
  {
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const auto value = static_cast<decltype(zero)>(values[i]);
      std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
    }
  };
  switch (type)
  {
    case ImageScalar::Int8:
      fill(std::int8_t());
      break;
    case ImageScalar::UInt8:
      fill(std::uint8_t());
      break;
    case ImageScalar::Int16:
      fill(std::int16_t());
      break;
    case ImageScalar::UInt16:
      fill(std::uint16_t());
      break;
    case ImageScalar::Float:
      fill(0.f);
      break;
  }
  return bytes;
}

/// Everything that a picture is made of. Values are whole numbers of 0..100 unless a test changes
/// them, and scalars are the same.
struct Scene
{
  std::array<int, 3> Dimensions{};
  std::vector<float> Values; ///< as ImageVolume has them
  std::vector<unsigned char> PointFlags, Mask;
  ImageScalar Type = ImageScalar::Float;
  double Scale = 1;
  double Offset = 0;
  ImageOptics Optics;
  RayGrid Grid;
  RayLimits Limits;
  std::vector<float> MaximumDistances;
  ImageCasterOptions Options;

  float& At(int i, int j, int k)
  {
    return this
      ->Values[(static_cast<std::size_t>(k) * this->Dimensions[1] + j) * this->Dimensions[0] + i];
  }

  void Fill(const std::function<double(int, int, int)>& value)
  {
    this->Values.assign(
      static_cast<std::size_t>(this->Dimensions[0]) * this->Dimensions[1] * this->Dimensions[2], 0);
    for (int k = 0; k < this->Dimensions[2]; ++k)
    {
      for (int j = 0; j < this->Dimensions[1]; ++j)
      {
        for (int i = 0; i < this->Dimensions[0]; ++i)
        {
          this->At(i, j, k) = static_cast<float>(value(i, j, k));
        }
      }
    }
  }
};

struct Picture
{
  std::vector<float> Colors, Depths;
  ImageCastStatistics Statistics;

  bool operator==(const Picture& other) const
  {
    return std::memcmp(this->Colors.data(), other.Colors.data(), 4 * this->Colors.size()) == 0 &&
      std::memcmp(this->Depths.data(), other.Depths.data(), 4 * this->Depths.size()) == 0;
  }
};

Picture Cast(const Scene& scene)
{
  const std::vector<std::uint8_t> bytes = Pack(scene.Values, scene.Type);
  ImageVolume volume;
  std::copy(scene.Dimensions.begin(), scene.Dimensions.end(), volume.Dimensions);
  volume.Type = scene.Type;
  volume.Values = bytes.data();
  volume.Scale = scene.Scale;
  volume.Offset = scene.Offset;
  volume.PointFlags = scene.PointFlags.empty() ? nullptr : scene.PointFlags.data();
  volume.Mask = scene.Mask.empty() ? nullptr : scene.Mask.data();
  RayLimits limits = scene.Limits;
  limits.MaximumDistances =
    scene.MaximumDistances.empty() ? nullptr : scene.MaximumDistances.data();
  ImageCaster caster;
  caster.SetVolume(volume);
  caster.SetOptics(scene.Optics);
  Picture picture;
  const std::size_t pixels = static_cast<std::size_t>(scene.Grid.Width) * scene.Grid.Height;
  picture.Colors.resize(4 * pixels);
  picture.Depths.resize(pixels);
  picture.Statistics =
    caster.Cast(scene.Grid, limits, scene.Options, picture.Colors, picture.Depths);
  return picture;
}

// The same in plain loops.

struct Vector
{
  double X[3];
};

struct PlainRay
{
  Vector Start, Direction;           ///< in the world, of length 1
  Vector IndexStart, IndexDirection; ///< in the volume
  double DepthOfDirection;
};

double Dot(const double (&a)[3], const double (&b)[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

PlainRay MakePlainRay(const RayGrid& grid, const SlicePlanes& slices, int i, int j)
{
  PlainRay ray;
  for (int a = 0; a < 3; ++a)
  {
    ray.Start.X[a] = grid.Origin[a] + i * grid.OriginStepX[a] + j * grid.OriginStepY[a];
    ray.Direction.X[a] =
      grid.Direction[a] + i * grid.DirectionStepX[a] + j * grid.DirectionStepY[a];
  }
  const double length = std::sqrt(Dot(ray.Direction.X, ray.Direction.X));
  for (double& x : ray.Direction.X)
  {
    x /= length;
  }
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    const double linear[3] = { row[0], row[1], row[2] };
    ray.IndexStart.X[a] = Dot(linear, ray.Start.X) + row[3];
    ray.IndexDirection.X[a] = Dot(linear, ray.Direction.X);
  }
  ray.DepthOfDirection =
    slices.Shape == SliceShape::Planes ? Dot(ray.Direction.X, slices.Normal) : 1;
  return ray;
}

/// World distances between which the ray counts, in ascending parts.
std::vector<std::array<double, 2>> FindParts(const Scene& scene, const PlainRay& ray, int pixel)
{
  double begin = 0;
  double end = Infinity;
  const auto cut = [&](double height, double slope)
  {
    if (slope > 0)
    {
      begin = std::max(begin, -height / slope);
    }
    else if (slope < 0)
    {
      end = std::min(end, -height / slope);
    }
    else if (height < 0)
    {
      end = -1;
    }
  };
  for (int a = 0; a < 3; ++a)
  {
    cut(ray.IndexStart.X[a], ray.IndexDirection.X[a]);
    cut(scene.Dimensions[a] - 1 - ray.IndexStart.X[a], -ray.IndexDirection.X[a]);
  }
  for (const std::array<double, 4>& plane : scene.Limits.Planes)
  {
    const double normal[3] = { plane[0], plane[1], plane[2] };
    cut(Dot(normal, ray.Start.X) + plane[3], Dot(normal, ray.Direction.X));
  }
  if (!scene.MaximumDistances.empty())
  {
    end = std::min(end, static_cast<double>(scene.MaximumDistances[pixel]));
  }
  if (!(begin < end))
  {
    return {};
  }
  if (!scene.Limits.Cropping)
  {
    return { { begin, end } };
  }
  std::vector<double> cuts = { begin, end };
  for (int p = 0; p < 6; ++p)
  {
    const double t =
      (scene.Limits.CroppingPlanes[p] - ray.IndexStart.X[p / 2]) / ray.IndexDirection.X[p / 2];
    if (begin < t && t < end)
    {
      cuts.push_back(t);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<std::array<double, 2>> parts;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c)
  {
    const double t = 0.5 * (cuts[c] + cuts[c + 1]);
    int region = 0;
    for (int a = 2; a >= 0; --a)
    {
      const double x = ray.IndexStart.X[a] + t * ray.IndexDirection.X[a];
      const double* planes = scene.Limits.CroppingPlanes + 2 * a;
      region = 3 * region + (x >= planes[0] ? 1 : 0) + (x >= planes[1] ? 1 : 0);
    }
    if ((scene.Limits.CroppingFlags >> region & 1u) == 0)
    {
      continue;
    }
    if (!parts.empty() && parts.back()[1] == cuts[c])
    {
      parts.back()[1] = cuts[c + 1];
    }
    else
    {
      parts.push_back({ cuts[c], cuts[c + 1] });
    }
  }
  return parts;
}

/// What single precision may turn over: positions are off by some 1e-6 of a cell or a slab, and
/// values by some 1e-6 of all that there are.
constexpr double Doubt = 1e-5;

struct PlainSample
{
  std::size_t Part;
  int Slab;
  double Begin, Middle, End; ///< world distances
  double Scalar;             ///< not a number where a corner of the cell is not finite
};

struct PlainPixel
{
  double Color[4] = { 0, 0, 0, 0 };
  double Depth = -1;
  bool Doubtful = false;      ///< rounding may change it
  bool DepthDoubtful = false; ///< rounding may change the depth
};

/// The scalar at a world distance. close: set if another cell is about as close.
double FindScalar(const Scene& scene, const PlainRay& ray, double t, bool& close)
{
  int cell[3];
  double w[3];
  for (int a = 0; a < 3; ++a)
  {
    const double x = ray.IndexStart.X[a] + t * ray.IndexDirection.X[a];
    cell[a] = static_cast<int>(std::clamp(std::floor(x), 0., scene.Dimensions[a] - 2.));
    w[a] = x - cell[a];
    close = close || w[a] < Doubt || w[a] > 1 - Doubt;
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight = 1;
    int point[3];
    for (int a = 0; a < 3; ++a)
    {
      const int upper = corner >> a & 1;
      point[a] = cell[a] + upper;
      weight *= upper != 0 ? w[a] : 1 - w[a];
    }
    const float value =
      scene.Values[(static_cast<std::size_t>(point[2]) * scene.Dimensions[1] + point[1]) *
          scene.Dimensions[0] +
        point[0]];
    if (!std::isfinite(value))
    {
      return NotANumber;
    }
    sum += weight * value;
  }
  return scene.Offset + scene.Scale * sum;
}

class PlainCaster
{
public:
  explicit PlainCaster(const Scene& scene)
    : S(scene)
  {
    ImageVolume volume;
    std::copy(scene.Dimensions.begin(), scene.Dimensions.end(), volume.Dimensions);
    this->Slices =
      MakeSlicePlanes(volume, scene.Grid, scene.Options.Shape, scene.Options.SampleDistance);
    for (const float value : scene.Values)
    {
      this->HasEmptyCells = this->HasEmptyCells || !std::isfinite(value);
    }
    this->Width = std::abs(scene.Scale) * 100;
  }

  PlainPixel Find(int i, int j)
  {
    const PlainRay ray = MakePlainRay(this->S.Grid, this->Slices, i, j);
    const auto parts = FindParts(this->S, ray, j * this->S.Grid.Width + i);
    this->Pixel = PlainPixel();
    switch (this->S.Optics.Blend)
    {
      case ImageBlend::MaximumIntensity:
        this->FindExtreme(ray, parts, 1);
        break;
      case ImageBlend::MinimumIntensity:
        this->FindExtreme(ray, parts, -1);
        break;
      case ImageBlend::AverageIntensity:
        this->FindAverage(ray, parts);
        break;
      case ImageBlend::Additive:
        this->FindSum(ray, parts);
        break;
      case ImageBlend::Isosurfaces:
        this->FindSurfaces(ray, parts);
        break;
      default:
        this->FindSlice(ray, parts);
        break;
    }
    return this->Pixel;
  }

private:
  std::vector<PlainSample> FindSamples(
    const PlainRay& ray, const std::vector<std::array<double, 2>>& parts)
  {
    const double origin = this->Slices.Origin / ray.DepthOfDirection;
    const double step = this->Slices.Distance / ray.DepthOfDirection;
    std::vector<PlainSample> samples;
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
      for (const double end : parts[p])
      {
        // A sample of almost no length may be missing, or be one too many.
        const double u = (end - origin) / step;
        this->ShortSamples = this->ShortSamples || (u > 0.5 && std::abs(u - std::round(u)) < Doubt);
      }
      const int first = static_cast<int>(std::floor((parts[p][0] - origin) / step));
      for (int slab = std::max(first - 1, 0); origin + slab * step < parts[p][1]; ++slab)
      {
        PlainSample sample;
        sample.Part = p;
        sample.Slab = slab;
        sample.Begin = std::max(parts[p][0], origin + slab * step);
        sample.End = std::min(parts[p][1], origin + (slab + 1) * step);
        if (sample.Begin < sample.End)
        {
          sample.Middle = 0.5 * (sample.Begin + sample.End);
          bool close = false;
          sample.Scalar = FindScalar(this->S, ray, sample.Middle, close);
          this->Pixel.Doubtful = this->Pixel.Doubtful || (this->HasEmptyCells && close);
          samples.push_back(sample);
        }
      }
    }
    return samples;
  }

  void Show(double scalar, double distance)
  {
    const TransferFunction::Value value = Evaluate(this->S.Optics.Function, scalar);
    const double opacity = std::min(value.Attenuation, 1.);
    if (opacity > 0)
    {
      for (int c = 0; c < 3; ++c)
      {
        this->Pixel.Color[c] = value.Color[c] * opacity;
      }
      this->Pixel.Color[3] = opacity;
      this->Pixel.Depth = distance;
    }
    this->Pixel.DepthDoubtful = this->Pixel.DepthDoubtful || opacity < Doubt;
  }

  void FindExtreme(
    const PlainRay& ray, const std::vector<std::array<double, 2>>& parts, double sign)
  {
    this->ShortSamples = false;
    const std::vector<PlainSample> samples = this->FindSamples(ray, parts);
    this->Pixel.Doubtful = this->Pixel.Doubtful || this->ShortSamples;
    const PlainSample* best = nullptr;
    for (const PlainSample& sample : samples)
    {
      if (std::isfinite(sample.Scalar) && (!best || sign * sample.Scalar > sign * best->Scalar))
      {
        best = &sample;
      }
    }
    for (const PlainSample& sample : samples)
    {
      this->Pixel.DepthDoubtful = this->Pixel.DepthDoubtful ||
        (best && best != &sample && std::abs(sample.Scalar - best->Scalar) < Doubt * this->Width);
    }
    if (best)
    {
      this->Show(best->Scalar, best->Middle);
    }
  }

  double FindGrey(double scalar) const
  {
    const double* range = this->S.Optics.GreyRange;
    return std::clamp((scalar - range[0]) / (range[1] - range[0]), 0., 1.);
  }

  void FindAverage(const PlainRay& ray, const std::vector<std::array<double, 2>>& parts)
  {
    double sum = 0;
    double length = 0;
    for (const PlainSample& sample : this->FindSamples(ray, parts))
    {
      for (const double end : this->S.Optics.AverageRange)
      {
        this->Pixel.Doubtful =
          this->Pixel.Doubtful || std::abs(sample.Scalar - end) < Doubt * this->Width;
      }
      if (this->S.Optics.AverageRange[0] <= sample.Scalar &&
        sample.Scalar <= this->S.Optics.AverageRange[1])
      {
        const double l = sample.End - sample.Begin;
        sum += l * Evaluate(this->S.Optics.Function, sample.Scalar).Attenuation *
          this->FindGrey(sample.Scalar);
        // The first one may be too short to be seen.
        this->Pixel.DepthDoubtful =
          this->Pixel.DepthDoubtful || (length < Doubt * this->Slices.Distance && length > 0);
        if (length == 0)
        {
          this->Pixel.Depth = sample.Begin;
        }
        length += l;
      }
    }
    // The mean of almost nothing.
    this->Pixel.Doubtful =
      this->Pixel.Doubtful || (length > 0 && length < 0.1 * this->Slices.Distance);
    if (length > 0)
    {
      std::fill(this->Pixel.Color, this->Pixel.Color + 3, std::min(sum / length, 1.));
      this->Pixel.Color[3] = 1;
    }
  }

  void FindSum(const PlainRay& ray, const std::vector<std::array<double, 2>>& parts)
  {
    double sum = 0;
    for (const PlainSample& sample : this->FindSamples(ray, parts))
    {
      if (!std::isfinite(sample.Scalar))
      {
        continue;
      }
      const double length = (sample.End - sample.Begin) *
        (this->S.Options.CorrectOpacity ? 1 : ray.DepthOfDirection) / this->S.Optics.UnitDistance;
      const double grey = length * Evaluate(this->S.Optics.Function, sample.Scalar).Attenuation *
        this->FindGrey(sample.Scalar);
      if (grey > 0 && this->Pixel.Depth < 0 && sum < 1)
      {
        this->Pixel.Depth = sample.Begin;
        this->Pixel.DepthDoubtful = grey < Doubt;
      }
      sum += grey;
    }
    if (!parts.empty())
    {
      std::fill(this->Pixel.Color, this->Pixel.Color + 3, std::min(sum, 1.));
      this->Pixel.Color[3] = 1;
    }
  }

  void FindSurfaces(const PlainRay& ray, const std::vector<std::array<double, 2>>& parts)
  {
    this->ShortSamples = false;
    const std::vector<PlainSample> samples = this->FindSamples(ray, parts);
    this->Pixel.Doubtful = this->Pixel.Doubtful || this->ShortSamples;
    double rest = 1;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
      const double b = samples[n].Scalar;
      for (const Isosurface& surface : this->S.Optics.Surfaces)
      {
        this->Pixel.Doubtful =
          this->Pixel.Doubtful || std::abs(b - surface.Value) < Doubt * this->Width;
      }
      if (n == 0 || samples[n - 1].Part != samples[n].Part ||
        !std::isfinite(samples[n - 1].Scalar) || !std::isfinite(b))
      {
        continue;
      }
      const double a = samples[n - 1].Scalar;
      struct Hit
      {
        double Distance;
        const Isosurface* Surface;
      };
      std::vector<Hit> hits;
      for (const Isosurface& surface : this->S.Optics.Surfaces)
      {
        if ((surface.Value <= a) != (surface.Value <= b))
        {
          hits.push_back({ samples[n - 1].Middle +
              (samples[n].Middle - samples[n - 1].Middle) * (surface.Value - a) / (b - a),
            &surface });
        }
      }
      std::stable_sort(hits.begin(), hits.end(),
        [](const Hit& l, const Hit& r) { return l.Distance < r.Distance; });
      for (const Hit& hit : hits)
      {
        this->Pixel.Doubtful =
          this->Pixel.Doubtful || std::abs(rest - this->S.Options.Threshold) < Doubt;
        const double opacity = hit.Surface->Opacity;
        if (rest < this->S.Options.Threshold || opacity == 0)
        {
          continue;
        }
        for (int c = 0; c < 3; ++c)
        {
          this->Pixel.Color[c] += rest * opacity * hit.Surface->Color[c];
        }
        rest *= 1 - opacity;
        this->Pixel.Depth = this->Pixel.Depth < 0 ? hit.Distance : this->Pixel.Depth;
      }
    }
    this->Pixel.Color[3] = 1 - rest;
  }

  void FindSlice(const PlainRay& ray, const std::vector<std::array<double, 2>>& parts)
  {
    const std::array<double, 4>& plane = this->S.Optics.SlicePlane;
    const double normal[3] = { plane[0], plane[1], plane[2] };
    const double t = -(Dot(normal, ray.Start.X) + plane[3]) / Dot(normal, ray.Direction.X);
    for (const std::array<double, 2>& part : parts)
    {
      this->Pixel.Doubtful =
        this->Pixel.Doubtful || std::abs(t - part[0]) < Doubt || std::abs(t - part[1]) < Doubt;
      if (part[0] <= t && t <= part[1])
      {
        bool close = false;
        const double scalar = FindScalar(this->S, ray, t, close);
        this->Pixel.Doubtful = this->Pixel.Doubtful || (this->HasEmptyCells && close);
        if (std::isfinite(scalar))
        {
          this->Show(scalar, t);
        }
      }
    }
  }

  const Scene& S;
  SlicePlanes Slices;
  bool HasEmptyCells = false;
  double Width; ///< of the scalars
  bool ShortSamples = false;
  PlainPixel Pixel;
};

/// Of a channel: what 8 bits show.
constexpr double VisibleError = 1. / 255;
/// Of a channel: some hundred roundings of single precision, of scalars and of positions.
constexpr double RoundingError = 1e-5;
/// Of a depth, in slabs: a position in single precision.
constexpr double DepthError = 1e-3;

/// Compares a picture with the plain loops, pixels without doubt. Returns how many pixels show
/// anything.
int ExpectPlain(const Scene& scene, const Picture& picture)
{
  PlainCaster plain(scene);
  int shown = 0;
  int doubtful = 0;
  int inexact = 0;
  for (int j = 0; j < scene.Grid.Height; ++j)
  {
    for (int i = 0; i < scene.Grid.Width; ++i)
    {
      const int p = j * scene.Grid.Width + i;
      const PlainPixel pixel = plain.Find(i, j);
      shown += pixel.Color[3] > 0 ? 1 : 0;
      if (pixel.Doubtful)
      {
        ++doubtful;
        continue;
      }
      double error = 0;
      for (int c = 0; c < 4; ++c)
      {
        error = std::max(error, std::abs(picture.Colors[4 * p + c] - pixel.Color[c]));
      }
      EXPECT_LT(error, VisibleError) << "pixel " << i << ", " << j;
      inexact += error < RoundingError ? 0 : 1;
      if (!pixel.DepthDoubtful)
      {
        EXPECT_NEAR(picture.Depths[p], pixel.Depth, DepthError * scene.Options.SampleDistance)
          << "pixel " << i << ", " << j;
      }
    }
  }
  const int pixels = scene.Grid.Width * scene.Grid.Height;
  EXPECT_LT(doubtful, 0.05 * pixels);
  EXPECT_LE(inexact, 0.01 * pixels);
  return shown;
}

double Uniform(std::mt19937& random, double low, double high)
{
  return low + (high - low) * (random() / 4294967296.);
}

/// Rays onto the middle of the volume, from a point outside of it.
void SetView(Scene& scene, std::mt19937& random, bool parallel)
{
  RayGrid& grid = scene.Grid;
  grid = RayGrid();
  grid.Width = 37;
  grid.Height = 29;
  // Points are at different distances along each axis, and the axes are turned.
  const double angle = Uniform(random, 0, 6);
  const double turned[3][3] = { { std::cos(angle), std::sin(angle), 0 },
    { -std::sin(angle), std::cos(angle), 0 }, { 0, 0, 1 } };
  const double spacing[3] = { 1.1, 0.9, 1.3 };
  double center[3]; // the middle of the volume is there
  double size = 0;
  for (int a = 0; a < 3; ++a)
  {
    center[a] = Uniform(random, -5, 5);
    size += spacing[a] * scene.Dimensions[a] / 3;
  }
  for (int a = 0; a < 3; ++a)
  {
    double sum = 0;
    for (int b = 0; b < 3; ++b)
    {
      grid.MeshFromWorld[a][b] = turned[a][b] / spacing[a];
      sum += grid.MeshFromWorld[a][b] * center[b];
    }
    grid.MeshFromWorld[a][3] = 0.5 * (scene.Dimensions[a] - 1) - sum;
  }
  double n[3];
  for (double& x : n)
  {
    x = Uniform(random, -1, 1);
  }
  const double length = std::sqrt(Dot(n, n));
  double right[3] = { -n[1], n[0], 0 };
  const double across = std::sqrt(Dot(right, right));
  for (int a = 0; a < 3; ++a)
  {
    n[a] /= length;
    right[a] /= across;
  }
  const double up[3] = { n[1] * right[2] - n[2] * right[1], n[2] * right[0] - n[0] * right[2],
    n[0] * right[1] - n[1] * right[0] };
  const double distance = 2 * size;
  const double step = 1.5 * size / grid.Width;
  for (int a = 0; a < 3; ++a)
  {
    const double half = 0.5 * step * (grid.Width * right[a] + grid.Height * up[a]);
    grid.Origin[a] = center[a] - distance * n[a] - (parallel ? half : 0);
    grid.Direction[a] = n[a] * (parallel ? 1 : distance) - (parallel ? 0 : half);
    (parallel ? grid.OriginStepX : grid.DirectionStepX)[a] = step * right[a];
    (parallel ? grid.OriginStepY : grid.DirectionStepY)[a] = step * up[a];
  }
}

/// A function of 0..100 that is transparent up to about 25.
TransferFunction MakeFunction(std::mt19937& random, int nodes)
{
  TransferFunction function;
  for (int n = 0; n < nodes; ++n)
  {
    TransferFunction::Value value{};
    value.Attenuation = n <= 1 ? 0 : Uniform(random, 0.1, 1);
    for (double& c : value.Color)
    {
      c = Uniform(random, 0, 1);
    }
    const double scalar = n == 0 ? 0 : 20 + 70. * n / nodes;
    function.Nodes.push_back({ scalar, value, value });
  }
  return function;
}

/// What is large becomes small.
void Invert(Scene& scene)
{
  for (float& value : scene.Values)
  {
    value = 100 - value;
  }
  std::vector<TransferFunction::Node>& nodes = scene.Optics.Function.Nodes;
  std::reverse(nodes.begin(), nodes.end());
  for (TransferFunction::Node& node : nodes)
  {
    node.Scalar = 100 - node.Scalar;
    std::swap(node.Left, node.Right);
  }
}

/// Balls in nothing, with noise.
void FillBalls(Scene& scene, std::mt19937& random)
{
  scene.Dimensions = { 23, 31, 26 };
  double balls[3][4];
  for (auto& ball : balls)
  {
    for (int a = 0; a < 3; ++a)
    {
      ball[a] = Uniform(random, 0.2, 0.8) * scene.Dimensions[a];
    }
    ball[3] = Uniform(random, 6, 10);
  }
  balls[0][0] = 11; // in the middle
  balls[0][1] = 15;
  balls[0][2] = 12;
  scene.Fill(
    [&](int i, int j, int k)
    {
      double value = 3;
      for (const auto& ball : balls)
      {
        const double r = std::hypot(i - ball[0], j - ball[1], k - ball[2]) / ball[3];
        value = std::max(value, r < 1 ? 100 * (1 - r * r) + Uniform(random, -10, 0) : 3);
      }
      return std::floor(std::max(value, 0.));
    });
}

Scene MakeScene(std::mt19937& random, ImageBlend blend, bool parallel, int nodes)
{
  Scene scene;
  FillBalls(scene, random);
  SetView(scene, random, parallel);
  scene.Optics.Function = MakeFunction(random, nodes);
  scene.Optics.Blend = blend;
  scene.Optics.UnitDistance = 25;
  scene.Optics.AverageRange[0] = 10.3;
  scene.Optics.AverageRange[1] = 77.7;
  scene.Optics.GreyRange[0] = 5;
  scene.Optics.GreyRange[1] = 90;
  scene.Optics.Surfaces = { { 60.2f, { 0.9f, 0.2f, 0.1f }, 0.5f },
    { 15.1f, { 0.1f, 0.7f, 0.3f }, 0.2f }, { 61.3f, { 0.2f, 0.1f, 0.8f }, 0.9f },
    { 150.f, { 1.f, 1.f, 1.f }, 1.f }, { 30.7f, { 0.4f, 0.4f, 0.2f }, 0.f } };
  // Through the middle of the volume, about which the picture is.
  const RayGrid& grid = scene.Grid;
  double normal[3];
  double middle[3];
  for (int a = 0; a < 3; ++a)
  {
    const double half[2] = { 0.5 * grid.Width, 0.5 * grid.Height };
    const double direction =
      grid.Direction[a] + half[0] * grid.DirectionStepX[a] + half[1] * grid.DirectionStepY[a];
    const double start =
      grid.Origin[a] + half[0] * grid.OriginStepX[a] + half[1] * grid.OriginStepY[a];
    const double size = (1.1 * 23 + 0.9 * 31 + 1.3 * 26) / 3;
    middle[a] = start + direction * (parallel ? 2 * size : 1);
    normal[a] = direction + Uniform(random, -0.4, 0.4) * (parallel ? 1 : 2 * size);
  }
  scene.Optics.SlicePlane = { normal[0], normal[1], normal[2], -Dot(normal, middle) };
  scene.Options.SampleDistance = 0.8;
  scene.Options.NumberOfThreads = 1;
  if (blend == ImageBlend::MinimumIntensity)
  {
    Invert(scene);
  }
  return scene;
}

/// Calls check with a scene of each blend mode in both projections.
void ForEachScene(int nodes, const std::function<void(Scene&, std::mt19937&)>& check)
{
  std::mt19937 random(7);
  for (const ImageBlend blend : Blends)
  {
    for (const bool parallel : { false, true })
    {
      const testing::ScopedTrace trace(__FILE__, __LINE__,
        std::string(GetName(blend)) + (parallel ? ", parallel" : ", perspective"));
      Scene scene = MakeScene(random, blend, parallel, nodes);
      check(scene, random);
    }
  }
}

TEST(ImageBlends, EachTypeOfValue)
{
  for (const ImageScalar type : { ImageScalar::Int8, ImageScalar::UInt8, ImageScalar::Int16,
         ImageScalar::UInt16, ImageScalar::Float })
  {
    const testing::ScopedTrace trace(
      __FILE__, __LINE__, "type " + std::to_string(static_cast<int>(type)));
    ForEachScene(5,
      [&](Scene& scene, std::mt19937&)
      {
        scene.Type = type;
        EXPECT_GT(ExpectPlain(scene, Cast(scene)), 50);
      });
  }
}

TEST(ImageBlends, FewAndManyIntervals)
{
  for (const int nodes : { 3, 12, 60 })
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, std::to_string(nodes) + " nodes");
    ForEachScene(nodes,
      [&](Scene& scene, std::mt19937&)
      {
        for (const bool portable : { false, true })
        {
          scene.Options.PortableKernels = portable;
          EXPECT_GT(ExpectPlain(scene, Cast(scene)), 50);
        }
      });
  }
}

TEST(ImageBlends, ScaledValues)
{
  // The same scalars: as whole numbers of other values, some of which descend.
  for (const double scale : { 0.5, -0.5 })
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, "scale " + std::to_string(scale));
    ForEachScene(5,
      [&](Scene& scene, std::mt19937&)
      {
        for (float& value : scene.Values)
        {
          value = static_cast<float>((value - 10) / scale);
        }
        scene.Scale = scale;
        scene.Offset = 10;
        scene.Type = ImageScalar::Int16;
        EXPECT_GT(ExpectPlain(scene, Cast(scene)), 50);
      });
  }
}

TEST(ImageBlends, ShellsAndLengthsAlongTheNormal)
{
  ForEachScene(5,
    [](Scene& scene, std::mt19937&)
    {
      scene.Options.Shape = SliceShape::Shells;
      EXPECT_GT(ExpectPlain(scene, Cast(scene)), 50);
      scene.Options.Shape = SliceShape::Planes;
      scene.Options.CorrectOpacity = false;
      EXPECT_GT(ExpectPlain(scene, Cast(scene)), 50);
    });
}

TEST(ImageBlends, Attenuation)
{
  ForEachScene(5,
    [](Scene& scene, std::mt19937&)
    {
      scene.Optics.Opacity = StepOpacity::Attenuation;
      for (TransferFunction::Node& node : scene.Optics.Function.Nodes)
      {
        node.Left.Attenuation *= 3;
        node.Right.Attenuation *= 3;
      }
      EXPECT_GT(ExpectPlain(scene, Cast(scene)), 50);
    });
}

TEST(ImageBlends, EmptyCells)
{
  ForEachScene(5,
    [](Scene& scene, std::mt19937& random)
    {
      for (int n = 0; n < 200; ++n)
      {
        scene.Values[random() % scene.Values.size()] =
          n % 5 == 0 ? static_cast<float>(n % 2 == 0 ? Infinity : -Infinity) : NotANumber;
      }
      EXPECT_GT(ExpectPlain(scene, Cast(scene)), 50);
      std::fill(scene.Values.begin(), scene.Values.end(), NotANumber);
      // Additive: a black box, as without any values in VTK.
      const int shown = ExpectPlain(scene, Cast(scene));
      EXPECT_EQ(shown > 0, scene.Optics.Blend == ImageBlend::Additive);
    });
}

/// Calls check with limits of each kind.
void ForEachLimit(Scene& scene, std::mt19937& random, const std::function<void()>& check)
{
  const Scene unlimited = scene;
  const RayGrid& grid = scene.Grid;
  double n[3], middle[3];
  for (int a = 0; a < 3; ++a)
  {
    n[a] = Uniform(random, -1, 1);
    middle[a] = 0;
    for (int b = 0; b < 3; ++b)
    {
      // The inverse of a rotation and a scaling.
      const double* other = grid.MeshFromWorld[b];
      const double squared = other[0] * other[0] + other[1] * other[1] + other[2] * other[2];
      middle[a] += other[a] / squared * (0.5 * (scene.Dimensions[b] - 1) - other[3]);
    }
  }
  scene.Limits.Planes = { { n[0], n[1], n[2], 4 - Dot(n, middle) },
    { -n[1], n[0], n[2], 3 - (-n[1] * middle[0] + n[0] * middle[1] + n[2] * middle[2]) } };
  check();
  scene = unlimited;
  scene.Limits.Cropping = true;
  for (const std::uint32_t flags : { 0x2000u, 0x7ffdfffu, 0x5555555u, 0x2aaaaaau })
  {
    scene.Limits.CroppingFlags = flags;
    for (int a = 0; a < 3; ++a)
    {
      scene.Limits.CroppingPlanes[2 * a] = Uniform(random, 0.3, 0.45) * scene.Dimensions[a];
      scene.Limits.CroppingPlanes[2 * a + 1] = Uniform(random, 0.55, 0.7) * scene.Dimensions[a];
    }
    check();
  }
  scene = unlimited;
  const double distance =
    std::hypot(grid.Origin[0] - middle[0], grid.Origin[1] - middle[1], grid.Origin[2] - middle[2]);
  for (int p = 0; p < grid.Width * grid.Height; ++p)
  {
    scene.MaximumDistances.push_back(static_cast<float>(Uniform(random, 0.8, 1.3) * distance));
  }
  check();
}

TEST(ImageBlends, Limits)
{
  ForEachScene(5,
    [](Scene& scene, std::mt19937& random)
    { ForEachLimit(scene, random, [&] { EXPECT_GT(ExpectPlain(scene, Cast(scene)), 20); }); });
}

/// Checks that a picture has the same bits in whatever way it is made.
void ExpectSameBits(Scene& scene)
{
  const ImageCasterOptions options = scene.Options;
  const Picture first = Cast(scene);
  for (const int threads : { 2, 3, 7 })
  {
    scene.Options.NumberOfThreads = threads;
    EXPECT_TRUE(Cast(scene) == first) << threads << " threads";
  }
  scene.Options = options;
  for (const int size : { 4, 7, 16, 64 })
  {
    scene.Options.TileSize = size;
    EXPECT_TRUE(Cast(scene) == first) << "tiles of " << size;
  }
  scene.Options = options;
  scene.Options.Triangles = true;
  EXPECT_TRUE(Cast(scene) == first) << "triangles";
  scene.Options.EndTriangles = false;
  EXPECT_TRUE(Cast(scene) == first) << "triangles that do not end";
  scene.Options.SkipPixels = false;
  EXPECT_TRUE(Cast(scene) == first) << "no pixels skipped";
  scene.Options = options;
  scene.Options.SkipEmptySpace = false;
  const Picture whole = Cast(scene);
  EXPECT_TRUE(whole == first) << "empty space";
  EXPECT_LE(first.Statistics.Samples, whole.Statistics.Samples);
  scene.Options = options;
}

TEST(ImageBlends, SameBits)
{
  ForEachScene(5,
    [](Scene& scene, std::mt19937& random)
    {
      ExpectSameBits(scene);
      ForEachLimit(scene, random, [&] { ExpectSameBits(scene); });
    });
}

TEST(ImageBlends, EmptySpaceIsSkipped)
{
  std::mt19937 random(3);
  for (const ImageBlend blend : Blends)
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, GetName(blend));
    Scene scene = MakeScene(random, blend, false, 5);
    // One ball at one end of a volume that is much longer.
    scene.Dimensions = { 24, 24, 300 };
    scene.Fill([](int i, int j, int k)
      { return std::max(0., 90 - 10 * std::hypot(i - 11, j - 12, k - 20)); });
    SetView(scene, random, false);
    if (blend == ImageBlend::MinimumIntensity)
    {
      for (float& value : scene.Values)
      {
        value = 100 - value;
      }
    }
    const Picture picture = Cast(scene);
    scene.Options.SkipEmptySpace = false;
    const Picture whole = Cast(scene);
    EXPECT_TRUE(whole == picture);
    if (blend != ImageBlend::Slice)
    {
      EXPECT_LT(picture.Statistics.Samples, 0.5 * whole.Statistics.Samples);
    }
  }
}

/// Parallel rays along z through layers of constant values, each on a plane of points.
Scene MakeLayers(const std::vector<double>& values)
{
  Scene scene;
  scene.Dimensions = { 9, 10, static_cast<int>(values.size()) };
  scene.Fill([&](int, int, int k) { return values[k]; });
  scene.Grid.Width = 6;
  scene.Grid.Height = 5;
  const double origin[3] = { 1.05, 1.5, -3 };
  std::copy(origin, origin + 3, scene.Grid.Origin);
  scene.Grid.Direction[2] = 1;
  scene.Grid.OriginStepX[0] = 1.1;
  scene.Grid.OriginStepY[1] = 1.2;
  std::mt19937 random(11);
  scene.Optics.Function = MakeFunction(random, 3);
  scene.Optics.Blend = ImageBlend::Isosurfaces;
  scene.Optics.Surfaces = { { 20, { 1, 0, 0 }, 0.05f }, { 70, { 0, 1, 0 }, 0.04f } };
  scene.Options.NumberOfThreads = 1;
  return scene;
}

TEST(ImageBlends, SurfacesBetweenBlocksOfSlabs)
{
  // Nothing but one step, anywhere: also behind the last sample of a block of slabs, where the next
  // block meets empty space only, and where samples step over a layer that is not a number.
  for (const bool hole : { false, true })
  {
    for (std::size_t step = 1; step < 160; ++step)
    {
      std::vector<double> values(160, 0);
      std::fill(values.begin() + step, values.end(), 100);
      values[step] = hole ? NotANumber : 100;
      Scene scene = MakeLayers(values);
      scene.Options.SampleDistance = 4.527;
      const Picture picture = Cast(scene);
      ExpectPlain(scene, picture);
      scene.Options.SkipEmptySpace = false;
      EXPECT_TRUE(Cast(scene) == picture) << step;
    }
  }
}

TEST(ImageBlends, WhatIsTransparentMayBeLargest)
{
  // What is seen is in front of what is not seen, and samples step over all that is in between.
  for (const ImageBlend blend : { ImageBlend::MaximumIntensity, ImageBlend::MinimumIntensity })
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, GetName(blend));
    for (std::size_t step = 1; step < 160; ++step)
    {
      std::vector<double> values(160, 30);
      std::fill(values.begin() + step, values.end(), 100);
      Scene scene = MakeLayers(values);
      scene.Optics.Blend = blend;
      const auto node = [](double scalar, double opacity)
      {
        const TransferFunction::Value value{ { 1, 0.5, 0.2 }, opacity };
        return TransferFunction::Node{ scalar, value, value };
      };
      scene.Optics.Function.Nodes = { node(20, 0), node(30, 0.9), node(40, 0) };
      if (blend == ImageBlend::MinimumIntensity)
      {
        Invert(scene);
      }
      scene.Options.SampleDistance = 4.527;
      const Picture picture = Cast(scene);
      ExpectPlain(scene, picture);
      scene.Options.SkipEmptySpace = false;
      EXPECT_TRUE(Cast(scene) == picture) << step;
    }
  }
}

TEST(ImageBlends, TheFirstOfEqualScalarsHasTheDepth)
{
  // The same in front and behind, where a corner that no ray meets is looked at first.
  for (const ImageBlend blend : { ImageBlend::MaximumIntensity, ImageBlend::MinimumIntensity })
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, GetName(blend));
    std::vector<double> values(160, 10);
    std::fill(values.begin() + 20, values.begin() + 40, 80);
    std::fill(values.begin() + 120, values.begin() + 140, 80);
    Scene scene = MakeLayers(values);
    scene.At(0, 0, 130) = 100;
    scene.Optics.Blend = blend;
    if (blend == ImageBlend::MinimumIntensity)
    {
      Invert(scene);
    }
    scene.Options.SampleDistance = 0.71;
    const Picture picture = Cast(scene);
    ExpectPlain(scene, picture);
    // Rays begin 3 in front of the volume; the first sample behind 20 is at 0.71 * 28.5.
    for (const float depth : picture.Depths)
    {
      EXPECT_NEAR(depth, 3 + 0.71 * 28.5, 1e-5);
    }
    scene.Options.SkipEmptySpace = false;
    const Picture whole = Cast(scene);
    EXPECT_TRUE(whole == picture);
    EXPECT_LT(picture.Statistics.Samples, whole.Statistics.Samples);
  }
}

TEST(ImageBlends, SurfacesBesideEmptySpace)
{
  // Some layers are thinner than the distance of samples, and some are not numbers.
  std::mt19937 random(11);
  for (int n = 0; n < 24; ++n)
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, "volume " + std::to_string(n));
    const double values[] = { 0, 0, 50, 100, n % 2 == 0 ? 0 : NotANumber };
    std::vector<double> layers;
    while (layers.size() < 160)
    {
      const double value = values[random() % 5];
      layers.insert(layers.end(), 1 + random() % (random() % 3 == 0 ? 30 : 3), value);
    }
    layers.resize(160);
    Scene scene = MakeLayers(layers);
    scene.Options.SampleDistance = std::array<double, 3>{ 0.71, 2.3, 5.17 }[n % 3];
    ExpectPlain(scene, Cast(scene));
    ExpectSameBits(scene);
    scene.Limits.Cropping = true;
    scene.Limits.CroppingFlags = 0x7ffdfffu;
    const double planes[6] = { 0.5, 7, 0.5, 8, Uniform(random, 20, 80), Uniform(random, 90, 140) };
    std::copy(planes, planes + 6, scene.Limits.CroppingPlanes);
    ExpectPlain(scene, Cast(scene));
    ExpectSameBits(scene);
  }
}

constexpr unsigned char HiddenPoint = 2;

// A cell is as empty with a hidden point as with one that is not a number.
TEST(ImageBlends, HiddenCellsAreAsEmptyOnes)
{
  ForEachScene(5,
    [](Scene& scene, std::mt19937& random)
    {
      scene.PointFlags.assign(scene.Values.size(), 0);
      for (std::size_t n = 0; n < scene.Values.size() / 50; ++n)
      {
        scene.PointFlags[random() % scene.Values.size()] = HiddenPoint;
      }
      ForEachLimit(scene, random,
        [&]
        {
          Scene empty = scene;
          empty.PointFlags.clear();
          for (std::size_t k = 0; k < scene.Values.size(); ++k)
          {
            empty.Values[k] = scene.PointFlags[k] != 0 ? NotANumber : scene.Values[k];
          }
          Scene whole = scene;
          whole.PointFlags.clear();
          const Picture picture = Cast(scene);
          EXPECT_TRUE(picture == Cast(empty));
          EXPECT_FALSE(picture == Cast(whole));
          scene.Options.SkipEmptySpace = false;
          EXPECT_TRUE(picture == Cast(scene));
          scene.Options.SkipEmptySpace = true;
        });
    });
}

TEST(ImageBlends, MasksHide)
{
  ForEachScene(5,
    [](Scene& scene, std::mt19937& random)
    {
      const Picture whole = Cast(scene);
      scene.Mask.assign(scene.Values.size(), 1);
      EXPECT_TRUE(Cast(scene) == whole);
      for (std::size_t n = 0; n < scene.Values.size() / 5; ++n)
      {
        scene.Mask[random() % scene.Values.size()] = 0;
      }
      EXPECT_FALSE(Cast(scene) == whole);
      ExpectSameBits(scene);
      std::fill(scene.Mask.begin(), scene.Mask.end(), 0);
      const Picture nothing = Cast(scene);
      EXPECT_EQ(nothing.Statistics.Samples, 0);
      EXPECT_TRUE(std::all_of(
        nothing.Depths.begin(), nothing.Depths.end(), [](float depth) { return depth == -1; }));
    });
}

// Samples on both sides of what is hidden follow each other where it is thinner than a slab.
TEST(ImageBlends, SurfacesBesideHiddenLayers)
{
  for (int step = 10; step < 150; ++step)
  {
    std::vector<double> values(160, 0);
    std::fill(values.begin() + step, values.end(), 100);
    Scene scene = MakeLayers(values);
    scene.Options.SampleDistance = 17.3;
    scene.PointFlags.assign(scene.Values.size(), 0);
    const std::size_t layer = scene.Values.size() / values.size();
    std::fill(scene.PointFlags.begin() + (step - 5) * layer,
      scene.PointFlags.begin() + (step + 5) * layer, HiddenPoint);
    const Picture picture = Cast(scene);
    scene.Options.SkipEmptySpace = false;
    EXPECT_TRUE(Cast(scene) == picture) << step;
  }
}

/// One ray along x through a linear field, from x = -2 on.
Scene MakeLine(ImageBlend blend)
{
  Scene scene;
  scene.Dimensions = { 12, 3, 4 };
  scene.Fill([](int i, int, int) { return 8 * i; });
  scene.Grid.Width = scene.Grid.Height = 1;
  const double origin[3] = { -2, 0.8, 1.7 };
  const double direction[3] = { 1, 0, 0 };
  std::copy(origin, origin + 3, scene.Grid.Origin);
  std::copy(direction, direction + 3, scene.Grid.Direction);
  // Opacity 0.3 everywhere, and colours linear.
  scene.Optics.Function.Nodes = { { 0, { { 0, 0, 1 }, 0.3 }, { { 0, 0, 1 }, 0.3 } },
    { 100, { { 1, 0, 0 }, 0.3 }, { { 1, 0, 0 }, 0.3 } } };
  scene.Optics.Blend = blend;
  scene.Optics.GreyRange[1] = 100;
  scene.Options.SampleDistance = 0.7;
  scene.Options.NumberOfThreads = 1;
  return scene;
}

/// Of a channel or a depth of some units: a few roundings of single precision.
constexpr double ClosedFormError = 2e-6;

TEST(ImageBlends, MeanAndSumOfALinearField)
{
  // Middles of stretches give the integral of what is linear; the field's mean is 44.
  Scene scene = MakeLine(ImageBlend::AverageIntensity);
  Picture picture = Cast(scene);
  EXPECT_NEAR(picture.Colors[0], 0.3 * 0.44, ClosedFormError);
  EXPECT_EQ(picture.Colors[3], 1.f);
  EXPECT_NEAR(picture.Depths[0], 2, ClosedFormError);
  scene.Optics.Blend = ImageBlend::Additive;
  scene.Optics.UnitDistance = 4;
  picture = Cast(scene);
  EXPECT_NEAR(picture.Colors[1], 0.3 * 0.44 * 11 / 4, ClosedFormError);
  EXPECT_EQ(picture.Colors[3], 1.f);
  scene.Optics.UnitDistance = 1;
  EXPECT_EQ(Cast(scene).Colors[2], 1.f); // more than white
}

TEST(ImageBlends, EndsOfTheAverageRangeCount)
{
  Scene scene = MakeLine(ImageBlend::AverageIntensity);
  scene.Type = ImageScalar::UInt8;
  std::fill(scene.Values.begin(), scene.Values.end(), 40.f);
  const double ranges[][2] = { { 40, 70 }, { 10, 40 }, { 40, 40 } };
  for (const auto& range : ranges)
  {
    std::copy(range, range + 2, scene.Optics.AverageRange);
    EXPECT_NEAR(Cast(scene).Colors[0], 0.3 * 0.4, ClosedFormError);
  }
  scene.Optics.AverageRange[0] = 40.01;
  scene.Optics.AverageRange[1] = 70;
  const Picture picture = Cast(scene);
  EXPECT_EQ(picture.Colors[3], 0.f);
  EXPECT_EQ(picture.Depths[0], -1.f);
}

TEST(ImageBlends, LargestAndSmallestOfALinearField)
{
  // The first stretch is x = 0..0.7, the last one 10.5..11.
  Scene scene = MakeLine(ImageBlend::MinimumIntensity);
  Picture picture = Cast(scene);
  EXPECT_NEAR(picture.Colors[0], 0.3 * 0.028, ClosedFormError);
  EXPECT_NEAR(picture.Colors[3], 0.3, ClosedFormError);
  EXPECT_NEAR(picture.Depths[0], 2.35, ClosedFormError);
  scene.Optics.Blend = ImageBlend::MaximumIntensity;
  picture = Cast(scene);
  EXPECT_NEAR(picture.Colors[0], 0.3 * 0.86, ClosedFormError);
  EXPECT_NEAR(picture.Colors[2], 0.3 * 0.14, ClosedFormError);
  EXPECT_NEAR(picture.Depths[0], 2 + 10.75, 5 * ClosedFormError);
}

TEST(ImageBlends, SurfacesOfALinearField)
{
  // Two surfaces between two samples, one of them twice, seen from both sides.
  Scene scene = MakeLine(ImageBlend::Isosurfaces);
  scene.Options.SampleDistance = 3;
  scene.Optics.Surfaces = { { 40.5, { 1, 0, 0 }, 0.5f }, { 36, { 0, 1, 0 }, 0.25f },
    { 40.5, { 0, 0, 1 }, 0.2f } };
  Picture picture = Cast(scene);
  EXPECT_NEAR(picture.Depths[0], 2 + 4.5, ClosedFormError);
  EXPECT_NEAR(picture.Colors[1], 0.25, ClosedFormError);
  EXPECT_NEAR(picture.Colors[0], 0.75 * 0.5, ClosedFormError);
  EXPECT_NEAR(picture.Colors[2], 0.75 * 0.5 * 0.2, ClosedFormError);
  EXPECT_NEAR(picture.Colors[3], 1 - 0.75 * 0.5 * 0.8, ClosedFormError);
  scene.Grid.Origin[0] = 13;
  scene.Grid.Direction[0] = -1;
  picture = Cast(scene);
  EXPECT_NEAR(picture.Depths[0], 13 - 5.0625, 5 * ClosedFormError);
  EXPECT_NEAR(picture.Colors[2], 0.2, ClosedFormError);
  EXPECT_NEAR(picture.Colors[0], 0.8 * 0.5, ClosedFormError);
  EXPECT_NEAR(picture.Colors[1], 0.8 * 0.5 * 0.25, ClosedFormError);
  // What is opaque hides the others.
  scene.Optics.Surfaces[0].Opacity = 1;
  picture = Cast(scene);
  EXPECT_EQ(picture.Colors[1], 0.f);
  EXPECT_EQ(picture.Colors[3], 1.f);
}

TEST(ImageBlends, SliceOfALinearField)
{
  std::mt19937 random(5);
  for (const bool parallel : { false, true })
  {
    Scene scene = MakeScene(random, ImageBlend::Slice, parallel, 5);
    scene.Fill([](int i, int j, int k) { return i + 0.5 * j + 1.5 * k; });
    scene.Optics.Function.Nodes = { { 0, { { 0, 0, 1 }, 0.1 }, { { 0, 0, 1 }, 0.1 } },
      { 100, { { 1, 0, 0 }, 0.9 }, { { 1, 0, 0 }, 0.9 } } };
    const Picture picture = Cast(scene);
    const std::array<double, 4>& plane = scene.Optics.SlicePlane;
    int shown = 0;
    for (int p = 0; p < scene.Grid.Width * scene.Grid.Height; ++p)
    {
      if (picture.Depths[p] < 0)
      {
        continue;
      }
      ++shown;
      const PlainRay ray =
        MakePlainRay(scene.Grid, SlicePlanes(), p % scene.Grid.Width, p / scene.Grid.Width);
      double height = plane[3];
      double scalar = 0;
      const double weights[3] = { 1, 0.5, 1.5 };
      for (int a = 0; a < 3; ++a)
      {
        height += plane[a] * (ray.Start.X[a] + picture.Depths[p] * ray.Direction.X[a]);
        scalar += weights[a] * (ray.IndexStart.X[a] + picture.Depths[p] * ray.IndexDirection.X[a]);
      }
      const double length = std::hypot(plane[0], plane[1], plane[2]);
      EXPECT_NEAR(height / length, 0, 1e-5); // the depth in single precision
      EXPECT_NEAR(picture.Colors[4 * p + 3], 0.1 + 0.008 * scalar, RoundingError);
    }
    EXPECT_GT(shown, 100);
  }
}

TEST(ImageBlends, SliceAlongTheRaysShowsNothing)
{
  Scene scene = MakeLine(ImageBlend::Slice);
  scene.Optics.SlicePlane = { 0, 1, 0, -0.8 };
  EXPECT_EQ(Cast(scene).Colors[3], 0.f);
}

TEST(ImageBlends, InvalidOptics)
{
  const auto expect = [](
                        const std::string& message, const std::function<void(ImageOptics&)>& change)
  {
    ImageOptics optics = MakeLine(ImageBlend::Composite).Optics;
    change(optics);
    ImageCaster caster;
    try
    {
      caster.SetOptics(optics);
      ADD_FAILURE() << message;
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  expect("averaged", [](ImageOptics& optics) { optics.AverageRange[0] = Infinity; });
  expect("averaged", [](ImageOptics& optics) { optics.AverageRange[1] = NotANumber; });
  expect("black and white", [](ImageOptics& optics) { optics.GreyRange[1] = 0; });
  expect("black and white", [](ImageOptics& optics) { optics.GreyRange[0] = -Infinity; });
  expect("isosurface",
    [](ImageOptics& optics) {
      optics.Surfaces = { { NotANumber, { 1, 1, 1 }, 1 } };
    });
  expect("isosurface", [](ImageOptics& optics) { optics.Surfaces = { { 1, { 1, 1, 1 }, 1.5f } }; });
  expect("plane of a slice", [](ImageOptics& optics) { optics.SlicePlane = { 0, 0, 0, 1 }; });
}

} // namespace
} // namespace tetralux
