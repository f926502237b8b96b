// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/LargestChannel.h"

#include "ReferenceScenes.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

namespace
{

using tetralux::EstimateLargestChannel;
using tetralux::MakeLinearFunction;
using tetralux::OpticalModel;
using tetralux::RaySample;
using tetralux::TransferFunction;

constexpr double Attenuation = 3;
constexpr double Green = 0.75;

/// One colour and attenuation everywhere, green by far the brightest.
TransferFunction MakeFunction(double green = Green)
{
  return MakeLinearFunction(
    { { -1, 0.2, green, 0.1, Attenuation }, { 1, 0.2, green, 0.1, Attenuation } });
}

/// Rays of 1, 2, 3, ... cells of length 1.
RaySample MakeRays(int numberOfRays)
{
  RaySample sample;
  for (int ray = 1; ray <= numberOfRays; ++ray)
  {
    sample.Rays.emplace_back(ray, tetralux::RaySegment{ -0.5, 0.5, 1 });
  }
  return sample;
}

TEST(LargestChannel, OfEmissionIsTheLargestSum)
{
  constexpr int NumberOfRays = 40;
  constexpr double Scale = 2.5;
  constexpr double Expected = NumberOfRays * Scale * Attenuation * Green;
  ForEachThreadCount(
    []
    {
      EXPECT_NEAR(EstimateLargestChannel(
                    MakeRays(NumberOfRays), Scale, MakeFunction(), OpticalModel::EmissionOnly),
        Expected, 1e-12 * Expected);
    });
  EXPECT_NEAR(EstimateLargestChannel(
                MakeRays(NumberOfRays), Scale, MakeFunction(-Green), OpticalModel::EmissionOnly),
    Expected, 1e-12 * Expected)
    << "of negative colours as well";
}

TEST(LargestChannel, IsAtLeastOne)
{
  EXPECT_EQ(
    EstimateLargestChannel(MakeRays(3), 0.01, MakeFunction(), OpticalModel::EmissionOnly), 1);
  EXPECT_EQ(EstimateLargestChannel(RaySample(), 1, MakeFunction(), OpticalModel::EmissionOnly), 1);
}

TEST(LargestChannel, OfOtherModelsIsThatOfColours)
{
  for (const OpticalModel model : { OpticalModel::EmissionAbsorption, OpticalModel::AbsorptionOnly,
         OpticalModel::MaximumIntensity, OpticalModel::Isosurfaces })
  {
    EXPECT_EQ(EstimateLargestChannel(MakeRays(40), 1, MakeFunction(), model), 1);
    EXPECT_EQ(EstimateLargestChannel(MakeRays(40), 1, MakeFunction(-8), model), 8);
  }
}

} // namespace
