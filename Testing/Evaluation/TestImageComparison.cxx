// SPDX-License-Identifier: BSD-3-Clause
#include "ImageComparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace
{

using namespace tetralux;

TEST(ImageComparison, CountsCoveredAndUngrazedPixels)
{
  // 4000 covered pixels, of which 3 are off; 1000 empty ones.
  std::vector<double> reference(4 * 5000, 0.0);
  std::fill(reference.begin(), reference.begin() + 4 * 4000, 0.5);
  std::vector<float> picture(reference.begin(), reference.end());
  picture[4 * 10 + 1] += 0.25f;
  picture[4 * 20 + 3] -= 0.0009765625f; // exact in binary, above 1e-4
  picture[4 * 30 + 0] += 0.015625f;     // above 1/255
  picture[4 * 30 + 1] += 0.015625f;
  std::vector<double> grazing(5000, 0.0);
  grazing[10] = 1;
  const ImageComparison result = CompareWithReference(picture, reference, grazing);
  EXPECT_EQ(result.Covered.NumberOfPixels, 4000u);
  EXPECT_EQ(result.Covered.Maximum, 0.25);
  EXPECT_EQ(result.Covered.WorstPixel, 10u);
  EXPECT_DOUBLE_EQ(result.Covered.ShareAbove1e4, 3.0 / 4000);
  EXPECT_DOUBLE_EQ(result.Covered.ShareAbove1Of255, 2.0 / 4000);
  EXPECT_EQ(result.Covered.Quantile999, 0);
  EXPECT_NEAR(result.Covered.RootMeanSquare,
    std::sqrt((0.0625 + std::pow(2.0, -20) + 2 * std::pow(2.0, -12)) / 16000), 1e-12);
  EXPECT_EQ(result.Ungrazed.NumberOfPixels, 3999u);
  EXPECT_EQ(result.Ungrazed.Maximum, 0.015625);
  EXPECT_EQ(result.Ungrazed.WorstPixel, 30u);
}

TEST(ImageComparison, QuantileIsThatOfTheWorstPixels)
{
  std::vector<double> reference(4 * 2000, 0.25);
  std::vector<float> picture(4 * 2000, 0.25f);
  for (int pixel = 0; pixel < 2000; ++pixel)
  {
    picture[4 * pixel] += static_cast<float>(pixel) / 8192; // exact in binary
  }
  // 1998 of 2000 pixels are 99.9 %.
  EXPECT_EQ(CompareWithReference(picture, reference).Covered.Quantile999, 1997.0 / 8192);
}

TEST(ImageComparison, WhatIsNotANumberIsInfinitelyWrong)
{
  const std::vector<double> reference(8, 0.0);
  std::vector<float> picture(8, 0.0f);
  EXPECT_EQ(CompareWithReference(picture, reference).Covered.NumberOfPixels, 0u);
  picture[5] = std::numeric_limits<float>::quiet_NaN();
  const ImageComparison result = CompareWithReference(picture, reference);
  EXPECT_EQ(result.Covered.NumberOfPixels, 1u);
  EXPECT_TRUE(std::isinf(result.Covered.Maximum));
  EXPECT_EQ(result.Covered.WorstPixel, 1u);
}

TEST(ImageComparison, RefusesDifferentSizes)
{
  EXPECT_THROW(
    CompareWithReference(std::vector<float>(8), std::vector<double>(4)), std::invalid_argument);
  EXPECT_THROW(
    CompareWithReference(std::vector<float>(8), std::vector<double>(8), std::vector<double>(8)),
    std::invalid_argument);
}

} // namespace
