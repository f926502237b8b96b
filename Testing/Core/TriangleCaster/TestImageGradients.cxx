// SPDX-License-Identifier: BSD-3-Clause

// Gradients of image data, and what is done with them: opacity, tables, lights; and depth cueing.

#include "GradientReference.h"

#include "Optics/IntervalTable.h"
#include "PlainRays.h"
#include "ReferenceScenes.h"
#include "TriangleCaster/TransferTableEvaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

constexpr ImageScalar Types[] = { ImageScalar::Int8, ImageScalar::UInt8, ImageScalar::Int16,
  ImageScalar::UInt16, ImageScalar::Float };
constexpr GradientNorm Norms[] = { GradientNorm::Euclidean, GradientNorm::Sum };
constexpr GradientSource Sources[] = { GradientSource::OnTheFly, GradientSource::Bytes };
constexpr LightSum Sums[] = { LightSum::Direct, LightSum::NearestEntry, LightSum::Interpolated };

/// Of a channel: a sample's place, value and gradient have single precision, and a ramp of opacity
/// over the gradient's length multiplies that by ten.
constexpr double GradientRounding = 2e-6;
/// Of a channel: the same of directions, which highlights of a power of 20 turn into light.
constexpr double LightRounding = 1e-5;
/// Of a channel, for each column and row of a table of any numbers: its slopes grow with those.
constexpr double TableRounding = 3e-7;
/// Of a channel of a constant volume of some slabs.
constexpr double ConstantError = 1e-6;

/// Of a channel: the largest and mean difference of two pictures.
struct Difference
{
  double Largest = 0;
  double Mean = 0;
};

template <class A, class B>
Difference Compare(const A& a, const B& b)
{
  Difference difference;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    const double d = std::abs(static_cast<double>(a[k]) - b[k]);
    // What is not a number is larger than any.
    difference.Largest = d <= difference.Largest ? difference.Largest : d;
    difference.Mean += d / a.size();
  }
  return difference;
}

/// Pixels that show anything.
int CountVisible(const CastPicture& picture)
{
  return static_cast<int>(
    std::count_if(picture.Depths.begin(), picture.Depths.end(), [](float d) { return d >= 0; }));
}

bool IsFinite(const CastPicture& picture)
{
  return std::all_of(
    picture.Colors.begin(), picture.Colors.end(), [](float c) { return std::isfinite(c); });
}

Light MakeDistantLight(const std::array<double, 3>& direction, const std::array<float, 3>& color)
{
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  Light light{};
  for (int c = 0; c < 3; ++c)
  {
    light.Position[c] = direction[c] / length;
    light.Ambient[c] = 0.5f * color[c];
    light.Diffuse[c] = color[c];
    light.Specular[c] = 0.8f * color[c];
  }
  light.Positional = false;
  return light;
}

/// One that shines from the viewer, of ImagePlacement::Parallel and about that of the others.
Light MakeHeadlight() { return MakeDistantLight({ 0.61, 0.43, 0.67 }, { 1, 1, 1 }); }

Light MakePositionalLight(const std::array<double, 3>& position)
{
  Light light = MakeDistantLight({ 1, 0, 0 }, { 0.9f, 1, 0.7f });
  std::copy(position.begin(), position.end(), light.Position);
  light.Positional = true;
  light.Attenuation[0] = 0.5;
  light.Attenuation[1] = 0.02;
  light.Attenuation[2] = 0.001;
  return light;
}

/// Shines past the middle of a volume around 0.
Light MakeSpot(const std::array<double, 3>& position, double coneCosine)
{
  Light light = MakePositionalLight(position);
  const double length = std::hypot(position[0], position[1], position[2]);
  for (int a = 0; a < 3; ++a)
  {
    light.Axis[a] = -position[a] / length;
  }
  light.ConeCosine = coneCosine;
  light.Exponent = 3;
  return light;
}

/// A smooth volume whose points have other distances along each axis, and scalars 0..1.
ImageScene MakeScene(ImageScalar type, ImagePlacement::Camera camera = ImagePlacement::Perspective)
{
  ImageScene scene = MakeSmoothImageScene();
  scene.SetValues(type, MakeSmoothShares(scene.Dimensions));
  const double ranges[] = { 255, 255, 65535, 65535, 1 };
  const double range = ranges[static_cast<int>(type)];
  scene.Scale = 1 / range;
  scene.Offset = type == ImageScalar::Int8 || type == ImageScalar::Int16 ? 0.5 + 0.5 / range : 0;
  scene.Optics.Function = MakeLinearFunction(
    { { 0.3, 0.2, 0.4, 1, 0.05 }, { 0.6, 1, 0.5, 0.2, 0.3 }, { 0.9, 0.3, 1, 0.1, 0.7 } });
  scene.Optics.UnitDistance = 1.1;
  scene.Optics.GradientLength = 1.2;
  ImagePlacement placement;
  placement.Spacing = { 1, 0.7, 1.6 };
  placement.Apply(scene, camera, 44, 33);
  scene.Options.SampleDistance = 0.8;
  scene.Options.Surface.SpecularPower = 20;
  return scene;
}

/// With an opacity that grows over the gradients that scenes have.
ImageScene MakeGradientScene(
  ImageScalar type, ImagePlacement::Camera camera = ImagePlacement::Perspective)
{
  ImageScene scene = MakeScene(type, camera);
  scene.Optics.GradientOpacity =
    MakeLinearFunction({ { 0.02, 0, 0, 0, 0.1 }, { 0.1, 0, 0, 0, 0.6 }, { 0.25, 0, 0, 0, 1 } });
  return scene;
}

ImageScene MakeLitScene(
  ImageScalar type, ImagePlacement::Camera camera = ImagePlacement::Perspective)
{
  ImageScene scene = MakeScene(type, camera);
  scene.Options.Shaded = true;
  scene.Options.Lights = { MakeHeadlight() };
  return scene;
}

/// A scalar whose gradient, in steps of points, is the same everywhere.
void SetLinear(ImageScene& scene, const std::array<double, 3>& gradient)
{
  std::vector<double> values;
  const std::array<int, 3>& n = scene.Dimensions;
  for (int p = 0; p < n[0] * n[1] * n[2]; ++p)
  {
    values.push_back(gradient[0] * (p % n[0]) + gradient[1] * (p / n[0] % n[1]) +
      gradient[2] * (p / (n[0] * n[1])));
  }
  scene.SetValues(ImageScalar::Float, values);
  scene.Scale = 1;
  scene.Offset = 0;
}

/// A table of any numbers over 0..1 and the gradients that scenes have.
TransferTable MakeRandomTable(int columns, int rows)
{
  std::mt19937_64 generator(columns * rows);
  std::uniform_real_distribution<float> unit(0, 1);
  TransferTable table;
  table.Columns = columns;
  table.Rows = rows;
  table.FirstScalar = 0.2;
  table.LastScalar = 0.8;
  table.FirstLength = 0.03;
  table.LastLength = 0.2;
  table.Entries.resize(static_cast<std::size_t>(columns) * rows);
  for (TransferTable::Entry& entry : table.Entries)
  {
    for (float& channel : entry.Color)
    {
      channel = unit(generator);
    }
    entry.Opacity = std::max(0.f, unit(generator) - 0.4f);
  }
  return table;
}

/// The product of an optics' functions, at entries over all of their nodes.
TransferTable MakeProductTable(const ImageOptics& optics, int columns, int rows)
{
  TransferTable table;
  table.Columns = columns;
  table.Rows = rows;
  table.FirstScalar = optics.Function.Nodes.front().Scalar;
  table.LastScalar = optics.Function.Nodes.back().Scalar;
  table.FirstLength = optics.GradientOpacity.Nodes.front().Scalar;
  table.LastLength = optics.GradientOpacity.Nodes.back().Scalar;
  for (int j = 0; j < rows; ++j)
  {
    const double length =
      table.FirstLength + (table.LastLength - table.FirstLength) * j / (rows - 1);
    for (int i = 0; i < columns; ++i)
    {
      const double scalar =
        table.FirstScalar + (table.LastScalar - table.FirstScalar) * i / (columns - 1);
      const TransferFunction::Value value = Evaluate(optics.Function, scalar);
      TransferTable::Entry entry;
      for (int c = 0; c < 3; ++c)
      {
        entry.Color[c] = static_cast<float>(value.Color[c]);
      }
      entry.Opacity = static_cast<float>(
        value.Attenuation * Evaluate(optics.GradientOpacity, length).Attenuation);
      table.Entries.push_back(entry);
    }
  }
  return table;
}

void ExpectGradientReference(const ImageScene& scene, double tolerance)
{
  const CastPicture picture = Cast(scene);
  EXPECT_GT(CountVisible(picture), 200);
  EXPECT_LE(Compare(picture.Colors, RenderWithGradients(scene)).Largest, tolerance);
}

//------------------------------------------------------------------------------------------------
// Gradients

TEST(ImageGradients, AreCentralDifferences)
{
  for (const ImageScalar type : Types)
  {
    for (const GradientNorm norm : Norms)
    {
      for (const bool portable : { false, true })
      {
        SCOPED_TRACE(testing::Message() << "type " << static_cast<int>(type) << ", norm "
                                        << static_cast<int>(norm) << ", portable " << portable);
        ImageScene scene = MakeGradientScene(type);
        scene.Optics.Norm = norm;
        scene.Options.PortableKernels = portable;
        ExpectGradientReference(scene, GradientRounding);
        scene.Optics.Opacity = StepOpacity::Attenuation;
        scene.Options.Shape = SliceShape::Shells;
        ExpectGradientReference(scene, GradientRounding);
      }
    }
  }
}

TEST(ImageGradients, AreOneSidedAtBorders)
{
  // All cells are at borders.
  for (const std::array<int, 3>& dimensions :
    { std::array<int, 3>{ 2, 2, 2 }, { 3, 2, 3 }, { 2, 9, 3 } })
  {
    for (const ImageScalar type : Types)
    {
      SCOPED_TRACE(testing::Message() << dimensions[0] << ", type " << static_cast<int>(type));
      ImageScene scene = MakeGradientScene(type);
      scene.Dimensions = dimensions;
      scene.SetValues(type, MakeSmoothShares(dimensions));
      scene.Optics.GradientOpacity.Nodes.back().Scalar = 0.7;
      ImagePlacement().Apply(scene, ImagePlacement::Perspective, 44, 33);
      scene.Options.SampleDistance = 0.3;
      ExpectGradientReference(scene, GradientRounding);
    }
  }
}

TEST(ImageGradients, OfLinearScalarsAreConstant)
{
  // The same up to the border, so the opacity is that of a constant volume.
  ImageScene scene = MakeScene(ImageScalar::Float, ImagePlacement::Parallel);
  SetLinear(scene, { 0.3, -0.2, 0.05 });
  scene.Optics.Function = MakeConstantFunction(0.2, { 1, 1, 1 });
  scene.Optics.GradientOpacity = MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 2, 0, 0, 0, 1 } });
  double world[3] = { 0, 0, 0 };
  const double gradient[3] = { 0.3, -0.2, 0.05 };
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      world[a] += scene.Grid.MeshFromWorld[b][a] * gradient[b];
    }
  }
  const double lengths[] = { std::hypot(world[0], world[1], world[2]),
    std::abs(world[0]) + std::abs(world[1]) + std::abs(world[2]) };
  for (const GradientNorm norm : Norms)
  {
    for (const GradientSource source : Sources)
    {
      SCOPED_TRACE(static_cast<int>(norm));
      scene.Optics.Norm = norm;
      scene.Options.Gradients = source;
      const CastPicture lit = Cast(scene);
      ImageScene constant = scene;
      const double factor = scene.Optics.GradientLength * lengths[static_cast<int>(norm)] / 2;
      constant.Optics.Function = MakeConstantFunction(0.2 * factor, { 1, 1, 1 });
      constant.Optics.GradientOpacity.Nodes.clear();
      // Bytes have half of 1/127 of the largest component; all three may be off by that.
      const double tolerance = source == GradientSource::Bytes ? 0.5 / 127 * 3 : GradientRounding;
      EXPECT_LE(FindDifference(lit, Cast(constant)), tolerance);
      EXPECT_GT(CountVisible(lit), 200);
    }
  }
}

TEST(ImageGradients, MayLeaveOpacityAsItIs)
{
  // A factor of 1 everywhere, where scalars come with the bytes, and where they do not.
  for (const ImageScalar type : Types)
  {
    ImageScene scene = MakeScene(type);
    const CastPicture plain = Cast(scene);
    scene.Optics.GradientOpacity = MakeConstantFunction(1, { 0, 0, 0 });
    for (const GradientSource source : Sources)
    {
      scene.Options.Gradients = source;
      EXPECT_TRUE(IsSame(Cast(scene), plain)) << static_cast<int>(type);
    }
  }
}

TEST(ImageGradients, BesideWhatIsNotANumberAreNone)
{
  const float odd[] = { NaN, std::numeric_limits<float>::infinity(),
    -std::numeric_limits<float>::max() };
  for (const float value : odd)
  {
    for (const GradientSource source : Sources)
    {
      for (const LightSum sum : Sums)
      {
        SCOPED_TRACE(
          testing::Message() << value << ", " << static_cast<int>(source) << static_cast<int>(sum));
        ImageScene scene = MakeLitScene(ImageScalar::Float, ImagePlacement::Parallel);
        scene.Optics.GradientOpacity = MakeGradientScene(ImageScalar::Float).Optics.GradientOpacity;
        scene.Options.Gradients = source;
        scene.Options.SumOfLights = sum;
        const CastPicture whole = Cast(scene);
        const std::size_t point = 16 + 33 * (10 + 20 * 8);
        std::memcpy(&scene.Values[point * sizeof(float)], &value, sizeof(float));
        const CastPicture picture = Cast(scene);
        EXPECT_TRUE(IsFinite(picture));
        int changed = 0;
        for (std::size_t k = 0; k < picture.Colors.size(); ++k)
        {
          changed += std::abs(picture.Colors[k] - whole.Colors[k]) > GradientRounding ? 1 : 0;
        }
        EXPECT_GT(changed, 0);
        // Bytes of a volume with a number as large as that have nothing left of the others.
        if (std::isfinite(value) && source == GradientSource::Bytes)
        {
          continue;
        }
        // Three cells around a point of 33 x 20 x 17.
        EXPECT_LT(changed, static_cast<int>(picture.Colors.size()) / 4);
      }
    }
  }
}

TEST(ImageGradients, MayBeOfAnySize)
{
  for (const double size : { 1e-42, 1e-30, 1e30, 1e38 })
  {
    for (const GradientSource source : Sources)
    {
      for (const LightSum sum : Sums)
      {
        SCOPED_TRACE(
          testing::Message() << size << ", " << static_cast<int>(source) << static_cast<int>(sum));
        ImageScene scene = MakeLitScene(ImageScalar::Float, ImagePlacement::Parallel);
        std::vector<double> values = MakeSmoothShares(scene.Dimensions);
        for (double& value : values)
        {
          value *= size;
        }
        scene.SetValues(ImageScalar::Float, values);
        scene.Scale = 1 / size;
        scene.Options.Gradients = source;
        scene.Options.SumOfLights = sum;
        EXPECT_TRUE(IsFinite(Cast(scene)));
      }
    }
  }
}

//------------------------------------------------------------------------------------------------
// Bytes

TEST(ImageGradientBytes, AreExactWhereComponentsAre)
{
  // All of them are multiples of 1/127 of the largest one.
  for (const std::array<double, 3>& gradient :
    { std::array<double, 3>{ 127, -64, 32 }, { -5, 127, 90 }, { 33, 101, -127 } })
  {
    ImageScene scene = MakeLitScene(ImageScalar::Float);
    SetLinear(scene, { gradient[0] / 4096, gradient[1] / 4096, gradient[2] / 4096 });
    scene.Optics.Function = MakeConstantFunction(0.3, { 0.2, 1, 0.6 });
    scene.Optics.GradientOpacity = MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 0.1, 0, 0, 0, 1 } });
    const CastPicture picture = Cast(scene);
    scene.Options.Gradients = GradientSource::Bytes;
    EXPECT_LE(FindDifference(Cast(scene), picture), GradientRounding);
    EXPECT_GT(CountVisible(picture), 200);
  }
}

TEST(ImageGradientBytes, AreWithinHalfAStep)
{
  // Components are off by half of 1/127 of the largest one, and the ramp of opacity is steep.
  constexpr double OpacityError = 4e-3;
  // Directions of gradients that are a tenth of the largest one are off by some degrees.
  constexpr double LitError = 0.1;
  constexpr double MeanError = 3e-4;
  for (const ImageScalar type : Types)
  {
    SCOPED_TRACE(static_cast<int>(type));
    ImageScene scene = MakeGradientScene(type);
    CastPicture picture = Cast(scene);
    scene.Options.Gradients = GradientSource::Bytes;
    Difference difference = Compare(Cast(scene).Colors, picture.Colors);
    EXPECT_LE(difference.Largest, OpacityError);
    EXPECT_GT(difference.Largest, 0); // other gradients

    scene = MakeLitScene(type);
    scene.Options.Lights.push_back(MakePositionalLight({ 10, -20, 15 }));
    picture = Cast(scene);
    scene.Options.Gradients = GradientSource::Bytes;
    difference = Compare(Cast(scene).Colors, picture.Colors);
    EXPECT_LE(difference.Largest, LitError);
    EXPECT_LE(difference.Mean, MeanError);
  }
}

TEST(ImageGradientBytes, AreMadeAgainForANewVolume)
{
  for (const ImageScalar type : { ImageScalar::UInt8, ImageScalar::Float })
  {
    ImageScene scene = MakeGradientScene(type);
    scene.Options.Gradients = GradientSource::Bytes;
    ImageCaster caster;
    caster.SetVolume(scene.GetVolume());
    caster.SetOptics(scene.Optics);
    Cast(caster, scene);
    std::vector<double> shares = MakeSmoothShares(scene.Dimensions);
    std::reverse(shares.begin(), shares.end());
    scene.SetValues(type, shares);
    caster.SetVolume(scene.GetVolume());
    EXPECT_TRUE(IsSame(Cast(caster, scene), Cast(scene)));
  }
}

//------------------------------------------------------------------------------------------------
// Lights

TEST(ImageLights, AreThoseOfThePlainLoop)
{
  const Light headlight = MakeHeadlight();
  const Light side = MakeDistantLight({ -0.4, 1, 0.3 }, { 1, 0.4f, 0.2f });
  const Light positional = MakePositionalLight({ 14, -9, 25 });
  const Light spot = MakeSpot({ 20, 25, 30 }, std::cos(0.2));
  const Light wide = MakeSpot({ -30, 25, 30 }, std::cos(1.8));
  const std::vector<Light> sets[] = { { headlight }, { side }, { positional }, { spot },
    { headlight, side, positional, spot, wide }, {} };
  for (const std::vector<Light>& lights : sets)
  {
    for (const ImageScalar type : Types)
    {
      for (const bool portable : { false, true })
      {
        SCOPED_TRACE(testing::Message() << lights.size() << " lights, type "
                                        << static_cast<int>(type) << ", portable " << portable);
        ImageScene scene = MakeLitScene(type);
        scene.Options.Lights = lights;
        scene.Options.PortableKernels = portable;
        ExpectGradientReference(scene, LightRounding);
      }
    }
  }
}

// Of sums of squares central differences are exact, and so are the gradients between them.
TEST(ImageLights, ShineOnIsosurfaces)
{
  const std::array<double, 3> middle = { 10.3, 9.1, 11.8 };
  const std::array<double, 3> factors = { 1, 1.5, 0.7 };
  ImageScene scene;
  scene.Dimensions = { 22, 20, 24 };
  std::vector<double> squares;
  for (int k = 0; k < 24; ++k)
  {
    for (int j = 0; j < 20; ++j)
    {
      for (int i = 0; i < 22; ++i)
      {
        squares.push_back(factors[0] * std::pow(i - middle[0], 2) +
          factors[1] * std::pow(j - middle[1], 2) + factors[2] * std::pow(k - middle[2], 2));
      }
    }
  }
  scene.SetValues(ImageScalar::Float, squares);
  scene.Optics.Function.Nodes = { { 0, { { 1, 1, 1 }, 0 }, { { 1, 1, 1 }, 0 } } };
  scene.Optics.Blend = ImageBlend::Isosurfaces;
  Isosurface surface;
  surface.Value = 49;
  surface.Color[0] = 0.9f;
  surface.Color[1] = 0.6f;
  surface.Color[2] = 0.3f;
  surface.Opacity = 1;
  scene.Optics.Surfaces = { surface };
  scene.Options.Shaded = true;
  scene.Options.Surface.Ambient = 0.1f;
  scene.Options.Surface.Diffuse = 0.7f;
  scene.Options.Surface.Specular = 0.4f;
  scene.Options.Surface.SpecularPower = 12;
  scene.Options.Lights = { MakeHeadlight(), MakePositionalLight({ 14, -9, 25 }) };
  scene.Options.SampleDistance = 0.7;
  const std::array<double, 3> color = { surface.Color[0], surface.Color[1], surface.Color[2] };
  for (const auto camera : { ImagePlacement::Perspective, ImagePlacement::Parallel })
  {
    ImagePlacement placement;
    placement.Spacing = { 1.1, 0.9, 1.2 };
    placement.Apply(scene, camera, 72, 60);
    for (const GradientSource source : { GradientSource::OnTheFly, GradientSource::Bytes })
    {
      scene.Options.Gradients = source;
      // Bytes turn normals by up to a half in 127.
      const double tolerance = source == GradientSource::OnTheFly ? 1e-4 : 0.02;
      const CastPicture picture = Cast(scene);
      int seen = 0;
      for (int pixel = 0; pixel < scene.GetNumberOfPixels(); ++pixel)
      {
        if (picture.Depths[pixel] < 0)
        {
          continue;
        }
        ++seen;
        const int i = pixel % scene.Grid.Width;
        const int j = pixel / scene.Grid.Width;
        const PlainRay ray = MakePlainRay(scene.Grid, SlicePlanes(), i, j);
        const PlainVector index = ray.GetIndex(picture.Depths[pixel]);
        PlainVector gradient;
        for (int a = 0; a < 3; ++a)
        {
          gradient[a] = 2 * factors[a] * (index[a] - middle[a]);
        }
        const PlainVector lit = Shine(scene.Options.Lights, scene.Options.Surface, color,
          ToWorld(scene.Grid, gradient), ray.GetPoint(picture.Depths[pixel]), ray.Direction);
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(picture.Colors[4 * pixel + c], lit[c], tolerance) << i << " " << j;
        }
      }
      EXPECT_GT(seen, 300);
    }
  }
}

TEST(ImageLights, ShineOnWhatGradientsLeave)
{
  for (int camera = 0; camera < ImagePlacement::NumberOfCameras; ++camera)
  {
    SCOPED_TRACE(camera);
    ImageScene scene =
      MakeGradientScene(ImageScalar::UInt16, static_cast<ImagePlacement::Camera>(camera));
    scene.Options.Shaded = true;
    scene.Options.Lights = { MakeHeadlight(), MakePositionalLight({ 14, -9, 25 }) };
    ExpectGradientReference(scene, LightRounding);
  }
}

//------------------------------------------------------------------------------------------------
// The intensity map

/// Of a channel: a cell of the map of 32 directions along the edge of a face has an angle of 3.7
/// degrees at most, and light of a power of 20 changes by some percents over half of it.
constexpr double NearestError = 0.03;
/// Of a channel: linearly interpolated, light is off by the square of that.
constexpr double InterpolatedError = 8e-3;
constexpr double InterpolatedMean = 1e-4;
/// Of a channel: the view of a pixel is up to 16 degrees from that of the centre, so highlights are
/// at other places.
constexpr double PerspectiveError = 0.1;
constexpr double PerspectiveMean = 1e-3;

TEST(ImageIntensityMap, IsExactAtItsEntries)
{
  // Entries of each face, and of both sides of it.
  const auto place = [](int k) { return 2. * k / 31 - 1; };
  const int entries[][2] = { { 0, 0 }, { 31, 4 }, { 7, 20 }, { 16, 30 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1., 1. })
    {
      for (const auto& entry : entries)
      {
        SCOPED_TRACE(testing::Message() << axis << ", " << side << ", " << entry[0]);
        std::array<double, 3> gradient;
        gradient[axis] = 0.04 * side;
        gradient[(axis + 1) % 3] = 0.04 * side * place(entry[0]);
        gradient[(axis + 2) % 3] = 0.04 * side * place(entry[1]);
        ImageScene scene = MakeLitScene(ImageScalar::Float, ImagePlacement::Parallel);
        SetLinear(scene, gradient);
        scene.Optics.Function = MakeConstantFunction(0.3, { 0.2, 1, 0.6 });
        scene.Options.Lights = { MakeHeadlight(),
          MakeDistantLight({ -0.4, 1, 0.3 }, { 1, 0.4f, 0.2f }) };
        const CastPicture picture = Cast(scene);
        for (const LightSum sum : { LightSum::NearestEntry, LightSum::Interpolated })
        {
          scene.Options.SumOfLights = sum;
          EXPECT_LE(FindDifference(Cast(scene), picture), LightRounding);
        }
      }
    }
  }
}

TEST(ImageIntensityMap, IsNearDirectLight)
{
  for (const ImageScalar type : Types)
  {
    SCOPED_TRACE(static_cast<int>(type));
    ImageScene scene = MakeLitScene(type, ImagePlacement::Parallel);
    const CastPicture picture = Cast(scene);
    scene.Options.SumOfLights = LightSum::NearestEntry;
    const Difference nearest = Compare(Cast(scene).Colors, picture.Colors);
    scene.Options.SumOfLights = LightSum::Interpolated;
    const Difference interpolated = Compare(Cast(scene).Colors, picture.Colors);
    EXPECT_LE(nearest.Largest, NearestError);
    EXPECT_LE(interpolated.Largest, InterpolatedError);
    EXPECT_LE(interpolated.Mean, InterpolatedMean);
    EXPECT_LT(interpolated.Mean, 0.5 * nearest.Mean);
    EXPECT_GT(interpolated.Mean, 0); // another way

    scene = MakeLitScene(type, ImagePlacement::Perspective);
    const CastPicture perspective = Cast(scene);
    scene.Options.SumOfLights = LightSum::Interpolated;
    const Difference ofOneView = Compare(Cast(scene).Colors, perspective.Colors);
    EXPECT_LE(ofOneView.Largest, PerspectiveError);
    EXPECT_LE(ofOneView.Mean, PerspectiveMean);
    EXPECT_GT(ofOneView.Mean, interpolated.Mean);
  }
}

TEST(ImageIntensityMap, HasWhatHasNoGradient)
{
  // It faces the viewer.
  ImageScene scene = MakeLitScene(ImageScalar::Float, ImagePlacement::Parallel);
  SetLinear(scene, { 0, 0, 0 });
  scene.Optics.Function = MakeConstantFunction(0.3, { 0.2, 1, 0.6 });
  const CastPicture picture = Cast(scene);
  EXPECT_LE(Compare(picture.Colors, RenderWithGradients(scene)).Largest, LightRounding);
  for (const GradientSource source : Sources)
  {
    scene.Options.Gradients = source;
    for (const LightSum sum : Sums)
    {
      scene.Options.SumOfLights = sum;
      EXPECT_LE(FindDifference(Cast(scene), picture), LightRounding);
    }
  }
}

TEST(ImageIntensityMap, FollowsLightsMaterialAndView)
{
  ImageScene scene = MakeLitScene(ImageScalar::UInt8);
  scene.Options.SumOfLights = LightSum::Interpolated;
  ImageCaster caster;
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  const std::function<void()> changes[] = { [] {},
    [&] {
      scene.Options.Lights.push_back(MakeDistantLight({ 0, 1, 0 }, { 1, 1, 0 }));
    },
    [&] { scene.Options.Lights[1].Position[0] = 1; },
    [&] { scene.Options.Lights[0].Specular[2] = 0; },
    [&] { scene.Options.Lights[0].Diffuse[1] = 0.1f; },
    [&] { scene.Options.Lights[1].Ambient[0] = 2; },
    [&] { scene.Options.Surface.SpecularPower = 3; }, [&] { scene.Options.Surface.Diffuse = 0.2f; },
    [&] { scene.Options.Surface.Specular = 0; },
    [&] { ImagePlacement().Apply(scene, ImagePlacement::Perspective, 30, 33); },
    [&] { ImagePlacement().Apply(scene, ImagePlacement::Parallel, 30, 33); },
    [&] { scene.Options.Lights.pop_back(); } };
  CastPicture last;
  for (std::size_t k = 0; k < std::size(changes); ++k)
  {
    SCOPED_TRACE(k);
    changes[k]();
    const CastPicture picture = Cast(caster, scene);
    EXPECT_TRUE(IsSame(picture, Cast(scene)));
    EXPECT_FALSE(IsSame(picture, last));
    last = picture;
  }
}

TEST(ImageIntensityMap, TakesDistantLightsOnly)
{
  ImageScene scene = MakeLitScene(ImageScalar::Float);
  scene.Options.Lights.push_back(MakePositionalLight({ 10, 0, 0 }));
  scene.Options.SumOfLights = LightSum::Interpolated;
  EXPECT_THROW(Cast(scene), std::invalid_argument);
  scene.Options.SumOfLights = LightSum::NearestEntry;
  EXPECT_THROW(Cast(scene), std::invalid_argument);
  scene.Options.Shaded = false;
  EXPECT_NO_THROW(Cast(scene));
}

//------------------------------------------------------------------------------------------------
// Tables over scalars and gradients

TEST(ImageTransferTable, IsBilinear)
{
  const int sizes[][2] = { { 2, 2 }, { 5, 3 }, { 2, 40 }, { 64, 32 }, { 300, 2 } };
  for (const auto& size : sizes)
  {
    for (const ImageScalar type : Types)
    {
      for (const bool portable : { false, true })
      {
        SCOPED_TRACE(testing::Message() << size[0] << " x " << size[1] << ", type "
                                        << static_cast<int>(type) << ", portable " << portable);
        ImageScene scene = MakeScene(type);
        scene.Optics.Function.Nodes.clear(); // is not looked at
        scene.Optics.Table = MakeRandomTable(size[0], size[1]);
        scene.Optics.Norm = size[1] == 3 ? GradientNorm::Sum : GradientNorm::Euclidean;
        scene.Options.PortableKernels = portable;
        ExpectGradientReference(scene, TableRounding * (size[0] + size[1]));
      }
    }
  }
}

TEST(ImageTransferTable, HasProductsOfFunctions)
{
  // Both are linear between entries, so the table is their product.
  ImageScene scene = MakeGradientScene(ImageScalar::UInt16);
  const CastPicture product = Cast(scene);
  scene.Optics.GradientOpacity.Nodes[1].Scalar = 0.135;
  scene.Optics.GradientOpacity.Nodes[1].Left.Attenuation = 0.6;
  const CastPicture moved = Cast(scene);
  EXPECT_GT(FindDifference(product, moved), 10 * GradientRounding);
  scene.Optics.Table = MakeProductTable(scene.Optics, 3, 3);
  EXPECT_LE(FindDifference(Cast(scene), moved), GradientRounding);
}

TEST(ImageTransferTable, MayHaveReducedPrecision)
{
  // Between 32 entries over a node, opacity is off by a quarter of what its slope changes in a
  // cell, of some samples.
  constexpr double FiveBitError = 5e-3;
  for (const GradientSource source : Sources)
  {
    ImageScene scene = MakeGradientScene(ImageScalar::UInt8);
    scene.Options.Gradients = source;
    scene.Optics.Table = MakeProductTable(scene.Optics, 1024, 1024);
    const CastPicture full = Cast(scene);
    scene.Optics.Table = Resample(scene.Optics.Table, 32, 32);
    const CastPicture reduced = Cast(scene);
    EXPECT_LE(FindDifference(reduced, full), FiveBitError);
    EXPECT_GT(FindDifference(reduced, full), GradientRounding);
  }
}

TEST(ImageTransferTable, StaysWhenResampled)
{
  const TransferTable table = MakeRandomTable(5, 4);
  const TransferTable finer = Resample(table, 17, 31);
  for (const double scalar : { 0., 0.2, 0.31, 0.5, 0.8, 3. })
  {
    for (const double length : { -1., 0.03, 0.0623, 0.2, 1. })
    {
      const TransferTable::Entry a = Evaluate(table, scalar, length);
      const TransferTable::Entry b = Evaluate(finer, scalar, length);
      EXPECT_NEAR(a.Opacity, b.Opacity, ConstantError);
      EXPECT_NEAR(a.Color[2], b.Color[2], ConstantError);
    }
  }
  EXPECT_THROW(Resample(table, 1, 5), std::invalid_argument);
}

TEST(ImageTransferTable, LeavesOutWhatIsEmpty)
{
  // Columns that have opacity for some gradients, for none, and for all.
  ImageScene scene = MakeScene(ImageScalar::Float);
  scene.Options.SampleDistance = 0.2;
  TransferTable& table = scene.Optics.Table = MakeRandomTable(9, 4);
  for (std::size_t k = 0; k < table.Entries.size(); ++k)
  {
    const bool visible = k % 9 == 8 || (k % 9 == 6 && k / 9 == 2);
    table.Entries[k].Opacity = visible ? 0.5f : 0.f;
  }
  ExpectGradientReference(scene, GradientRounding);
  const CastPicture picture = Cast(scene);
  scene.Options.SkipEmptySpace = false;
  const CastPicture all = Cast(scene);
  EXPECT_TRUE(IsSame(picture, all));
  EXPECT_LT(picture.Statistics.Samples, all.Statistics.Samples);
}

TEST(ImageTransferTable, IsChecked)
{
  const std::function<void(TransferTable&)> faults[] = { [](TransferTable& t) { t.Columns = 1; },
    [](TransferTable& t) { t.Rows = 5; }, [](TransferTable& t) { t.Entries.pop_back(); },
    [](TransferTable& t) { t.LastScalar = t.FirstScalar; },
    [](TransferTable& t) { t.FirstScalar = NaN; }, [](TransferTable& t) { t.LastLength = -1; },
    [](TransferTable& t) { t.Entries[3].Opacity = -0.1f; },
    [](TransferTable& t) { t.Entries[2].Color[1] = NaN; } };
  const TransferTable valid = MakeRandomTable(4, 4);
  EXPECT_NO_THROW(CheckTable(valid));
  for (std::size_t k = 0; k < std::size(faults); ++k)
  {
    ImageOptics optics;
    optics.Table = valid;
    faults[k](optics.Table);
    EXPECT_THROW(ImageCaster().SetOptics(optics), std::invalid_argument) << k;
  }
}

//------------------------------------------------------------------------------------------------
// Depth cueing

TEST(ImageDepthCueing, IsLinearInDepth)
{
  // A constant volume along an axis, in one and in two slabs.
  ImageScene scene = MakeScene(ImageScalar::Float);
  scene.Optics.Function = MakeConstantFunction(0.1, { 1, 0.5, 0.25 });
  ImagePlacement placement;
  placement.Oblique = false;
  placement.Apply(scene, ImagePlacement::AlongAxis, 12, 9);
  const double depth = scene.Dimensions[2] - 1;
  scene.Optics.UnitDistance = depth;
  const float near[] = { 0.9f, 1.2f, 0 };
  const float far[] = { 0.1f, 1.2f, 2 };
  std::copy(near, near + 3, scene.Options.NearColor);
  std::copy(far, far + 3, scene.Options.FarColor);
  for (const bool preIntegrated : { false, true })
  {
    scene.Options.PreIntegrated = preIntegrated;
    for (const int slabs : { 1, 2 })
    {
      // The last slab ends with the volume, and not by rounding before it.
      scene.Options.SampleDistance = depth / slabs * (1 + 1e-9);
      const CastPicture picture = Cast(scene);
      ASSERT_EQ(picture.Statistics.Slices, slabs);
      const double alpha = 1 - std::pow(0.9, 1. / slabs);
      const double colors[] = { 1, 0.5, 0.25 };
      for (int c = 0; c < 3; ++c)
      {
        double expected = 0;
        for (int s = 0; s < slabs; ++s)
        {
          const double place = (s + 0.5) / slabs;
          expected += std::pow(1 - alpha, s) * alpha * (near[c] + place * (far[c] - near[c]));
        }
        const std::size_t middle = 4 * (4 * 12 + 6);
        EXPECT_NEAR(picture.Colors[middle + c], expected * colors[c], ConstantError);
      }
    }
  }
}

TEST(ImageDepthCueing, IsThatOfThePlainLoop)
{
  for (int camera = 0; camera < ImagePlacement::NumberOfCameras; ++camera)
  {
    for (const SliceShape shape : { SliceShape::Planes, SliceShape::Shells })
    {
      for (const bool shaded : { false, true })
      {
        SCOPED_TRACE(testing::Message()
          << "camera " << camera << ", shape " << static_cast<int>(shape) << ", shaded " << shaded);
        ImageScene scene =
          MakeLitScene(ImageScalar::UInt8, static_cast<ImagePlacement::Camera>(camera));
        scene.Options.Shape = shape;
        scene.Options.Shaded = shaded;
        scene.Options.NearColor[1] = 0.8f;
        scene.Options.FarColor[0] = 0.1f;
        ExpectGradientReference(scene, LightRounding);
      }
    }
  }
}

TEST(ImageDepthCueing, LeavesOpacityAsItIs)
{
  ImageScene scene = MakeScene(ImageScalar::Int16);
  const CastPicture plain = Cast(scene);
  scene.Options.FarColor[1] = 0.2f;
  const CastPicture cued = Cast(scene);
  EXPECT_EQ(cued.Depths, plain.Depths);
  for (std::size_t k = 0; k < plain.Colors.size(); k += 4)
  {
    EXPECT_EQ(cued.Colors[k], plain.Colors[k]);
    EXPECT_LE(cued.Colors[k + 1], plain.Colors[k + 1]);
    EXPECT_EQ(cued.Colors[k + 2], plain.Colors[k + 2]);
    EXPECT_EQ(cued.Colors[k + 3], plain.Colors[k + 3]);
  }
  EXPECT_GT(FindDifference(cued, plain), 0.1);
}

TEST(ImageDepthCueing, IsForSlabsButTablesAreNot)
{
  ImageScene scene = MakeScene(ImageScalar::Int16);
  scene.Options.PreIntegrated = true;
  scene.Options.NearColor[2] = 0.2f;
  EXPECT_NO_THROW(Cast(scene));
  scene.Optics.Table = MakeRandomTable(4, 4);
  EXPECT_THROW(Cast(scene), std::invalid_argument);
}

//------------------------------------------------------------------------------------------------
// Threads

TEST(ImageGradients, DoNotDependOnThreads)
{
  for (const ImageScalar type : Types)
  {
    for (const GradientSource source : Sources)
    {
      for (const LightSum sum : Sums)
      {
        SCOPED_TRACE(testing::Message() << "type " << static_cast<int>(type));
        ImageScene scene = MakeLitScene(type);
        scene.Optics.Table = MakeRandomTable(32, 32);
        scene.Options.Gradients = source;
        scene.Options.SumOfLights = sum;
        scene.Options.FarColor[0] = 0.5f;
        scene.Options.NumberOfThreads = 1;
        const CastPicture one = Cast(scene);
        for (const int threads : { 2, 3, 7 })
        {
          scene.Options.NumberOfThreads = threads;
          EXPECT_TRUE(IsSame(Cast(scene), one)) << threads;
        }
        scene.Options.PortableKernels = true;
        EXPECT_LE(FindDifference(Cast(scene), one), LightRounding);
      }
    }
  }
}

} // namespace
} // namespace tetralux
