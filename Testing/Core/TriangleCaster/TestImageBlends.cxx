// SPDX-License-Identifier: BSD-3-Clause

// Blend modes of the triangle caster: against plain loops in double precision, and closed forms.

#include "BlendScene.h"
#include "PlainRays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

TEST(ImageBlends, EachTypeOfValue)
{
  for (const ImageScalar type : { ImageScalar::Int8, ImageScalar::UInt8, ImageScalar::Int16,
         ImageScalar::UInt16, ImageScalar::Float })
  {
    const testing::ScopedTrace trace(
      __FILE__, __LINE__, "type " + std::to_string(static_cast<int>(type)));
    ForEachScene(5,
      [&](BlendScene& scene, std::mt19937&)
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
      [&](BlendScene& scene, std::mt19937&)
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
      [&](BlendScene& scene, std::mt19937&)
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
    [](BlendScene& scene, std::mt19937&)
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
    [](BlendScene& scene, std::mt19937&)
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
    [](BlendScene& scene, std::mt19937& random)
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
void ForEachLimit(BlendScene& scene, std::mt19937& random, const std::function<void()>& check)
{
  const BlendScene unlimited = scene;
  const RayGrid& grid = scene.Grid;
  PlainVector n, middle;
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
    [](BlendScene& scene, std::mt19937& random)
    { ForEachLimit(scene, random, [&] { EXPECT_GT(ExpectPlain(scene, Cast(scene)), 20); }); });
}

/// Checks that a picture has the same bits in whatever way it is made.
void ExpectSameBits(BlendScene& scene)
{
  const ImageCasterOptions options = scene.Options;
  const BlendPicture first = Cast(scene);
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
  const BlendPicture whole = Cast(scene);
  EXPECT_TRUE(whole == first) << "empty space";
  EXPECT_LE(first.Statistics.Samples, whole.Statistics.Samples);
  scene.Options = options;
}

TEST(ImageBlends, SameBits)
{
  ForEachScene(5,
    [](BlendScene& scene, std::mt19937& random)
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
    BlendScene scene = MakeBlendScene(random, blend, false, 5);
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
    const BlendPicture picture = Cast(scene);
    scene.Options.SkipEmptySpace = false;
    const BlendPicture whole = Cast(scene);
    EXPECT_TRUE(whole == picture);
    if (blend != ImageBlend::Slice)
    {
      EXPECT_LT(picture.Statistics.Samples, 0.5 * whole.Statistics.Samples);
    }
  }
}

/// Parallel rays along z through layers of constant values, each on a plane of points.
BlendScene MakeLayers(const std::vector<double>& values)
{
  BlendScene scene;
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
      BlendScene scene = MakeLayers(values);
      scene.Options.SampleDistance = 4.527;
      const BlendPicture picture = Cast(scene);
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
      BlendScene scene = MakeLayers(values);
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
      const BlendPicture picture = Cast(scene);
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
    BlendScene scene = MakeLayers(values);
    scene.At(0, 0, 130) = 100;
    scene.Optics.Blend = blend;
    if (blend == ImageBlend::MinimumIntensity)
    {
      Invert(scene);
    }
    scene.Options.SampleDistance = 0.71;
    const BlendPicture picture = Cast(scene);
    ExpectPlain(scene, picture);
    // Rays begin 3 in front of the volume; the first sample behind 20 is at 0.71 * 28.5.
    for (const float depth : picture.Depths)
    {
      EXPECT_NEAR(depth, 3 + 0.71 * 28.5, 1e-5);
    }
    scene.Options.SkipEmptySpace = false;
    const BlendPicture whole = Cast(scene);
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
    BlendScene scene = MakeLayers(layers);
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
    [](BlendScene& scene, std::mt19937& random)
    {
      scene.PointFlags.assign(scene.Values.size(), 0);
      for (std::size_t n = 0; n < scene.Values.size() / 50; ++n)
      {
        scene.PointFlags[random() % scene.Values.size()] = HiddenPoint;
      }
      ForEachLimit(scene, random,
        [&]
        {
          BlendScene empty = scene;
          empty.PointFlags.clear();
          for (std::size_t k = 0; k < scene.Values.size(); ++k)
          {
            empty.Values[k] = scene.PointFlags[k] != 0 ? NotANumber : scene.Values[k];
          }
          BlendScene whole = scene;
          whole.PointFlags.clear();
          const BlendPicture picture = Cast(scene);
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
    [](BlendScene& scene, std::mt19937& random)
    {
      const BlendPicture whole = Cast(scene);
      scene.Mask.assign(scene.Values.size(), 1);
      EXPECT_TRUE(Cast(scene) == whole);
      for (std::size_t n = 0; n < scene.Values.size() / 5; ++n)
      {
        scene.Mask[random() % scene.Values.size()] = 0;
      }
      EXPECT_FALSE(Cast(scene) == whole);
      ExpectSameBits(scene);
      std::fill(scene.Mask.begin(), scene.Mask.end(), 0);
      const BlendPicture nothing = Cast(scene);
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
    BlendScene scene = MakeLayers(values);
    scene.Options.SampleDistance = 17.3;
    scene.PointFlags.assign(scene.Values.size(), 0);
    const std::size_t layer = scene.Values.size() / values.size();
    std::fill(scene.PointFlags.begin() + (step - 5) * layer,
      scene.PointFlags.begin() + (step + 5) * layer, HiddenPoint);
    const BlendPicture picture = Cast(scene);
    scene.Options.SkipEmptySpace = false;
    EXPECT_TRUE(Cast(scene) == picture) << step;
  }
}

/// One ray along x through a linear field, from x = -2 on.
BlendScene MakeLine(ImageBlend blend)
{
  BlendScene scene;
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
  BlendScene scene = MakeLine(ImageBlend::AverageIntensity);
  BlendPicture picture = Cast(scene);
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
  BlendScene scene = MakeLine(ImageBlend::AverageIntensity);
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
  const BlendPicture picture = Cast(scene);
  EXPECT_EQ(picture.Colors[3], 0.f);
  EXPECT_EQ(picture.Depths[0], -1.f);
}

TEST(ImageBlends, LargestAndSmallestOfALinearField)
{
  // The first stretch is x = 0..0.7, the last one 10.5..11.
  BlendScene scene = MakeLine(ImageBlend::MinimumIntensity);
  BlendPicture picture = Cast(scene);
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
  BlendScene scene = MakeLine(ImageBlend::Isosurfaces);
  scene.Options.SampleDistance = 3;
  scene.Optics.Surfaces = { { 40.5, { 1, 0, 0 }, 0.5f }, { 36, { 0, 1, 0 }, 0.25f },
    { 40.5, { 0, 0, 1 }, 0.2f } };
  BlendPicture picture = Cast(scene);
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
    BlendScene scene = MakeBlendScene(random, ImageBlend::Slice, parallel, 5);
    scene.Fill([](int i, int j, int k) { return i + 0.5 * j + 1.5 * k; });
    scene.Optics.Function.Nodes = { { 0, { { 0, 0, 1 }, 0.1 }, { { 0, 0, 1 }, 0.1 } },
      { 100, { { 1, 0, 0 }, 0.9 }, { { 1, 0, 0 }, 0.9 } } };
    const BlendPicture picture = Cast(scene);
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
        height += plane[a] * (ray.Start[a] + picture.Depths[p] * ray.Direction[a]);
        scalar += weights[a] * (ray.IndexStart[a] + picture.Depths[p] * ray.IndexDirection[a]);
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
  BlendScene scene = MakeLine(ImageBlend::Slice);
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
