// SPDX-License-Identifier: BSD-3-Clause

// Colours that depend on the depth of slices.

#include "GradientScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

TEST(ImageDepthCueing, IsLinearInDepth)
{
  // A constant volume along an axis, in one and in two slabs.
  ImageScene scene = MakeScene(ImageScalar::Float);
  scene.Optics.Function = MakeConstantFunction(0.1, { 1, 0.5, 0.25 });
  ImagePlacement placement;
  placement.Oblique = false;
  placement.Apply(scene, ImagePlacement::AlongAxis, 12, 9);
  const double depth = scene.Dimensions[2] - 1;
  scene.Optics.UnitDistance = depth;
  const float near[] = { 0.9f, 1.2f, 0 };
  const float far[] = { 0.1f, 1.2f, 2 };
  std::copy(near, near + 3, scene.Options.NearColor);
  std::copy(far, far + 3, scene.Options.FarColor);
  for (const bool preIntegrated : { false, true })
  {
    scene.Options.PreIntegrated = preIntegrated;
    for (const int slabs : { 1, 2 })
    {
      // The last slab ends with the volume, and not by rounding before it.
      scene.Options.SampleDistance = depth / slabs * (1 + 1e-9);
      const CastPicture picture = Cast(scene);
      ASSERT_EQ(picture.Statistics.Slices, slabs);
      const double alpha = 1 - std::pow(0.9, 1. / slabs);
      const double colors[] = { 1, 0.5, 0.25 };
      for (int c = 0; c < 3; ++c)
      {
        double expected = 0;
        for (int s = 0; s < slabs; ++s)
        {
          const double place = (s + 0.5) / slabs;
          expected += std::pow(1 - alpha, s) * alpha * (near[c] + place * (far[c] - near[c]));
        }
        const std::size_t middle = 4 * (4 * 12 + 6);
        EXPECT_NEAR(picture.Colors[middle + c], expected * colors[c], ConstantError);
      }
    }
  }
}

TEST(ImageDepthCueing, IsThatOfThePlainLoop)
{
  for (int camera = 0; camera < ImagePlacement::NumberOfCameras; ++camera)
  {
    for (const SliceShape shape : { SliceShape::Planes, SliceShape::Shells })
    {
      for (const bool shaded : { false, true })
      {
        SCOPED_TRACE(testing::Message()
          << "camera " << camera << ", shape " << static_cast<int>(shape) << ", shaded " << shaded);
        ImageScene scene =
          MakeLitScene(ImageScalar::UInt8, static_cast<ImagePlacement::Camera>(camera));
        scene.Options.Shape = shape;
        scene.Options.Shaded = shaded;
        scene.Options.NearColor[1] = 0.8f;
        scene.Options.FarColor[0] = 0.1f;
        ExpectGradientReference(scene, LightRounding);
      }
    }
  }
}

TEST(ImageDepthCueing, LeavesOpacityAsItIs)
{
  ImageScene scene = MakeScene(ImageScalar::Int16);
  const CastPicture plain = Cast(scene);
  scene.Options.FarColor[1] = 0.2f;
  const CastPicture cued = Cast(scene);
  EXPECT_EQ(cued.Depths, plain.Depths);
  for (std::size_t k = 0; k < plain.Colors.size(); k += 4)
  {
    EXPECT_EQ(cued.Colors[k], plain.Colors[k]);
    EXPECT_LE(cued.Colors[k + 1], plain.Colors[k + 1]);
    EXPECT_EQ(cued.Colors[k + 2], plain.Colors[k + 2]);
    EXPECT_EQ(cued.Colors[k + 3], plain.Colors[k + 3]);
  }
  EXPECT_GT(FindDifference(cued, plain), 0.1);
}

TEST(ImageDepthCueing, IsForSlabsButTablesAreNot)
{
  ImageScene scene = MakeScene(ImageScalar::Int16);
  scene.Options.PreIntegrated = true;
  scene.Options.NearColor[2] = 0.2f;
  EXPECT_NO_THROW(Cast(scene));
  scene.Optics.Table = MakeRandomTable(4, 4);
  EXPECT_THROW(Cast(scene), std::invalid_argument);
}

} // namespace
} // namespace tetralux
