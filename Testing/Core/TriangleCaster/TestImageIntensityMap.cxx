// SPDX-License-Identifier: BSD-3-Clause

// Lights that are summed up once for each direction of a map.

#include "GradientScene.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <stdexcept>

namespace tetralux
{
namespace
{

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

} // namespace
} // namespace tetralux
