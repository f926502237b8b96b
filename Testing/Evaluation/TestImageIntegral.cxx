// SPDX-License-Identifier: BSD-3-Clause
#include "ImageIntegral/ImageIntegral.h"
#include "ReferenceImage.h"
#include "TriangleCaster/ImageScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

std::vector<double> IntegrateScene(const ImageScene& scene, int threads = 1)
{
  return IntegrateImage(scene.GetVolume(), scene.Optics, scene.Grid, threads);
}

/// The largest difference of a channel from the oracle's.
double FindError(const ImageScene& scene)
{
  const std::vector<double> pixels = IntegrateScene(scene);
  const std::vector<ReferencePixel> exact =
    IntegrateReferenceImage(scene.GetVolume(), scene.Optics, scene.Grid, RayLimits());
  double largest = 0;
  for (std::size_t pixel = 0; pixel < exact.size(); ++pixel)
  {
    for (int c = 0; c < 4; ++c)
    {
      const double error = std::abs(pixels[4 * pixel + c] - exact[pixel].Rgba[c]);
      largest = error <= largest ? largest : error;
    }
  }
  return largest;
}

TEST(ImageIntegral, IsThatOfTheOracle)
{
  std::mt19937_64 generator(11);
  for (int i = 0; i < 40; ++i)
  {
    SCOPED_TRACE(i);
    ImageScene scene = MakeRandomImageScene(generator);
    // Near the origin, where rays are not rounded otherwise.
    ImagePlacement().Apply(
      scene, static_cast<ImagePlacement::Camera>(i % ImagePlacement::NumberOfCameras), 9, 7);
    scene.Optics.UnitDistance = 1.5;
    EXPECT_LE(FindError(scene), ImageIntegralError);
  }
}

TEST(ImageIntegral, MeetsSteepAndOpaqueFunctions)
{
  ImageScene scene = MakeSmoothImageScene();
  ImagePlacement().Apply(scene, ImagePlacement::Perspective, 14, 10);
  const auto add = [&](double scalar, double left, double right)
  {
    scene.Optics.Function.Nodes.push_back(
      { scalar, { { scalar, 0.5, 1 - left }, left }, { { 0.2, scalar, right }, right } });
  };
  // A needle, a step and what is opaque.
  scene.Optics.Function.Nodes.clear();
  add(0.2, 0, 0);
  add(0.2005, 0.9, 0.9);
  add(0.201, 0.01, 0.01);
  add(0.5, 0.02, 0.5);
  add(0.7, 1, 1);
  scene.Optics.UnitDistance = 0.01;
  EXPECT_LE(FindError(scene), ImageIntegralError);
}

TEST(ImageIntegral, IsNotOpaqueWhereTheLargestScalarIsATouch)
{
  // Scalars fall from the face that rays come in by, where alone the opacity is 1.
  ImageScene scene;
  scene.Dimensions = { 4, 5, 3 };
  std::vector<double> scalars;
  for (int point = 0; point < 4 * 5 * 3; ++point)
  {
    scalars.push_back(0.3 + 0.35 * (point / (4 * 5)));
  }
  scene.SetValues(ImageScalar::Float, scalars);
  scene.Optics.Function.Nodes = { { 0.3, { { 0, 0, 1 }, 0 }, { { 0, 0, 1 }, 0 } },
    { static_cast<float>(0.3 + 0.35 * 2), { { 1, 0, 0 }, 1 }, { { 1, 0, 0 }, 1 } } };
  scene.Optics.UnitDistance = 10;
  for (int camera = 0; camera < ImagePlacement::NumberOfCameras; ++camera)
  {
    ImagePlacement().Apply(scene, static_cast<ImagePlacement::Camera>(camera), 30, 20);
    for (const double channel : IntegrateScene(scene))
    {
      EXPECT_LT(channel, 0.6);
    }
  }
}

TEST(ImageIntegral, LeavesOutCellsOfWhatIsNoNumber)
{
  ImageScene scene = MakeSmoothImageScene();
  ImagePlacement().Apply(scene, ImagePlacement::Parallel, 14, 10);
  std::vector<double> shares = MakeSmoothShares(scene.Dimensions);
  shares[shares.size() / 2 + 7] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> whole = IntegrateScene(scene);
  scene.SetValues(ImageScalar::Float, shares);
  EXPECT_NE(IntegrateScene(scene), whole);
  EXPECT_LE(FindError(scene), ImageIntegralError);
}

TEST(ImageIntegral, DoesNotDependOnThreads)
{
  ImageScene scene = MakeSmoothImageScene();
  ImagePlacement().Apply(scene, ImagePlacement::Perspective, 20, 30);
  EXPECT_EQ(IntegrateScene(scene, 1), IntegrateScene(scene, 3));
}

TEST(ImageIntegral, RefusesWhatItDoesNotIntegrate)
{
  ImageScene scene = MakeSmoothImageScene();
  ImagePlacement().Apply(scene, ImagePlacement::Perspective, 2, 2);
  const ImageOptics optics = scene.Optics;
  scene.Optics.Blend = ImageBlend::Additive;
  EXPECT_THROW(IntegrateScene(scene), std::invalid_argument);
  scene.Optics = optics;
  scene.Optics.GradientOpacity = optics.Function;
  EXPECT_THROW(IntegrateScene(scene), std::invalid_argument);
  const unsigned char mask[] = { 1 };
  ImageVolume volume = scene.GetVolume();
  volume.Mask = mask;
  EXPECT_THROW(IntegrateImage(volume, optics, scene.Grid, 1), std::invalid_argument);
}

} // namespace
} // namespace tetralux
