// SPDX-License-Identifier: BSD-3-Clause

// The triangle caster against the reference for the slices in use, and against what is known
// without any.

#include "ImageScene.h"

#include "ReferenceScenes.h"
#include "Simd/InstructionSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tetralux
{
namespace
{

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

constexpr ImageScalar Types[] = { ImageScalar::Int8, ImageScalar::UInt8, ImageScalar::Int16,
  ImageScalar::UInt16, ImageScalar::Float };
constexpr StepOpacity Models[] = { StepOpacity::Power, StepOpacity::Attenuation };
constexpr SliceShape Shapes[] = { SliceShape::Planes, SliceShape::Shells };

/// Of a channel of a constant volume of some ten slabs.
constexpr double ConstantError = 1e-6;
/// Relative: of a colour, where nearly nothing is seen.
constexpr double ColorError = 1e-5;
/// Relative: of an opacity of the function in single precision.
constexpr double OpacityRounding = 1. / (1 << 24);

constexpr const char* NoWideLanes = "this processor has no fast lanes of 16";

/// Scenes that show much, for what may not change a picture: not empty, of any kind.
std::vector<ImageScene> MakeScenes(int count)
{
  std::mt19937_64 generator(77);
  std::vector<ImageScene> scenes{ MakeSmoothImageScene() };
  while (static_cast<int>(scenes.size()) < count)
  {
    ImageScene scene = MakeRandomImageScene(generator);
    // More than one thread's share.
    const CastPicture picture = Cast(scene);
    const auto visible =
      std::count_if(picture.Depths.begin(), picture.Depths.end(), [](float d) { return d >= 0; });
    if (visible > 100)
    {
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

//------------------------------------------------------------------------------------------------
// What is drawn

TEST(ImageCaster, DrawsRandomScenes)
{
  constexpr int Rounds = 3000;
  constexpr int Seed = 1999;
  int visible = 0;
  int off = 0;
  int farOff = 0;
  int depthsOff = 0;
  std::set<std::pair<ImageScalar, bool>> kinds;
  for (int round = 0; round < Rounds; ++round)
  {
    SCOPED_TRACE(testing::Message() << "round " << round << " of seed " << Seed);
    std::mt19937_64 generator(Seed + round);
    const ImageScene scene = MakeRandomImageScene(generator);
    const ImageDifference difference = ExpectReference(scene, Cast(scene));
    visible += difference.Visible;
    off += difference.Off;
    farOff += difference.FarOff;
    depthsOff += difference.DepthsOff;
    kinds.insert({ scene.Type, scene.Options.PortableKernels });
    if (HasFailure())
    {
      break;
    }
  }
  EXPECT_EQ(kinds.size(), 10u); // each type by each kernel
  EXPECT_GT(visible, Rounds * 20);
  // Steep functions of 300 nodes over noise, and samples at steps.
  EXPECT_LE(off, 1e-3 * visible);
  EXPECT_LE(farOff, 1e-4 * visible);
  // Where the opacity begins just at a sample.
  EXPECT_LE(depthsOff, 1e-4 * visible);
}

TEST(ImageCaster, DrawsWorldsOfAllSizes)
{
  for (const double world : { 1e-30, 1e-3, 1., 1e7, 1e30 })
  {
    for (int camera = 0; camera < ImagePlacement::NumberOfCameras; ++camera)
    {
      SCOPED_TRACE(testing::Message() << world << ", camera " << camera);
      ImageScene scene = MakeSmoothImageScene();
      ImagePlacement placement;
      placement.Spacing = { world, 0.7 * world, 1.8 * world };
      placement.Apply(scene, static_cast<ImagePlacement::Camera>(camera), 23, 17);
      scene.Optics.UnitDistance = world;
      scene.Options.NumberOfThreads = 1;
      scene.Options.SampleDistance = 0.6 * world;
      const ImageDifference difference = ExpectReference(scene, Cast(scene));
      EXPECT_GT(difference.Visible, 50);
      EXPECT_EQ(difference.Off, 0);
      EXPECT_EQ(difference.DepthsOff, 0);
    }
  }
}

TEST(ImageCaster, DrawsAlongThePlanesOfTheGrid)
{
  // Numbers without rounding: rays within cells' faces, along their edges, and in the faces of the
  // volume, which belong to it.
  ImageScene scene;
  scene.Dimensions = { 9, 7, 5 };
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> shares(9 * 7 * 5);
  std::generate(shares.begin(), shares.end(), [&] { return unit(generator); });
  scene.SetValues(ImageScalar::Float, shares);
  scene.Optics.Function = MakeLinearFunction({ { 0, 1, 0, 0, 0.1 }, { 1, 0, 1, 0, 0.8 } });
  scene.Options.Threshold = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    scene.Grid = RayGrid();
    scene.Grid.Width = scene.Grid.Height = 24;
    const int across = (axis + 1) % 3;
    const int up = (axis + 2) % 3;
    std::fill_n(scene.Grid.Direction, 3, 0.);
    scene.Grid.Direction[axis] = 1;
    scene.Grid.Origin[axis] = -2;
    scene.Grid.Origin[across] = scene.Grid.Origin[up] = -1;
    scene.Grid.OriginStepX[across] = scene.Grid.OriginStepY[up] = 0.5;
    for (const double distance : { 0.5, 0.75, 1., 2. })
    {
      SCOPED_TRACE(testing::Message() << "axis " << axis << ", " << distance);
      scene.Options.SampleDistance = distance;
      const ImageDifference difference = ExpectReference(scene, Cast(scene));
      const int points = 2 * scene.Dimensions[across] - 1;
      EXPECT_EQ(difference.Visible, points * (2 * scene.Dimensions[up] - 1));
      EXPECT_EQ(difference.Off, 0);
      EXPECT_EQ(difference.DepthsOff, 0);
      // A clipping plane along the rays, which keeps those within it.
      scene.Limits.Planes = { {} };
      scene.Limits.Planes[0][across] = 1;
      scene.Limits.Planes[0][3] = -1.5;
      const ImageDifference clipped = ExpectReference(scene, Cast(scene));
      EXPECT_EQ(clipped.Visible, (points - 3) * (2 * scene.Dimensions[up] - 1));
      EXPECT_EQ(clipped.Off, 0);
      scene.Limits.Planes.clear();
    }
  }
}

/// Fails where a volume that has one scalar opacity is not as opaque as the lengths of its rays,
/// in unit distances, say.
void ExpectConstant(const ImageScene& scene, const std::vector<double>& lengths, double opacity)
{
  const CastPicture picture = Cast(scene);
  int wrong = 0;
  for (std::size_t p = 0; p < lengths.size(); ++p)
  {
    const bool power = scene.Optics.Opacity == StepOpacity::Power;
    const double alpha =
      power ? -std::expm1(lengths[p] * std::log1p(-opacity)) : -std::expm1(-lengths[p] * opacity);
    // Opacities of the function are in single precision: near 1 their rest has less.
    const double slope =
      power && lengths[p] > 0 ? lengths[p] * std::pow(1 - opacity, lengths[p] - 1) : 0;
    const double rounding = OpacityRounding * opacity * slope;
    const double error = ConstantError + rounding;
    const float* color = &picture.Colors[4 * p];
    wrong += !(std::abs(color[3] - alpha) <= error) ||
      !(std::abs(color[0] - alpha) <= std::min(error, ColorError * alpha + rounding)) ||
      !(std::abs(color[1] - 0.5 * alpha) <= error) || !(std::abs(color[2] - 0.25 * alpha) <= error);
  }
  EXPECT_EQ(wrong, 0);
}

TEST(ImageCaster, KnowsConstantVolumes)
{
  ImageScene scene;
  scene.Dimensions = { 9, 7, 5 };
  scene.Options.SampleDistance = 0.75;
  scene.Options.Threshold = 0;
  scene.Options.NumberOfThreads = 1; // of small pictures
  scene.Optics.UnitDistance = 2.5;
  scene.Limits.Planes = { { -0.3, 0.2, -1, 1.3 } };
  scene.Limits.Cropping = true;
  const double planes[6] = { 2, 5, 1.5, 4, 1, 3.5 };
  std::copy_n(planes, 6, scene.Limits.CroppingPlanes);
  scene.Limits.CroppingFlags = 0x5b6dab7; // up to three parts of a ray
  ImagePlacement placement;
  placement.Spacing = { 1.1, 2.3, 0.4 };
  for (int camera = 0; camera < ImagePlacement::NumberOfCameras; ++camera)
  {
    placement.Apply(scene, static_cast<ImagePlacement::Camera>(camera), 21, 13);
    scene.SetValues(ImageScalar::Float, std::vector<double>(9 * 7 * 5, 0.5));
    scene.Optics.Function = MakeConstantFunction(0.1, { 1, 1, 1 });
    std::vector<double> lengths;
    for (const ReferencePixel& pixel : scene.RenderReference())
    {
      lengths.push_back(pixel.Length / scene.Optics.UnitDistance);
    }
    EXPECT_GT(
      std::count_if(lengths.begin(), lengths.end(), [](double length) { return length > 0; }), 20);
    for (const ImageScalar type : Types)
    {
      scene.SetValues(type, std::vector<double>(9 * 7 * 5, 0.5));
      for (const StepOpacity model : Models)
      {
        for (const SliceShape shape : Shapes)
        {
          for (const double opacity : { 1e-8, 1e-4, 0.1, 0.9, 0.9999 })
          {
            SCOPED_TRACE(testing::Message()
              << "type " << static_cast<int>(type) << ", model " << static_cast<int>(model)
              << ", shape " << static_cast<int>(shape) << ", camera " << camera << ", " << opacity);
            scene.Optics.Opacity = model;
            scene.Options.Shape = shape;
            scene.Optics.Function = MakeConstantFunction(opacity, { 1, 0.5, 0.25 });
            ExpectConstant(scene, lengths, opacity);
          }
        }
      }
    }
  }
}

TEST(ImageCaster, KnowsOpticalDepthsOfAnySize)
{
  ImageScene scene;
  scene.Dimensions = { 9, 7, 5 };
  scene.SetValues(ImageScalar::Int16, std::vector<double>(9 * 7 * 5, 0.5));
  ImagePlacement().Apply(scene, ImagePlacement::Perspective, 21, 13);
  scene.Optics.Opacity = StepOpacity::Attenuation;
  scene.Options.SampleDistance = 0.75;
  scene.Options.Threshold = 0;
  scene.Options.NumberOfThreads = 1;
  for (double depth = 1e-8; depth < 2e6; depth *= 10)
  {
    SCOPED_TRACE(testing::Message() << depth);
    // By the attenuation, and by the unit distance.
    for (const bool unit : { false, true })
    {
      scene.Optics.Function = MakeConstantFunction(unit ? 1 : depth / 10, { 1, 1, 1 });
      scene.Optics.UnitDistance = unit ? 10 / depth : 1;
      const std::vector<ReferencePixel> reference = scene.RenderReference();
      const CastPicture picture = Cast(scene);
      for (int p = 0; p < scene.GetNumberOfPixels(); ++p)
      {
        ASSERT_NEAR(picture.Colors[4 * static_cast<std::size_t>(p)], reference[p].Rgba[0],
          ColorError * reference[p].Rgba[0]);
        ASSERT_NEAR(
          picture.Colors[4 * static_cast<std::size_t>(p) + 3], reference[p].Rgba[3], ConstantError);
      }
    }
  }
}

TEST(ImageCaster, TakesTheUpperSideOfSteps)
{
  // Scalars and nodes without rounding, and functions of any number of intervals.
  ImageScene scene;
  scene.Dimensions = { 3, 3, 3 };
  ImagePlacement().Apply(scene, ImagePlacement::Parallel, 9, 9);
  scene.Optics.Opacity = StepOpacity::Attenuation;
  scene.Options.Threshold = 0;
  scene.Options.NumberOfThreads = 1;
  for (const bool portable : { false, true })
  {
    scene.Options.PortableKernels = portable;
    for (const int nodes : { 3, 5, 9, 17, 33, 257 })
    {
      const double step = 256. / (nodes - 1);
      scene.Optics.Function.Nodes.clear();
      for (int k = 0; k < nodes; ++k)
      {
        const TransferFunction::Value left{ { 0, 0, 1 }, 0 };
        const TransferFunction::Value right{ { 1, 0, 0 }, 1 };
        scene.Optics.Function.Nodes.push_back({ k * step, left, right });
      }
      for (int k = 0; k < nodes; k += std::max(1, nodes / 16))
      {
        SCOPED_TRACE(testing::Message() << nodes << " nodes, at " << k);
        scene.SetValues(ImageScalar::Float, std::vector<double>(27, k * step));
        const CastPicture picture = Cast(scene);
        const std::vector<ReferencePixel> reference = scene.RenderReference();
        for (int p = 0; p < scene.GetNumberOfPixels(); ++p)
        {
          ASSERT_NEAR(picture.Colors[4 * static_cast<std::size_t>(p)],
            -std::expm1(-reference[p].Length), ConstantError);
          ASSERT_EQ(picture.Colors[4 * static_cast<std::size_t>(p) + 2], 0);
        }
      }
    }
  }
}

TEST(ImageCaster, EndsWhereOpacityIsOne)
{
  const TransferFunction::Value thin{ { 0, 1, 0 }, 0.1 };
  const TransferFunction::Value wall{ { 1, 0.25, 0.5 }, 1 };
  for (const bool portable : { false, true })
  {
    for (const SliceShape shape : Shapes)
    {
      ImageScene scene = MakeSmoothImageScene();
      scene.Options.PortableKernels = portable;
      scene.Options.Shape = shape;
      // A wall with steps, one that the opacity rises to, and one everywhere.
      scene.Optics.Function.Nodes = { { 0.6, thin, wall }, { 0.7, wall, thin } };
      const CastPicture picture = Cast(scene);
      const ImageDifference difference = ExpectReference(scene, picture);
      EXPECT_LE(difference.Off, 0.01 * difference.Visible);
      EXPECT_GT(std::count(picture.Colors.begin(), picture.Colors.end(), 1.f), 100);
      scene.Optics.Function.Nodes = { { 0.4, thin, thin }, { 0.6, wall, wall } };
      EXPECT_LE(ExpectReference(scene, Cast(scene)).Off, 0.01 * difference.Visible);
      scene.Optics.Function.Nodes = { { 0, wall, wall } };
      const CastPicture opaque = Cast(scene);
      const std::vector<ReferencePixel> reference = scene.RenderReference();
      for (int p = 0; p < scene.GetNumberOfPixels(); ++p)
      {
        const float* color = &opaque.Colors[4 * static_cast<std::size_t>(p)];
        const float expected = reference[p].Length > 0 ? 1 : 0;
        ASSERT_EQ(color[0], expected);
        ASSERT_EQ(color[1], 0.25f * expected);
        ASSERT_EQ(color[2], 0.5f * expected);
        ASSERT_EQ(color[3], expected);
      }
    }
  }
}

TEST(ImageCaster, LeavesOutCellsWithoutScalar)
{
  std::mt19937_64 generator(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double share : { 0.001, 0.05, 0.2 })
  {
    for (const bool portable : { false, true })
    {
      ImageScene scene = MakeSmoothImageScene();
      scene.Options.PortableKernels = portable;
      std::vector<double> shares = MakeSmoothShares(scene.Dimensions);
      for (double& value : shares)
      {
        value = unit(generator) < share ? NaN : value;
      }
      scene.SetValues(ImageScalar::Float, shares);
      const CastPicture picture = Cast(scene);
      const ImageDifference difference = ExpectReference(scene, picture);
      EXPECT_LE(difference.Off, 0.01 * difference.Visible);
      EXPECT_GT(difference.Visible, 100);
      scene.Options.SkipEmptySpace = false;
      EXPECT_TRUE(IsSame(Cast(scene), picture));
    }
  }
  ImageScene scene = MakeSmoothImageScene();
  scene.Optics.Function = MakeConstantFunction(0.5, { 1, 1, 1 });
  scene.SetValues(
    ImageScalar::Float, std::vector<double>(MakeSmoothShares(scene.Dimensions).size(), NaN));
  const CastPicture picture = Cast(scene);
  EXPECT_TRUE(
    std::all_of(picture.Colors.begin(), picture.Colors.end(), [](float c) { return c == 0; }));
  EXPECT_TRUE(
    std::all_of(picture.Depths.begin(), picture.Depths.end(), [](float d) { return d == -1; }));
}

TEST(ImageCaster, DrawsNothingBehindTheCamera)
{
  ImageScene scene = MakeSmoothImageScene();
  for (double* direction :
    { scene.Grid.Direction, scene.Grid.DirectionStepX, scene.Grid.DirectionStepY })
  {
    std::transform(direction, direction + 3, direction, [](double d) { return -d; });
  }
  const CastPicture picture = Cast(scene);
  EXPECT_TRUE(
    std::all_of(picture.Colors.begin(), picture.Colors.end(), [](float c) { return c == 0; }));
  EXPECT_TRUE(
    std::all_of(picture.Depths.begin(), picture.Depths.end(), [](float d) { return d == -1; }));
  EXPECT_EQ(picture.Statistics.Samples, 0);
}

TEST(ImageCaster, PositionsDoNotDrift)
{
  // Some hundred thousand slabs, the last of which meet a wall.
  const TransferFunction::Value empty{ { 0, 0, 0 }, 0 };
  const TransferFunction::Value wall{ { 1, 1, 1 }, 1 };
  ImageScene scene;
  scene.Dimensions = { 33, 3, 3 };
  std::vector<double> shares;
  for (int p = 0; p < 33 * 3 * 3; ++p)
  {
    shares.push_back(p % 33);
  }
  scene.SetValues(ImageScalar::Float, shares);
  scene.Optics.Function.Nodes = { { 31.5, empty, wall } };
  scene.Grid = MakePerspectiveGrid({ -5, 1.03, 1.06 }, { 0, 1.03, 1.06 }, { 0, 1, 0.1 }, 2, 5, 4);
  scene.Options.SampleDistance = 2e-4;
  for (const SliceShape shape : Shapes)
  {
    scene.Options.Shape = shape;
    const CastPicture picture = Cast(scene);
    EXPECT_GT(picture.Statistics.Slices, 150000);
    for (int p = 0; p < scene.GetNumberOfPixels(); ++p)
    {
      const ReferencePixel exact = IntegrateReferenceRay(
        scene.GetVolume(), scene.Optics, scene.Grid, scene.GetLimits(), p % 5, p / 5);
      EXPECT_EQ(picture.Colors[4 * static_cast<std::size_t>(p) + 3], 1);
      // A slab, and what single precision leaves of the scalar and of the depth.
      EXPECT_NEAR(picture.Depths[p], exact.Depth, 2e-4 + 1e-5);
    }
  }
}

TEST(ImageCaster, SamplesComeToTheIntegral)
{
  ImageScene scene = MakeSmoothImageScene();
  ImagePlacement().Apply(scene, ImagePlacement::Perspective, 23, 17);
  for (const StepOpacity model : Models)
  {
    scene.Optics.Opacity = model;
    const std::vector<ReferencePixel> exact =
      IntegrateReferenceImage(scene.GetVolume(), scene.Optics, scene.Grid, scene.GetLimits());
    const auto findError = [&](double distance)
    {
      scene.Options.SampleDistance = distance;
      const CastPicture picture = Cast(scene);
      double largest = 0;
      for (std::size_t k = 0; k < picture.Colors.size(); ++k)
      {
        largest = std::max(largest, std::abs(picture.Colors[k] - exact[k / 4].Rgba[k % 4]));
      }
      return largest;
    };
    const double coarse = findError(0.8);
    EXPECT_LT(findError(0.2), coarse / 8);
    EXPECT_LT(findError(0.05), 1e-4);
  }
}

//------------------------------------------------------------------------------------------------
// What may not change a picture, or not by much

TEST(ImageCaster, GivesTheSameBitsForAnyThreads)
{
  for (ImageScene& scene : MakeScenes(30))
  {
    scene.Options.NumberOfThreads = 1;
    const CastPicture expected = Cast(scene);
    for (const int threads : { 2, 3, 8 })
    {
      scene.Options.NumberOfThreads = threads;
      const CastPicture picture = Cast(scene);
      EXPECT_EQ(picture.Statistics.NumberOfThreads, threads);
      EXPECT_EQ(picture.Statistics.Samples, expected.Statistics.Samples);
      EXPECT_TRUE(IsSame(picture, expected)) << threads << " threads";
    }
  }
}

TEST(ImageCaster, GivesTheSameBitsForAnyTiles)
{
  for (ImageScene& scene : MakeScenes(30))
  {
    scene.Options.TileSize = 8;
    scene.Options.Triangles = false;
    const CastPicture expected = Cast(scene);
    for (const int size : { 4, 5, 8, 16, 23, 64 })
    {
      for (const bool triangles : { false, true })
      {
        scene.Options.TileSize = size;
        scene.Options.Triangles = triangles;
        EXPECT_TRUE(IsSame(Cast(scene), expected))
          << size << (triangles ? " in triangles" : " as they are");
      }
    }
  }
}

TEST(ImageCaster, GivesTheSameBitsWithoutEmptySpace)
{
  std::int64_t skipped = 0;
  std::vector<ImageScene> scenes = MakeScenes(60);
  scenes.push_back(MakeBallImageScene());
  for (ImageScene& scene : scenes)
  {
    scene.Options.SkipEmptySpace = false;
    const CastPicture expected = Cast(scene);
    scene.Options.SkipEmptySpace = true;
    const CastPicture picture = Cast(scene);
    EXPECT_LE(picture.Statistics.Samples, expected.Statistics.Samples);
    EXPECT_TRUE(IsSame(picture, expected));
    skipped += expected.Statistics.Samples - picture.Statistics.Samples;
  }
  EXPECT_GT(skipped, 0);
}

TEST(ImageCaster, LeavesOutNoMoreThanTheThreshold)
{
  for (ImageScene& scene : MakeScenes(30))
  {
    scene.Options.Threshold = 0;
    const CastPicture expected = Cast(scene);
    for (const double threshold : { 1. / 255, 0.1 })
    {
      scene.Options.Threshold = threshold;
      for (int flags = 0; flags < 4; ++flags)
      {
        scene.Options.EndTriangles = (flags & 1) != 0;
        scene.Options.SkipPixels = (flags & 2) != 0;
        const CastPicture picture = Cast(scene);
        EXPECT_LE(FindDifference(picture, expected), threshold + SampleRounding);
        EXPECT_EQ(picture.Depths, expected.Depths);
        EXPECT_GE(
          picture.Statistics.TerminationError + SampleRounding, FindDifference(picture, expected));
        EXPECT_LE(picture.Statistics.TerminationError, static_cast<float>(threshold));
        EXPECT_LE(picture.Statistics.Samples, expected.Statistics.Samples);
      }
    }
  }
}

TEST(ImageCaster, EndsEarly)
{
  ImageScene scene = MakeSmoothImageScene();
  scene.Optics.Function = MakeConstantFunction(0.9, { 1, 1, 1 });
  scene.Options.SampleDistance = 0.2;
  const CastPicture whole = Cast(scene);
  scene.Options.Threshold = 1. / 255;
  const CastPicture ended = Cast(scene);
  EXPECT_LT(ended.Statistics.Samples, 0.5 * whole.Statistics.Samples);
  EXPECT_LT(ended.Statistics.Triangles, 0.8 * whole.Statistics.Triangles);
  scene.Options.EndTriangles = false;
  EXPECT_EQ(Cast(scene).Statistics.Triangles, whole.Statistics.Triangles);
}

TEST(ImageCaster, PortableKernelsDifferByRounding)
{
  for (ImageScene& scene : MakeScenes(30))
  {
    scene.Options.PortableKernels = false;
    CastPicture picture = Cast(scene);
    EXPECT_LE(ExpectReference(scene, picture).Off, 0.05 * scene.GetNumberOfPixels());
    EXPECT_NE(picture.Statistics.InstructionSet, "");
    scene.Options.PortableKernels = true;
    picture = Cast(scene);
    EXPECT_LE(ExpectReference(scene, picture).Off, 0.05 * scene.GetNumberOfPixels());
    EXPECT_EQ(picture.Statistics.InstructionSet, GetName(InstructionSet::Generic));
  }
}

TEST(ImageCaster, WideKernelsAreTheSameBits)
{
  if (!HasFastWideLanes())
  {
    GTEST_SKIP() << NoWideLanes;
  }
  std::set<ImageScalar> types;
  std::set<bool> few;
  for (ImageScene& scene : MakeScenes(60))
  {
    scene.Options.PortableKernels = false;
    scene.Options.WideKernels = true;
    scene.Options.Threshold = 0.01;
    const CastPicture wide = Cast(scene);
    EXPECT_EQ(wide.Statistics.InstructionSet, "AVX-512");
    scene.Options.WideKernels = false;
    const CastPicture picture = Cast(scene);
    EXPECT_EQ(picture.Statistics.InstructionSet, "AVX2");
    EXPECT_TRUE(IsSame(wide, picture));
    EXPECT_EQ(wide.Statistics.Rays, picture.Statistics.Rays);
    types.insert(scene.Type);
    few.insert(scene.Optics.Function.Nodes.size() < 10);
  }
  EXPECT_EQ(types.size(), 5u);
  EXPECT_EQ(few.size(), 2u);
}

// Voxels come from small boxes, large ones, or by single loads, as the rays' distance has it.
TEST(ImageCaster, WideKernelsAreTheSameBitsAtAnyDistanceOfRays)
{
  if (!HasFastWideLanes())
  {
    GTEST_SKIP() << NoWideLanes;
  }
  const std::array<int, 3> sizes[] = { { 70, 50, 40 }, { 8, 4, 4 }, { 9, 7, 6 }, { 5, 40, 3 } };
  std::mt19937_64 generator(78);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const ImageScalar type : Types)
  {
    for (const std::array<int, 3>& size : sizes)
    {
      ImageScene scene = MakeSmoothImageScene();
      scene.Dimensions = size;
      std::vector<double> shares(static_cast<std::size_t>(size[0]) * size[1] * size[2]);
      std::generate(shares.begin(), shares.end(), [&] { return unit(generator); });
      const double ends[5][2] = { { -128, 127 }, { 0, 255 }, { -32768, 32767 }, { 0, 65535 },
        { 0, 1 } };
      const double* end = ends[static_cast<int>(type)];
      scene.Scale = 1 / (end[1] - end[0]);
      scene.Offset = -end[0] * scene.Scale;
      scene.SetValues(type, shares);
      scene.Optics.UnitDistance = 20;
      scene.Options.SampleDistance = 0.6;
      for (const int pixels : { 7, 20, 40, 80, 160 })
      {
        ImagePlacement().Apply(scene,
          static_cast<ImagePlacement::Camera>(generator() % ImagePlacement::NumberOfCameras),
          pixels, pixels);
        scene.Options.WideKernels = true;
        const CastPicture wide = Cast(scene);
        EXPECT_EQ(wide.Statistics.InstructionSet, "AVX-512");
        scene.Options.WideKernels = false;
        EXPECT_TRUE(IsSame(wide, Cast(scene)));
      }
    }
  }
}

TEST(ImageCaster, ForgetsWhatChanged)
{
  const std::vector<ImageScene> scenes = MakeScenes(12);
  ImageCaster caster;
  for (const ImageScene& scene : scenes)
  {
    caster.SetVolume(scene.GetVolume());
    caster.SetOptics(scene.Optics);
    EXPECT_TRUE(IsSame(Cast(caster, scene), Cast(scene)));
  }
  // Other optics, by which the space around the ball is no longer empty, then other values in the
  // same memory.
  ImageScene scene = MakeBallImageScene();
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  const CastPicture first = Cast(caster, scene);
  for (TransferFunction::Node& node : scene.Optics.Function.Nodes)
  {
    node.Scalar -= 2;
  }
  caster.SetOptics(scene.Optics);
  const CastPicture second = Cast(caster, scene);
  EXPECT_FALSE(IsSame(second, first));
  EXPECT_TRUE(IsSame(second, Cast(scene)));
  std::vector<double> shares = MakeSmoothShares(scene.Dimensions);
  const unsigned char* memory = scene.Values.data();
  scene.SetValues(scene.Type, shares);
  ASSERT_EQ(scene.Values.data(), memory);
  scene.Optics = MakeSmoothImageScene().Optics;
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  const CastPicture third = Cast(caster, scene);
  EXPECT_FALSE(IsSame(third, second));
  EXPECT_TRUE(IsSame(third, Cast(scene)));
  shares.assign(shares.size(), 1);
  scene.SetValues(scene.Type, shares);
  caster.SetVolume(scene.GetVolume()); // without new optics
  EXPECT_TRUE(IsSame(Cast(caster, scene), Cast(scene)));
}

//------------------------------------------------------------------------------------------------
// The call

TEST(ImageCaster, CountsWhatItDoes)
{
  ImageScene scene = MakeSmoothImageScene();
  scene.Options.SkipEmptySpace = false;
  const CastPicture picture = Cast(scene);
  const SlicePlanes planes = MakeSlicePlanes(
    scene.GetVolume(), scene.Grid, scene.Options.Shape, scene.Options.SampleDistance);
  EXPECT_EQ(picture.Statistics.Slices, planes.Count);
  double length = 0;
  std::int64_t rays = 0;
  for (const ReferencePixel& pixel : scene.RenderReference())
  {
    length += pixel.Length;
    rays += pixel.Length > 0 ? 1 : 0;
  }
  EXPECT_EQ(picture.Statistics.Rays, rays);
  // A sample in each slab, and in two of each ray that it goes through in part; steps are a little
  // longer than the distance.
  const double samples = length / scene.Options.SampleDistance;
  EXPECT_GT(picture.Statistics.Samples, 0.9 * samples);
  EXPECT_LT(picture.Statistics.Samples, samples + 2 * picture.Statistics.Rays);
  EXPECT_EQ(picture.Statistics.TerminationError, 0);
  EXPECT_GT(picture.Statistics.Triangles, 0);
}

TEST(ImageCaster, ProgressIsToldAndAborts)
{
  ImageScene scene = MakeSmoothImageScene();
  ImagePlacement().Apply(scene, ImagePlacement::Perspective, 150, 140);
  const CastPicture expected = Cast(scene);
  EXPECT_FALSE(expected.Statistics.Aborted);
  for (const int threads : { 1, 3 })
  {
    scene.Options.NumberOfThreads = threads;
    std::vector<double> told;
    scene.Options.Progress = [&](double share)
    {
      told.push_back(share);
      return true;
    };
    const CastPicture picture = Cast(scene);
    EXPECT_FALSE(picture.Statistics.Aborted);
    EXPECT_TRUE(IsSame(picture, expected));
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    ASSERT_FALSE(told.empty());
    EXPECT_GT(told.front(), 0);
    EXPECT_EQ(told.back(), 1);
  }
  // Long enough for a report.
  scene.Options.NumberOfThreads = 1;
  scene.Options.SampleDistance = 0.01;
  int calls = 0;
  scene.Options.Progress = [&](double)
  {
    ++calls;
    return false;
  };
  ImageCaster caster;
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  EXPECT_TRUE(Cast(caster, scene).Statistics.Aborted);
  EXPECT_EQ(calls, 1);
  scene.Options.Progress = [](double) -> bool { throw std::runtime_error("enough"); };
  EXPECT_THROW(Cast(caster, scene), std::runtime_error);
  // After that the next picture is as good as ever.
  scene.Options.Progress = nullptr;
  scene.Options.SampleDistance = 0.75;
  EXPECT_TRUE(IsSame(Cast(caster, scene), expected));
}

std::string GetError(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(ImageCaster, RefusesBadInput)
{
  const ImageScene good = MakeSmoothImageScene();
  const auto expectError = [&](const std::string& text, const std::function<void()>& call)
  {
    const std::string error = GetError(call);
    EXPECT_NE(error.find(text), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  };
  ImageCaster caster;
  expectError("no volume", [&] { Cast(caster, good); });
  caster.SetVolume(good.GetVolume());
  expectError("no optics", [&] { Cast(caster, good); });
  caster.SetOptics(good.Optics);
  const CastPicture expected = Cast(caster, good);

  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int points : { 1, 0, -4 })
    {
      ImageVolume volume = good.GetVolume();
      volume.Dimensions[axis] = points;
      expectError("at least 2", [&] { caster.SetVolume(volume); });
    }
  }
  ImageVolume volume = good.GetVolume();
  std::fill_n(volume.Dimensions, 3, 1300);
  expectError("2^31", [&] { caster.SetVolume(volume); });
  for (const double unit : { 0., -1., static_cast<double>(NaN) })
  {
    ImageOptics optics = good.Optics;
    optics.UnitDistance = unit;
    expectError("unit distance", [&] { caster.SetOptics(optics); });
  }
  ImageOptics optics = good.Optics;
  optics.Function.Nodes.clear();
  expectError("no nodes", [&] { caster.SetOptics(optics); });
  optics = good.Optics;
  optics.Function.Nodes[1].Scalar = optics.Function.Nodes[0].Scalar;
  expectError("node 1", [&] { caster.SetOptics(optics); });
  optics = good.Optics;
  optics.Function.Nodes[2].Left.Attenuation = -0.1;
  expectError("node 2", [&] { caster.SetOptics(optics); });

  for (const double distance : { 0., -1., static_cast<double>(NaN), 1e-9 })
  {
    ImageScene scene = good;
    scene.Options.SampleDistance = distance;
    expectError("distance of slices", [&] { Cast(caster, scene); });
  }
  std::vector<float> colors(4 * good.GetNumberOfPixels());
  std::vector<float> depths(good.GetNumberOfPixels());
  const auto cast = [&](std::size_t ofColors, std::size_t ofDepths)
  {
    caster.Cast(good.Grid, good.GetLimits(), good.Options, { colors.data(), ofColors },
      { depths.data(), ofDepths });
  };
  expectError("size", [&] { cast(colors.size() - 1, depths.size()); });
  expectError("size", [&] { cast(colors.size(), depths.size() - 1); });
  expectError("size", [&] { cast(0, 0); });

  // What was refused changed nothing.
  EXPECT_TRUE(IsSame(Cast(caster, good), expected));
}

} // namespace
} // namespace tetralux
