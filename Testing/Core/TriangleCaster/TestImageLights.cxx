// SPDX-License-Identifier: BSD-3-Clause

// Lights on image data, against the plain loop.

#include "GradientScene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace tetralux
{
namespace
{

TEST(ImageLights, AreThoseOfThePlainLoop)
{
  const Light headlight = MakeHeadlight();
  const Light side = MakeDistantLight({ -0.4, 1, 0.3 }, { 1, 0.4f, 0.2f });
  const Light positional = MakePositionalLight({ 14, -9, 25 });
  const Light spot = MakeSpot({ 20, 25, 30 }, std::cos(0.2));
  const Light wide = MakeSpot({ -30, 25, 30 }, std::cos(1.8));
  const std::vector<Light> sets[] = { { headlight }, { side }, { positional }, { spot },
    { headlight, side, positional, spot, wide }, {} };
  for (const std::vector<Light>& lights : sets)
  {
    for (const ImageScalar type : Types)
    {
      for (const bool portable : { false, true })
      {
        SCOPED_TRACE(testing::Message() << lights.size() << " lights, type "
                                        << static_cast<int>(type) << ", portable " << portable);
        ImageScene scene = MakeLitScene(type);
        scene.Options.Lights = lights;
        scene.Options.PortableKernels = portable;
        ExpectGradientReference(scene, LightRounding);
      }
    }
  }
}

// Of sums of squares central differences are exact, and so are the gradients between them.
TEST(ImageLights, ShineOnIsosurfaces)
{
  const std::array<double, 3> middle = { 10.3, 9.1, 11.8 };
  const std::array<double, 3> factors = { 1, 1.5, 0.7 };
  ImageScene scene;
  scene.Dimensions = { 22, 20, 24 };
  std::vector<double> squares;
  for (int k = 0; k < 24; ++k)
  {
    for (int j = 0; j < 20; ++j)
    {
      for (int i = 0; i < 22; ++i)
      {
        squares.push_back(factors[0] * std::pow(i - middle[0], 2) +
          factors[1] * std::pow(j - middle[1], 2) + factors[2] * std::pow(k - middle[2], 2));
      }
    }
  }
  scene.SetValues(ImageScalar::Float, squares);
  scene.Optics.Function.Nodes = { { 0, { { 1, 1, 1 }, 0 }, { { 1, 1, 1 }, 0 } } };
  scene.Optics.Blend = ImageBlend::Isosurfaces;
  Isosurface surface;
  surface.Value = 49;
  surface.Color[0] = 0.9f;
  surface.Color[1] = 0.6f;
  surface.Color[2] = 0.3f;
  surface.Opacity = 1;
  scene.Optics.Surfaces = { surface };
  scene.Options.Shaded = true;
  scene.Options.Surface.Ambient = 0.1f;
  scene.Options.Surface.Diffuse = 0.7f;
  scene.Options.Surface.Specular = 0.4f;
  scene.Options.Surface.SpecularPower = 12;
  scene.Options.Lights = { MakeHeadlight(), MakePositionalLight({ 14, -9, 25 }) };
  scene.Options.SampleDistance = 0.7;
  const std::array<double, 3> color = { surface.Color[0], surface.Color[1], surface.Color[2] };
  for (const auto camera : { ImagePlacement::Perspective, ImagePlacement::Parallel })
  {
    ImagePlacement placement;
    placement.Spacing = { 1.1, 0.9, 1.2 };
    placement.Apply(scene, camera, 72, 60);
    for (const GradientSource source : { GradientSource::OnTheFly, GradientSource::Bytes })
    {
      scene.Options.Gradients = source;
      // Bytes turn normals by up to a half in 127.
      const double tolerance = source == GradientSource::OnTheFly ? 1e-4 : 0.02;
      const CastPicture picture = Cast(scene);
      int seen = 0;
      for (int pixel = 0; pixel < scene.GetNumberOfPixels(); ++pixel)
      {
        if (picture.Depths[pixel] < 0)
        {
          continue;
        }
        ++seen;
        const int i = pixel % scene.Grid.Width;
        const int j = pixel / scene.Grid.Width;
        const PlainRay ray = MakePlainRay(scene.Grid, SlicePlanes(), i, j);
        const PlainVector index = ray.GetIndex(picture.Depths[pixel]);
        PlainVector gradient;
        for (int a = 0; a < 3; ++a)
        {
          gradient[a] = 2 * factors[a] * (index[a] - middle[a]);
        }
        const PlainVector lit = Shine(scene.Options.Lights, scene.Options.Surface, color,
          ToWorld(scene.Grid, gradient), ray.GetPoint(picture.Depths[pixel]), ray.Direction);
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(picture.Colors[4 * pixel + c], lit[c], tolerance) << i << " " << j;
        }
      }
      EXPECT_GT(seen, 300);
    }
  }
}

TEST(ImageLights, ShineOnWhatGradientsLeave)
{
  for (int camera = 0; camera < ImagePlacement::NumberOfCameras; ++camera)
  {
    SCOPED_TRACE(camera);
    ImageScene scene =
      MakeGradientScene(ImageScalar::UInt16, static_cast<ImagePlacement::Camera>(camera));
    scene.Options.Shaded = true;
    scene.Options.Lights = { MakeHeadlight(), MakePositionalLight({ 14, -9, 25 }) };
    ExpectGradientReference(scene, LightRounding);
  }
}

} // namespace
} // namespace tetralux
