// SPDX-License-Identifier: BSD-3-Clause

// Gradients of image data, against the plain loop.

#include "GradientScene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace tetralux
{
namespace
{

TEST(ImageGradients, AreCentralDifferences)
{
  for (const ImageScalar type : Types)
  {
    for (const GradientNorm norm : Norms)
    {
      for (const bool portable : { false, true })
      {
        SCOPED_TRACE(testing::Message() << "type " << static_cast<int>(type) << ", norm "
                                        << static_cast<int>(norm) << ", portable " << portable);
        ImageScene scene = MakeGradientScene(type);
        scene.Optics.Norm = norm;
        scene.Options.PortableKernels = portable;
        ExpectGradientReference(scene, GradientRounding);
        scene.Optics.Opacity = StepOpacity::Attenuation;
        scene.Options.Shape = SliceShape::Shells;
        ExpectGradientReference(scene, GradientRounding);
      }
    }
  }
}

TEST(ImageGradients, AreOneSidedAtBorders)
{
  // All cells are at borders.
  for (const std::array<int, 3>& dimensions :
    { std::array<int, 3>{ 2, 2, 2 }, { 3, 2, 3 }, { 2, 9, 3 } })
  {
    for (const ImageScalar type : Types)
    {
      SCOPED_TRACE(testing::Message() << dimensions[0] << ", type " << static_cast<int>(type));
      ImageScene scene = MakeGradientScene(type);
      scene.Dimensions = dimensions;
      scene.SetValues(type, MakeSmoothShares(dimensions));
      scene.Optics.GradientOpacity.Nodes.back().Scalar = 0.7;
      ImagePlacement().Apply(scene, ImagePlacement::Perspective, 44, 33);
      scene.Options.SampleDistance = 0.3;
      ExpectGradientReference(scene, GradientRounding);
    }
  }
}

TEST(ImageGradients, OfLinearScalarsAreConstant)
{
  // The same up to the border, so the opacity is that of a constant volume.
  ImageScene scene = MakeScene(ImageScalar::Float, ImagePlacement::Parallel);
  SetLinear(scene, { 0.3, -0.2, 0.05 });
  scene.Optics.Function = MakeConstantFunction(0.2, { 1, 1, 1 });
  scene.Optics.GradientOpacity = MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 2, 0, 0, 0, 1 } });
  double world[3] = { 0, 0, 0 };
  const double gradient[3] = { 0.3, -0.2, 0.05 };
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      world[a] += scene.Grid.MeshFromWorld[b][a] * gradient[b];
    }
  }
  const double lengths[] = { std::hypot(world[0], world[1], world[2]),
    std::abs(world[0]) + std::abs(world[1]) + std::abs(world[2]) };
  for (const GradientNorm norm : Norms)
  {
    for (const GradientSource source : Sources)
    {
      SCOPED_TRACE(static_cast<int>(norm));
      scene.Optics.Norm = norm;
      scene.Options.Gradients = source;
      const CastPicture lit = Cast(scene);
      ImageScene constant = scene;
      const double factor = scene.Optics.GradientLength * lengths[static_cast<int>(norm)] / 2;
      constant.Optics.Function = MakeConstantFunction(0.2 * factor, { 1, 1, 1 });
      constant.Optics.GradientOpacity.Nodes.clear();
      // Bytes have half of 1/127 of the largest component; all three may be off by that.
      const double tolerance = source == GradientSource::Bytes ? 0.5 / 127 * 3 : GradientRounding;
      EXPECT_LE(FindDifference(lit, Cast(constant)), tolerance);
      EXPECT_GT(CountVisible(lit), 200);
    }
  }
}

TEST(ImageGradients, MayLeaveOpacityAsItIs)
{
  // A factor of 1 everywhere, where scalars come with the bytes, and where they do not.
  for (const ImageScalar type : Types)
  {
    ImageScene scene = MakeScene(type);
    const CastPicture plain = Cast(scene);
    scene.Optics.GradientOpacity = MakeConstantFunction(1, { 0, 0, 0 });
    for (const GradientSource source : Sources)
    {
      scene.Options.Gradients = source;
      EXPECT_TRUE(IsSame(Cast(scene), plain)) << static_cast<int>(type);
    }
  }
}

TEST(ImageGradients, BesideWhatIsNotANumberAreNone)
{
  const float odd[] = { NaN, std::numeric_limits<float>::infinity(),
    -std::numeric_limits<float>::max() };
  for (const float value : odd)
  {
    for (const GradientSource source : Sources)
    {
      for (const LightSum sum : Sums)
      {
        SCOPED_TRACE(
          testing::Message() << value << ", " << static_cast<int>(source) << static_cast<int>(sum));
        ImageScene scene = MakeLitScene(ImageScalar::Float, ImagePlacement::Parallel);
        scene.Optics.GradientOpacity = MakeGradientScene(ImageScalar::Float).Optics.GradientOpacity;
        scene.Options.Gradients = source;
        scene.Options.SumOfLights = sum;
        const CastPicture whole = Cast(scene);
        const std::size_t point = 16 + 33 * (10 + 20 * 8);
        std::memcpy(&scene.Values[point * sizeof(float)], &value, sizeof(float));
        const CastPicture picture = Cast(scene);
        EXPECT_TRUE(IsFinite(picture));
        int changed = 0;
        for (std::size_t k = 0; k < picture.Colors.size(); ++k)
        {
          changed += std::abs(picture.Colors[k] - whole.Colors[k]) > GradientRounding ? 1 : 0;
        }
        EXPECT_GT(changed, 0);
        // Bytes of a volume with a number as large as that have nothing left of the others.
        if (std::isfinite(value) && source == GradientSource::Bytes)
        {
          continue;
        }
        // Three cells around a point of 33 x 20 x 17.
        EXPECT_LT(changed, static_cast<int>(picture.Colors.size()) / 4);
      }
    }
  }
}

TEST(ImageGradients, MayBeOfAnySize)
{
  for (const double size : { 1e-42, 1e-30, 1e30, 1e38 })
  {
    for (const GradientSource source : Sources)
    {
      for (const LightSum sum : Sums)
      {
        SCOPED_TRACE(
          testing::Message() << size << ", " << static_cast<int>(source) << static_cast<int>(sum));
        ImageScene scene = MakeLitScene(ImageScalar::Float, ImagePlacement::Parallel);
        std::vector<double> values = MakeSmoothShares(scene.Dimensions);
        for (double& value : values)
        {
          value *= size;
        }
        scene.SetValues(ImageScalar::Float, values);
        scene.Scale = 1 / size;
        scene.Options.Gradients = source;
        scene.Options.SumOfLights = sum;
        EXPECT_TRUE(IsFinite(Cast(scene)));
      }
    }
  }
}

TEST(ImageGradients, DoNotDependOnThreads)
{
  for (const ImageScalar type : Types)
  {
    for (const GradientSource source : Sources)
    {
      for (const LightSum sum : Sums)
      {
        SCOPED_TRACE(testing::Message() << "type " << static_cast<int>(type));
        ImageScene scene = MakeLitScene(type);
        scene.Optics.Table = MakeRandomTable(32, 32);
        scene.Options.Gradients = source;
        scene.Options.SumOfLights = sum;
        scene.Options.FarColor[0] = 0.5f;
        scene.Options.NumberOfThreads = 1;
        const CastPicture one = Cast(scene);
        for (const int threads : { 2, 3, 7 })
        {
          scene.Options.NumberOfThreads = threads;
          EXPECT_TRUE(IsSame(Cast(scene), one)) << threads;
        }
        scene.Options.PortableKernels = true;
        EXPECT_LE(FindDifference(Cast(scene), one), LightRounding);
      }
    }
  }
}

} // namespace
} // namespace tetralux
