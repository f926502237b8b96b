// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GradientScene_h
#define tetralux_GradientScene_h

// Scenes of image data with gradients and lights, and what pictures of them may be off by.

#include "GradientReference.h"
#include "Optics/IntervalTable.h"
#include "PlainRays.h"
#include "ReferenceScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace tetralux
{

inline constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

inline constexpr ImageScalar Types[] = { ImageScalar::Int8, ImageScalar::UInt8, ImageScalar::Int16,
  ImageScalar::UInt16, ImageScalar::Float };
inline constexpr GradientNorm Norms[] = { GradientNorm::Euclidean, GradientNorm::Sum };
inline constexpr GradientSource Sources[] = { GradientSource::OnTheFly, GradientSource::Bytes };
inline constexpr LightSum Sums[] = { LightSum::Direct, LightSum::NearestEntry,
  LightSum::Interpolated };

/// Of a channel: a sample's place, value and gradient have single precision, and a ramp of opacity
/// over the gradient's length multiplies that by ten.
inline constexpr double GradientRounding = 2e-6;
/// Of a channel: the same of directions, which highlights of a power of 20 turn into light.
inline constexpr double LightRounding = 1e-5;
/// Of a channel, for each column and row of a table of any numbers: its slopes grow with those.
inline constexpr double TableRounding = 3e-7;
/// Of a channel of a constant volume of some slabs.
inline constexpr double ConstantError = 1e-6;

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
inline int CountVisible(const CastPicture& picture)
{
  return static_cast<int>(
    std::count_if(picture.Depths.begin(), picture.Depths.end(), [](float d) { return d >= 0; }));
}

inline bool IsFinite(const CastPicture& picture)
{
  return std::all_of(
    picture.Colors.begin(), picture.Colors.end(), [](float c) { return std::isfinite(c); });
}

inline Light MakeDistantLight(
  const std::array<double, 3>& direction, const std::array<float, 3>& color)
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
inline Light MakeHeadlight() { return MakeDistantLight({ 0.61, 0.43, 0.67 }, { 1, 1, 1 }); }

inline Light MakePositionalLight(const std::array<double, 3>& position)
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
inline Light MakeSpot(const std::array<double, 3>& position, double coneCosine)
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
inline ImageScene MakeScene(
  ImageScalar type, ImagePlacement::Camera camera = ImagePlacement::Perspective)
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
inline ImageScene MakeGradientScene(
  ImageScalar type, ImagePlacement::Camera camera = ImagePlacement::Perspective)
{
  ImageScene scene = MakeScene(type, camera);
  scene.Optics.GradientOpacity =
    MakeLinearFunction({ { 0.02, 0, 0, 0, 0.1 }, { 0.1, 0, 0, 0, 0.6 }, { 0.25, 0, 0, 0, 1 } });
  return scene;
}

inline ImageScene MakeLitScene(
  ImageScalar type, ImagePlacement::Camera camera = ImagePlacement::Perspective)
{
  ImageScene scene = MakeScene(type, camera);
  scene.Options.Shaded = true;
  scene.Options.Lights = { MakeHeadlight() };
  return scene;
}

/// A scalar whose gradient, in steps of points, is the same everywhere.
inline void SetLinear(ImageScene& scene, const std::array<double, 3>& gradient)
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
inline TransferTable MakeRandomTable(int columns, int rows)
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
inline TransferTable MakeProductTable(const ImageOptics& optics, int columns, int rows)
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

inline void ExpectGradientReference(const ImageScene& scene, double tolerance)
{
  const CastPicture picture = Cast(scene);
  EXPECT_GT(CountVisible(picture), 200);
  EXPECT_LE(Compare(picture.Colors, RenderWithGradients(scene)).Largest, tolerance);
}

} // namespace tetralux

#endif
