// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/IsosurfaceTracer.h"

#include "IsosurfacePictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

Light MakeLight(bool positional, const std::array<double, 3>& place)
{
  Light light;
  light.Positional = positional;
  std::copy_n(place.data(), 3, light.Position);
  for (int c = 0; c < 3; ++c)
  {
    light.Ambient[c] = 0.6f;
    light.Diffuse[c] = 0.8f - 0.2f * static_cast<float>(c);
    light.Specular[c] = 0.4f + 0.2f * static_cast<float>(c);
  }
  return light;
}

/// Opaque surfaces of a mesh.
RayScene MakeScene(const char* mesh, const std::map<std::string, double>& parameters)
{
  RayScene scene = MakeIsosurfaceScene(mesh, parameters, 2);
  scene.Isosurfaces[0].Opacity = 1;
  scene.Isosurfaces[1].Opacity = 0.7f;
  scene.Grid = MakeOuterGrid(scene.Mesh, false, 29, 21);
  scene.Shaded = true;
  return scene;
}

/// Compares with the oracle, in perspective and in parallel, and expects shadows in the picture.
void ExpectShadows(RayScene scene)
{
  const std::string lights = std::to_string(scene.Lights.size()) + " lights";
  for (const bool parallel : { false, true })
  {
    for (const bool smooth : { false, true })
    {
      const testing::ScopedTrace trace(__FILE__, __LINE__,
        lights + (parallel ? ", parallel" : "") + (smooth ? ", smooth" : ", flat"));
      scene.SmoothShading = smooth;
      scene.Grid = MakeOuterGrid(scene.Mesh, parallel, 29, 21);
      IsosurfaceOptions options;
      const TracedPicture without = TracePicture(scene, options);
      options.Shadows = true;
      const TracedPicture picture = TracePicture(scene, options);
      EXPECT_FALSE(IsSame(picture, without));
      EXPECT_GT(picture.Statistics.Shadow.Packets, 0);
      ExpectOracle(scene, picture, true);
    }
  }
}

std::vector<RayScene> MakeScenes()
{
  return { MakeScene("random", { { "cells", 8 } }),
    MakeScene("ring", { { "around", 40 }, { "across", 5 } }),
    MakeScene("swinging-ball", { { "cells", 10 }, { "time", 0.2 } }) };
}

std::array<double, 3> GetPlace(const RayScene& scene, double x, double y, double z)
{
  const MeshBox box(scene.Mesh);
  return { box.Middle[0] + x * box.Radius, box.Middle[1] + y * box.Radius,
    box.Middle[2] + z * box.Radius };
}

TEST(IsosurfaceShadows, OfDistantLights)
{
  for (RayScene& scene : MakeScenes())
  {
    scene.Lights = { MakeLight(false, { 0.6, 0.8, 0 }) };
    ExpectShadows(scene);
    scene.Lights = { MakeLight(false, { -0.36, 0.48, 0.8 }) };
    ExpectShadows(scene);
  }
}

TEST(IsosurfaceShadows, OfLightsOutside)
{
  for (RayScene& scene : MakeScenes())
  {
    scene.Lights = { MakeLight(true, GetPlace(scene, 1.2, 1.5, 0.4)) };
    ExpectShadows(scene);
    scene.Lights = { MakeLight(true, GetPlace(scene, -30, 20, 50)) };
    ExpectShadows(scene);
  }
}

TEST(IsosurfaceShadows, OfLightsInside)
{
  for (RayScene& scene : MakeScenes())
  {
    for (const std::array<double, 3>& place :
      { GetPlace(scene, 0, 0, 0), GetPlace(scene, 0.3, -0.2, 0.1), GetPlace(scene, 0.1, 0.4, 0.3) })
    {
      scene.Lights = { MakeLight(true, place) };
      ExpectShadows(scene);
    }
  }
}

TEST(IsosurfaceShadows, OfLightsNearSurfaces)
{
  RayScene scene = MakeScene("random", { { "cells", 8 } });
  const TracedPicture unlit = TracePicture(scene);
  const RayGrid& grid = scene.Grid;
  int lights = 0;
  for (std::size_t p = 0; p < unlit.Depths.size(); p += 71)
  {
    if (unlit.Depths[p] < 0)
    {
      continue;
    }
    // In front of a surface, and behind it.
    for (const double offset : { -1e-3, 1e-3, -1e-5 })
    {
      double direction[3];
      for (int a = 0; a < 3; ++a)
      {
        direction[a] = grid.Direction[a] +
          static_cast<double>(p % grid.Width) * grid.DirectionStepX[a] +
          static_cast<double>(p / grid.Width) * grid.DirectionStepY[a];
      }
      const double length = std::hypot(direction[0], direction[1], direction[2]);
      std::array<double, 3> place;
      for (int a = 0; a < 3; ++a)
      {
        place[a] = grid.Origin[a] + direction[a] / length * (unlit.Depths[p] + offset);
      }
      scene.Lights = { MakeLight(true, place) };
      IsosurfaceOptions options;
      options.Shadows = true;
      ExpectOracle(scene, TracePicture(scene, options), true);
      ++lights;
    }
  }
  EXPECT_GE(lights, 9);
}

TEST(IsosurfaceShadows, OfSpotsAndManyLights)
{
  for (RayScene& scene : MakeScenes())
  {
    scene.Lights = MakeIsosurfaceLights(scene.Mesh);
    ExpectShadows(scene);
  }
}

TEST(IsosurfaceShadows, WhatIsCutAwayBlocksNothing)
{
  for (RayScene& scene : MakeScenes())
  {
    const MeshBox box(scene.Mesh);
    const std::array<double, 3> normal = { -0.5, -0.7, 0.2 };
    const double offset = normal[0] * box.Middle[0] + normal[1] * box.Middle[1] +
      normal[2] * box.Middle[2] - 0.1 * box.Radius;
    scene.Limits.Planes = { { normal[0], normal[1], normal[2], -offset } };
    scene.Lights = { MakeLight(false, { 0.6, 0.8, 0 }),
      MakeLight(true, GetPlace(scene, 1.2, 1.5, 0.4)) };
    ExpectShadows(scene);
    scene.Limits.Cropping = true;
    scene.Limits.CroppingFlags = 0x5a5a5a5;
    for (int a = 0; a < 3; ++a)
    {
      scene.Limits.CroppingPlanes[2 * a] = box.Middle[a] - 0.1 * box.Radius;
      scene.Limits.CroppingPlanes[2 * a + 1] = box.Middle[a] + 0.2 * box.Radius;
    }
    ExpectShadows(scene);
  }
}

TEST(IsosurfaceShadows, WhatTheCameraCutsAwayBlocksLight)
{
  for (RayScene& scene : MakeScenes())
  {
    const MeshBox box(scene.Mesh);
    std::array<double, 3> position;
    std::copy_n(scene.Grid.Origin, 3, position.data());
    const double distance = std::hypot(
      position[0] - box.Middle[0], position[1] - box.Middle[1], position[2] - box.Middle[2]);
    AddClippingRange(scene.Limits, position, box.Middle, distance, distance + 0.5 * box.Radius);
    scene.Limits.NumberOfCameraPlanes = 2;
    // From the viewer's side, where blockers are that the near plane cuts away.
    scene.Lights = { MakeLight(true, GetPlace(scene, 1.2, 1.5, 1.4)) };
    ExpectShadows(scene);
  }
}

TEST(IsosurfaceShadows, InvisibleSurfacesBlockNothing)
{
  for (RayScene& scene : MakeScenes())
  {
    scene.Isosurfaces[1].Opacity = 0;
    scene.Lights = { MakeLight(true, GetPlace(scene, 1.2, 1.5, 0.4)) };
    ExpectShadows(scene);
  }
}

/// Scenes with lights of all kinds, seen in perspective and in parallel, and cut in several ways.
std::vector<RayScene> MakeLitScenes()
{
  std::vector<RayScene> result;
  for (const RayScene& uncut : MakeScenes())
  {
    const MeshBox box(uncut.Mesh);
    RayScene clipped = uncut;
    clipped.Limits.Planes = { { -0.5, -0.7, 0.2,
      0.5 * box.Middle[0] + 0.7 * box.Middle[1] - 0.2 * box.Middle[2] + 0.1 * box.Radius } };
    RayScene cropped = uncut;
    cropped.Limits.Cropping = true;
    cropped.Limits.CroppingFlags = 0x5a5a5a5;
    for (int i = 0; i < 6; ++i)
    {
      cropped.Limits.CroppingPlanes[i] = box.Middle[i / 2] + (i % 2 == 0 ? -0.1 : 0.2) * box.Radius;
    }
    for (RayScene scene : { uncut, clipped, cropped })
    {
      scene.Lights = MakeIsosurfaceLights(scene.Mesh); // a distant one, a positional one, a spot
      scene.Lights.push_back(MakeLight(true, GetPlace(scene, 1.2, 1.5, 0.4)));
      scene.Lights.push_back(MakeLight(true, GetPlace(scene, 0.3, -0.2, 0.1))); // inside
      scene.Lights.push_back(MakeLight(false, { -0.36, 0.48, 0.8 }));
      for (const bool parallel : { false, true })
      {
        scene.Grid = MakeOuterGrid(scene.Mesh, parallel, 67, 51);
        result.push_back(scene);
      }
    }
  }
  return result;
}

TEST(IsosurfaceShadows, GiveTheSameBitsForPolygonsPlacedOnce)
{
  for (const RayScene& scene : MakeLitScenes())
  {
    for (const bool sampled : { false, true })
    {
      IsosurfaceOptions options;
      options.Shadows = true;
      options.ShadowSoftness = sampled ? 0.1 : 0;
      options.AmbientOcclusion = sampled;
      options.PlaceOnce = false;
      options.NumberOfThreads = 1;
      const TracedPicture expected = TracePicture(scene, options);
      EXPECT_GT(expected.Statistics.Shadow.Packets, 0);
      options.PlaceOnce = true;
      options.NumberOfThreads = 3;
      const TracedPicture placed = TracePicture(scene, options);
      EXPECT_TRUE(IsSame(placed, expected));
      EXPECT_EQ(placed.Statistics.Shadow.Packets, expected.Statistics.Shadow.Packets);
      // Boxes that fit what the light sees let packets go through fewer nodes.
      EXPECT_LT(placed.Statistics.Shadow.NodeTests, expected.Statistics.Shadow.NodeTests);
    }
  }
}

TEST(IsosurfaceShadows, LightAtTheViewerCastsNone)
{
  RayScene scene = MakeScene("random", { { "cells", 8 } });
  std::array<double, 3> viewer;
  std::copy_n(scene.Grid.Origin, 3, viewer.data());
  scene.Lights = { MakeLight(true, viewer) };
  scene.Isosurfaces[1].Opacity = 1;
  IsosurfaceOptions options;
  const TracedPicture expected = TracePicture(scene, options);
  options.Shadows = true;
  EXPECT_TRUE(IsSame(TracePicture(scene, options), expected));
}

} // namespace
} // namespace tetralux
