// SPDX-License-Identifier: BSD-3-Clause
#include "BlendScene.h"

#include "Optics/IntervalTable.h"
#include "PlainRays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

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

/// World distances between which the ray counts, in ascending parts.
std::vector<std::array<double, 2>> FindParts(
  const BlendScene& scene, const PlainRay& ray, int pixel)
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
    cut(ray.IndexStart[a], ray.IndexDirection[a]);
    cut(scene.Dimensions[a] - 1 - ray.IndexStart[a], -ray.IndexDirection[a]);
  }
  for (const std::array<double, 4>& plane : scene.Limits.Planes)
  {
    const PlainVector normal = { plane[0], plane[1], plane[2] };
    cut(Dot(normal, ray.Start) + plane[3], Dot(normal, ray.Direction));
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
      (scene.Limits.CroppingPlanes[p] - ray.IndexStart[p / 2]) / ray.IndexDirection[p / 2];
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
      const double x = ray.IndexStart[a] + t * ray.IndexDirection[a];
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
double FindScalar(const BlendScene& scene, const PlainRay& ray, double t, bool& close)
{
  const PlainPlace place(scene.Dimensions, ray.GetIndex(t));
  for (const double share : place.Share)
  {
    close = close || share < Doubt || share > 1 - Doubt;
  }
  bool finite = true;
  const double value = place.Interpolate(
    [&](const std::array<int, 3>& point)
    {
      const float v =
        scene.Values[(static_cast<std::size_t>(point[2]) * scene.Dimensions[1] + point[1]) *
            scene.Dimensions[0] +
          point[0]];
      finite = finite && std::isfinite(v);
      return v;
    });
  return finite ? scene.Offset + scene.Scale * value : NotANumber;
}

class PlainCaster
{
public:
  explicit PlainCaster(const BlendScene& scene)
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
    const PlainVector normal = { plane[0], plane[1], plane[2] };
    const double t = -(Dot(normal, ray.Start) + plane[3]) / Dot(normal, ray.Direction);
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

  const BlendScene& S;
  SlicePlanes Slices;
  bool HasEmptyCells = false;
  double Width; ///< of the scalars
  bool ShortSamples = false;
  PlainPixel Pixel;
};

/// Of a channel: what 8 bits show.
constexpr double VisibleError = 1. / 255;
/// Of a depth, in slabs: a position in single precision.
constexpr double DepthError = 1e-3;

/// Balls in nothing, with noise.
void FillBalls(BlendScene& scene, std::mt19937& random)
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

} // namespace

const char* GetName(ImageBlend blend)
{
  const char* const names[] = { "composite", "maximum", "minimum", "average", "additive",
    "isosurfaces", "slice" };
  return names[static_cast<int>(blend)];
}

BlendPicture Cast(const BlendScene& scene)
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
  BlendPicture picture;
  const std::size_t pixels = static_cast<std::size_t>(scene.Grid.Width) * scene.Grid.Height;
  picture.Colors.resize(4 * pixels);
  picture.Depths.resize(pixels);
  picture.Statistics =
    caster.Cast(scene.Grid, limits, scene.Options, picture.Colors, picture.Depths);
  return picture;
}

int ExpectPlain(const BlendScene& scene, const BlendPicture& picture)
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

void SetView(BlendScene& scene, std::mt19937& random, bool parallel)
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
  PlainVector n;
  for (double& x : n)
  {
    x = Uniform(random, -1, 1);
  }
  const double length = std::sqrt(Dot(n, n));
  PlainVector right = { -n[1], n[0], 0 };
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

void Invert(BlendScene& scene)
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

BlendScene MakeBlendScene(std::mt19937& random, ImageBlend blend, bool parallel, int nodes)
{
  BlendScene scene;
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
  PlainVector normal, middle;
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

void ForEachScene(int nodes, const std::function<void(BlendScene&, std::mt19937&)>& check)
{
  std::mt19937 random(7);
  for (const ImageBlend blend : Blends)
  {
    for (const bool parallel : { false, true })
    {
      const testing::ScopedTrace trace(__FILE__, __LINE__,
        std::string(GetName(blend)) + (parallel ? ", parallel" : ", perspective"));
      BlendScene scene = MakeBlendScene(random, blend, parallel, nodes);
      check(scene, random);
    }
  }
}

} // namespace tetralux
