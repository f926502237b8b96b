// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/LightSteps.h"

#include <gtest/gtest.h>

namespace
{

using namespace tetralux;

Light MakeLight(bool positional)
{
  Light light{};
  light.Positional = positional;
  for (int c = 0; c < 3; ++c)
  {
    light.Ambient[c] = light.Diffuse[c] = light.Specular[c] = 1;
  }
  return light;
}

TEST(LightSteps, LightVariesByGradientsOfPointsAndByPositions)
{
  const std::vector<Light> distant = { MakeLight(false) };
  const std::vector<Light> near = { MakeLight(false), MakeLight(true) };
  EXPECT_EQ(FindLighting(false, true, near), Lighting::None);
  EXPECT_EQ(FindLighting(true, false, distant), Lighting::Even);
  EXPECT_EQ(FindLighting(true, true, distant), Lighting::Varying);
  EXPECT_EQ(FindLighting(true, false, near), Lighting::Varying);
}

TEST(LightSteps, AnEighthOfTheErrorHalvesTheSteps)
{
  Light light = MakeLight(true);
  light.Attenuation[2] = 1;
  const LightSteps steps = FindLightSteps({ light }, {}, 1e-5);
  const LightSteps half = FindLightSteps({ light }, {}, 1e-5 / 8);
  EXPECT_NEAR(half.Turn, steps.Turn / 2, 1e-12);
  EXPECT_NEAR(half.Approach, steps.Approach / 2, 1e-12);
  EXPECT_GT(steps.Turn, 0);
}

TEST(LightSteps, WhatNarrowsHighlightsShortensSteps)
{
  const std::vector<Light> lights = { MakeLight(false) };
  Material surface;
  const double wide = FindLightSteps(lights, surface, 1e-5).Turn;
  surface.SpecularPower = 100;
  const double narrow = FindLightSteps(lights, surface, 1e-5).Turn;
  EXPECT_LT(narrow, wide / 2);
  Light spot = MakeLight(true);
  spot.ConeCosine = 0.9;
  spot.Exponent = 200;
  EXPECT_LT(FindLightSteps({ spot }, surface, 1e-5).Turn, narrow);
  surface.Specular = 0;
  EXPECT_GT(FindLightSteps(lights, surface, 1e-5).Turn, wide);
}

TEST(LightSteps, StepsHaveAnEndAndTellTheErrorThatIsLeft)
{
  const std::vector<Light> lights = { MakeLight(false) };
  Material surface;
  EXPECT_EQ(FindLightSteps(lights, surface, 1e-5).Error, 1e-5);
  surface.SpecularPower = 1e8;
  const LightSteps steps = FindLightSteps(lights, surface, 1e-5);
  EXPECT_GT(steps.Turn, 1e-3);
  EXPECT_GT(steps.Error, 1);
}

TEST(LightSteps, DarkLightsAreAsCurvedAsBrightOnes)
{
  Light dark = MakeLight(false);
  for (int c = 0; c < 3; ++c)
  {
    dark.Diffuse[c] = dark.Specular[c] = -1;
  }
  const LightSteps both = FindLightSteps({ MakeLight(false), dark }, {}, 1e-5);
  EXPECT_LT(both.Turn, FindLightSteps({ MakeLight(false) }, {}, 1e-5).Turn);
}

TEST(LightSteps, NoErrorAtAllIsThatOfSinglePrecision)
{
  const std::vector<Light> lights = { MakeLight(false) };
  const LightSteps steps = FindLightSteps(lights, {}, 0);
  EXPECT_GT(steps.Turn, 0.01);
  EXPECT_EQ(steps.Turn, FindLightSteps(lights, {}, SmallestLightError).Turn);
}

TEST(LightSteps, NothingThatShinesNeedsNoSteps)
{
  const LightSteps steps = FindLightSteps({}, {}, 1e-9);
  EXPECT_EQ(steps.Turn, 1);
  EXPECT_EQ(steps.Approach, 1);
}

} // namespace
