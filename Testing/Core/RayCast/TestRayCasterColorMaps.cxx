// SPDX-License-Identifier: BSD-3-Clause
// Pictures of colour maps by runs of their intervals, against those by each interval in double
// precision.
#include "ColorMaps.h"
#include "RayScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace
{

using tetralux::ColorMap;
using tetralux::MakeColorMaps;
using tetralux::MakeRunTolerance;
using tetralux::OpticalModel;
using tetralux::Precision;
using tetralux::RayCastOptions;
using tetralux::RayPicture;
using tetralux::RayScene;
using tetralux::VolumeScene;

/// The share of the error that runs have, as with a mapper: three quarters of an eighth.
constexpr double ShareOfRuns = 0.75 * 0.125;

/// The exact way's own error, of a channel.
constexpr double ExactError = 1e-7;

/// Longer than any ray in the mesh, world units.
constexpr double LongestPath = 2;

constexpr int Width = 40;
constexpr int Height = 30;

RayScene MakeScene()
{
  RayScene scene;
  scene.Mesh = tetralux::MakeBox(6, 6, 6, { 0, 0, 0 }, { 1, 1, 1 }, 0.15);
  scene.Scalars = tetralux::MakeSmoothField(scene.Mesh);
  scene.Grid = tetralux::MakePerspectiveGrid(
    { 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, Width, Height);
  return scene;
}

/// Largest difference of a channel.
double Compare(const RayPicture& a, const RayPicture& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.Colors.size(); ++i)
  {
    largest = std::max<double>(largest, std::abs(a.Colors[i] - b.Colors[i]));
  }
  return largest;
}

/// Casts a scene for each map, model and error, and tells how far runs are off the exact way.
void ExpectWithinError(
  RayScene& scene, const std::vector<double>& attenuations, const std::vector<OpticalModel>& models)
{
  for (const double attenuation : attenuations)
  {
    for (const ColorMap& map : MakeColorMaps(attenuation))
    {
      scene.Function = map.Function;
      for (const OpticalModel model : models)
      {
        scene.Model = model;
        VolumeScene volume = scene.MakeVolumeScene();
        RayCastOptions exact;
        exact.MaximumError = ExactError;
        exact.Arithmetic = Precision::Double;
        const RayPicture expected = Cast(volume, scene, exact);
        ASSERT_GT(*std::max_element(expected.Colors.begin(), expected.Colors.end()), 0.1f);
        for (const double error : { 1e-2, 1e-3, 1e-4 })
        {
          volume.Optics.SetTransferFunction(map.Function, 0,
            MakeRunTolerance(model, map.Function, ShareOfRuns * error, LongestPath));
          RayCastOptions options;
          options.MaximumError = error;
          for (const bool portable : { false, true })
          {
            options.Kernels = tetralux::ChooseKernels(portable);
            const RayPicture picture = Cast(volume, scene, options);
            // Emission alone may exceed 1; single precision is relative to it.
            const float largest =
              std::max(1.f, *std::max_element(expected.Colors.begin(), expected.Colors.end()));
            EXPECT_LE(Compare(picture, expected), error * largest)
              << map.Name << ", attenuation " << attenuation << ", model "
              << static_cast<int>(model) << ", error " << error;
          }
        }
      }
    }
  }
}

TEST(RayCasterColorMaps, AreWithinTheErrorOfTheExactWay)
{
  RayScene scene = MakeScene();
  ExpectWithinError(
    scene, { 2, 300 }, { OpticalModel::EmissionAbsorption, OpticalModel::AbsorptionOnly });
  ExpectWithinError(scene, { 2 }, { OpticalModel::EmissionOnly, OpticalModel::MaximumIntensity });
}

TEST(RayCasterColorMaps, AreWithinTheErrorUnderLight)
{
  RayScene scene = MakeScene();
  scene.Shaded = true;
  tetralux::Light light{};
  light.Position[0] = 0.6;
  light.Position[1] = 0.48;
  light.Position[2] = 0.64;
  for (int c = 0; c < 3; ++c)
  {
    light.Ambient[c] = light.Diffuse[c] = light.Specular[c] = 1;
  }
  scene.Lights = { light };
  for (const bool smooth : { false, true })
  {
    scene.SmoothShading = smooth;
    ExpectWithinError(scene, { 2, 60 }, { OpticalModel::EmissionAbsorption });
  }
}

TEST(RayCasterColorMaps, ByRunsAreNotThoseByIntervals)
{
  // Or nothing above would be tested.
  RayScene scene = MakeScene();
  scene.Function = MakeColorMaps(2).back().Function;
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.Arithmetic = Precision::Double;
  options.MaximumError = ExactError;
  const RayPicture exact = Cast(volume, scene, options);
  volume.Optics.SetTransferFunction(scene.Function, 0,
    MakeRunTolerance(OpticalModel::EmissionAbsorption, scene.Function, 0.03, LongestPath));
  const double difference = Compare(Cast(volume, scene, options), exact);
  EXPECT_GT(difference, 1e-4);
  EXPECT_LE(difference, 0.03);
}

} // namespace
