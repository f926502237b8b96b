// SPDX-License-Identifier: BSD-3-Clause

// Gradients that are stored in bytes.

#include "GradientScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace tetralux
{
namespace
{

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

} // namespace
} // namespace tetralux
