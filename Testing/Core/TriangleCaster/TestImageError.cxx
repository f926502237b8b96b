// SPDX-License-Identifier: BSD-3-Clause

// The estimated error of slices against the exact integral, the distance that follows from an
// error, and slabs from a table.

#include "ImageScene.h"

#include "TriangleCaster/ImageError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

/// The scene that is seen by some pixels more than the lattice of compared rays has.
ImageScene MakeScene()
{
  ImageScene scene = MakeSmoothImageScene();
  ImagePlacement().Apply(scene, ImagePlacement::Perspective, 70, 50);
  scene.Options.Threshold = 0;
  return scene;
}

/// A function with a thin, dense shell between smooth parts.
void AddThinShell(ImageScene& scene)
{
  TransferFunction function;
  const auto add = [&](double scalar, double opacity, double red)
  {
    const TransferFunction::Value value{ { red, 0.5, 1 - red }, opacity };
    function.Nodes.push_back({ scalar, value, value });
  };
  add(0.3, 0, 0.2);
  add(0.49, 0.02, 0.4);
  add(0.495, 0.6, 1);
  add(0.5, 0.02, 0.4);
  add(0.8, 0.1, 0.1);
  scene.Optics.Function = function;
}

/// Largest and mean difference of channels from the integral.
ImageError CompareWithIntegral(const ImageScene& scene, const CastPicture& picture)
{
  const std::vector<ReferencePixel> exact =
    IntegrateReferenceImage(scene.GetVolume(), scene.Optics, scene.Grid, scene.GetLimits());
  ImageError error;
  error.Rays = static_cast<std::int64_t>(exact.size());
  std::int64_t count = 0;
  double sum = 0;
  for (std::size_t pixel = 0; pixel < exact.size(); ++pixel)
  {
    for (int c = 0; c < 4; ++c)
    {
      const double difference = std::abs(exact[pixel].Rgba[c] - picture.Colors[4 * pixel + c]);
      error.Largest = std::max(error.Largest, difference);
      if (exact[pixel].Rgba[3] > 0 || picture.Colors[4 * pixel + 3] > 0)
      {
        sum += difference;
        ++count;
      }
    }
  }
  error.Mean = sum / static_cast<double>(count);
  return error;
}

TEST(ImageError, IsThatOfTheIntegral)
{
  for (const double distance : { 0.3, 1., 3. })
  {
    SCOPED_TRACE(distance);
    ImageScene scene = MakeScene();
    scene.Options.SampleDistance = distance;
    ImageCaster caster;
    caster.SetVolume(scene.GetVolume());
    caster.SetOptics(scene.Optics);
    const CastPicture picture = Cast(caster, scene);
    const ImageError exact = CompareWithIntegral(scene, picture);
    const ImageError estimate = EstimateImageError(
      caster, scene.Grid, scene.GetLimits(), scene.Options, Span<const float>(picture.Colors));
    EXPECT_GT(estimate.Rays, 500);
    // One in four of the rays, and a 64th of the error is in what they are compared with.
    EXPECT_LE(estimate.Largest, 1.1 * exact.Largest);
    EXPECT_GE(estimate.Largest, 0.5 * exact.Largest);
    EXPECT_NEAR(estimate.Mean, exact.Mean, 0.2 * exact.Mean);
  }
}

TEST(ImageError, CountsEarlyEnds)
{
  ImageScene scene = MakeScene();
  scene.Options.SampleDistance = 0.1;
  scene.Options.Threshold = 0.5;
  ImageCaster caster;
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  const CastPicture picture = Cast(caster, scene);
  const ImageError estimate = EstimateImageError(
    caster, scene.Grid, scene.GetLimits(), scene.Options, Span<const float>(picture.Colors));
  EXPECT_GT(estimate.Largest, 0.05);
  EXPECT_LE(estimate.Largest, 0.5);
}

TEST(ImageError, HonoursWhatLimitsRays)
{
  ImageScene scene = MakeScene();
  scene.Options.SampleDistance = 0.7;
  scene.MaximumDistances.assign(scene.GetNumberOfPixels(), 0.f);
  ImageCaster caster;
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  const CastPicture picture = Cast(caster, scene);
  const ImageError estimate = EstimateImageError(
    caster, scene.Grid, scene.GetLimits(), scene.Options, Span<const float>(picture.Colors));
  EXPECT_EQ(estimate.Largest, 0);
}

TEST(ImageError, ChoosesADistanceWithinIt)
{
  double last = 100;
  for (const double wished : { 1e-1, 1e-2, 1e-3, 1e-4 })
  {
    SCOPED_TRACE(wished);
    ImageScene scene = MakeScene();
    scene.Options.SampleDistance = 4;
    ImageCaster caster;
    caster.SetVolume(scene.GetVolume());
    caster.SetOptics(scene.Optics);
    const double distance =
      ChooseSampleDistance(caster, scene.Grid, scene.GetLimits(), scene.Options, wished);
    EXPECT_LE(distance, last);
    EXPECT_EQ(std::exp2(std::round(std::log2(distance))), distance);
    scene.Options.SampleDistance = distance;
    // What is found between two distances is three quarters of the error, of one ray in four.
    EXPECT_LE(CompareWithIntegral(scene, Cast(caster, scene)).Largest, 2 * wished);
    last = distance;
  }
  EXPECT_LT(last, 0.5);
}

TEST(ImageSlabs, ConvergeToTheIntegral)
{
  for (const StepOpacity model : { StepOpacity::Power, StepOpacity::Attenuation })
  {
    ImageScene scene = MakeScene();
    scene.Optics.Opacity = model;
    scene.Options.PreIntegrated = true;
    double last = 1;
    for (const double distance : { 2., 1., 0.5, 0.25 })
    {
      SCOPED_TRACE(distance);
      scene.Options.SampleDistance = distance;
      const double mean = CompareWithIntegral(scene, Cast(scene)).Mean;
      // By the square of the distance, but for what the table is off by.
      EXPECT_LT(mean, std::max(0.35 * last, 2e-4));
      last = mean;
    }
  }
}

TEST(ImageSlabs, MissNoThinShell)
{
  ImageScene scene = MakeScene();
  AddThinShell(scene);
  scene.Options.SampleDistance = 1;
  const double samples = CompareWithIntegral(scene, Cast(scene)).Mean;
  scene.Options.PreIntegrated = true;
  const double slabs = CompareWithIntegral(scene, Cast(scene)).Mean;
  EXPECT_LT(slabs, 0.25 * samples);
}

TEST(ImageSlabs, ConstantVolumesAreExact)
{
  ImageScene scene = MakeScene();
  const int points = scene.Dimensions[0] * scene.Dimensions[1] * scene.Dimensions[2];
  scene.SetValues(ImageScalar::Float, std::vector<double>(points, 0.6));
  for (const double distance : { 5., 0.9, 0.11 })
  {
    SCOPED_TRACE(distance);
    scene.Options.SampleDistance = distance;
    scene.Options.PreIntegrated = true;
    // Texels are as exact as single precision, and slabs add up some roundings.
    EXPECT_LE(CompareWithIntegral(scene, Cast(scene)).Largest, 1e-5);
  }
}

TEST(ImageSlabs, AreTheSameBitsForAnyTilesAndThreads)
{
  ImageScene scene = MakeScene();
  AddThinShell(scene);
  scene.Options.PreIntegrated = true;
  scene.Options.NumberOfThreads = 1;
  ImageCaster caster; // which keeps its table
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  const CastPicture expected = Cast(caster, scene);
  for (const int tile : { 4, 16, 64 })
  {
    for (const bool triangles : { false, true })
    {
      for (const bool space : { false, true })
      {
        scene.Options.TileSize = tile;
        scene.Options.Triangles = triangles;
        scene.Options.SkipEmptySpace = space;
        scene.Options.NumberOfThreads = 3;
        EXPECT_TRUE(IsSame(Cast(caster, scene), expected))
          << tile << " " << triangles << " " << space;
      }
    }
  }
}

TEST(ImageSlabs, DoNotDependOnThePictureBefore)
{
  ImageScene scene = MakeScene();
  scene.Options.PreIntegrated = true;
  ImageCaster caster;
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  for (const double distance : { 1., 1.06, 1.12, 0.95, 1.06 })
  {
    SCOPED_TRACE(distance);
    scene.Options.SampleDistance = distance;
    EXPECT_TRUE(IsSame(Cast(caster, scene), Cast(scene)));
  }
}

TEST(ImageSlabs, RefuseGradients)
{
  ImageScene scene = MakeScene();
  scene.Options.PreIntegrated = true;
  scene.Options.Shaded = true;
  EXPECT_THROW(Cast(scene), std::invalid_argument);
  scene.Options.Shaded = false;
  scene.Optics.GradientOpacity = scene.Optics.Function;
  EXPECT_THROW(Cast(scene), std::invalid_argument);
}

} // namespace
} // namespace tetralux
