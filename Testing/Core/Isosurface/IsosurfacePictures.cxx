// SPDX-License-Identifier: BSD-3-Clause
#include "IsosurfacePictures.h"

#include "Generate/GeneratedMeshes.h"
#include "IsosurfaceOracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace tetralux
{

TracedPicture TracePicture(
  IsosurfaceTracer& tracer, VolumeScene& volume, const RayScene& scene, IsosurfaceOptions options)
{
  const std::size_t pixels = static_cast<std::size_t>(scene.Grid.Width) * scene.Grid.Height;
  TracedPicture picture;
  // Whatever is not written is noticed.
  picture.Colors.assign(4 * pixels, std::numeric_limits<float>::quiet_NaN());
  picture.Depths.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  options.Shaded = scene.Shaded;
  options.SmoothShading = scene.SmoothShading;
  options.Lights = scene.Lights;
  picture.Statistics =
    tracer.Trace(volume, scene.Grid, scene.GetLimits(), options, picture.Colors, picture.Depths);
  return picture;
}

TracedPicture TracePicture(const RayScene& scene, const IsosurfaceOptions& options)
{
  VolumeScene volume = scene.MakeVolumeScene();
  IsosurfaceTracer tracer;
  return TracePicture(tracer, volume, scene, options);
}

bool IsSame(const TracedPicture& a, const TracedPicture& b)
{
  return a.Colors.size() == b.Colors.size() &&
    std::memcmp(a.Colors.data(), b.Colors.data(), a.Colors.size() * sizeof(float)) == 0 &&
    std::memcmp(a.Depths.data(), b.Depths.data(), a.Depths.size() * sizeof(float)) == 0;
}

PictureDifference ExpectOracle(const RayScene& scene, const TracedPicture& picture, bool shadows,
  const PictureTolerance& tolerance)
{
  const IsosurfaceOracle oracle(scene, shadows);
  const double depthTolerance = tolerance.Depth * oracle.GetDiameter();
  PictureDifference result;
  std::string first;
  const int pixels = scene.Grid.Width * scene.Grid.Height;
#pragma omp parallel for schedule(dynamic, 16)
  for (int p = 0; p < pixels; ++p)
  {
    const int x = p % scene.Grid.Width;
    const int y = p / scene.Grid.Width;
    const float* color = &picture.Colors[4 * static_cast<std::size_t>(p)];
    const auto findDifference = [&](const OraclePixel& pixel, double& depth, double& channel)
    {
      depth = std::abs(picture.Depths[p] - pixel.Depth);
      channel = 0;
      for (int c = 0; c < 4; ++c)
      {
        // What is not a number stays.
        const double difference = std::abs(color[c] - pixel.Rgba[c]);
        channel = std::isnan(channel) || difference <= channel ? channel : difference;
      }
      return depth <= depthTolerance && channel <= tolerance.Channel;
    };
    const OraclePixel pixel = oracle.Render(x, y);
    double depth, channel;
    const bool right = findDifference(pixel, depth, channel);
    bool silhouette = false;
    bool alone = false;
    std::vector<OraclePixel> around;
    if (!right)
    {
      silhouette = oracle.IsAtSilhouette(
        x, y, pixel, depthTolerance, tolerance.Channel, tolerance.Displacement, around);
      double d, c;
      alone = silhouette &&
        std::none_of(around.begin(), around.end(),
          [&](const OraclePixel& other) { return findDifference(other, d, c); });
    }
#pragma omp critical
    {
      result.Hits += pixel.Hits;
      result.Silhouettes += silhouette ? 1 : 0;
      result.SeenAlone += alone ? 1 : 0;
      if (!silhouette)
      {
        result.Depth = std::max(result.Depth, depth / oracle.GetDiameter());
        result.Channel = std::max(result.Channel, channel);
      }
      if (!right && !silhouette)
      {
        ++result.Wrong;
        if (first.empty())
        {
          first = "pixel " + std::to_string(x) + ", " + std::to_string(y) + ": depth " +
            std::to_string(picture.Depths[p]) + " for " + std::to_string(pixel.Depth) + ", hits " +
            std::to_string(pixel.Hits) + ", rgba";
          for (int c = 0; c < 4; ++c)
          {
            first += " " + std::to_string(color[c]) + " for " + std::to_string(pixel.Rgba[c]);
          }
        }
      }
    }
  }
  EXPECT_EQ(result.Wrong, 0) << first;
  EXPECT_LE(result.Silhouettes, tolerance.Silhouettes * pixels);
  return result;
}

std::vector<Isosurface> MakeSurfaces(const std::vector<double>& scalars, int count, float opacity)
{
  std::vector<double> sorted;
  std::copy_if(scalars.begin(), scalars.end(), std::back_inserter(sorted),
    [](double s) { return std::isfinite(s); });
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::vector<Isosurface> surfaces;
  for (int k = 0; k < count; ++k)
  {
    // Between two scalars that follow each other.
    const std::size_t i = (sorted.size() - 1) * (k + 1) / (count + 1);
    const double value = 0.5 * sorted[i] + 0.5 * sorted[std::min(i + 1, sorted.size() - 1)];
    const float hue = static_cast<float>(k + 1) / static_cast<float>(count);
    surfaces.push_back({ value, { hue, 1 - 0.7f * hue, 0.2f + 0.5f * hue * hue }, opacity });
  }
  return surfaces;
}

RayScene MakeIsosurfaceScene(
  const std::string& mesh, const std::map<std::string, double>& parameters, int surfaces)
{
  GeneratedMesh generated = GenerateMesh(mesh, parameters);
  RayScene scene;
  scene.Mesh = std::move(generated.Mesh);
  scene.Scalars = std::move(generated.Scalars);
  scene.Model = OpticalModel::Isosurfaces;
  scene.Function = MakeConstantFunction(0, { 0, 0, 0 });
  scene.Isosurfaces = MakeSurfaces(scene.Scalars, surfaces, 0.6f);
  return scene;
}

MeshBox::MeshBox(const TetrahedralMesh& mesh)
{
  double lower[3], upper[3];
  std::fill_n(lower, 3, std::numeric_limits<double>::infinity());
  std::fill_n(upper, 3, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    lower[i % 3] = std::min(lower[i % 3], mesh.Points[i]);
    upper[i % 3] = std::max(upper[i % 3], mesh.Points[i]);
  }
  for (int a = 0; a < 3; ++a)
  {
    this->Middle[a] = 0.5 * lower[a] + 0.5 * upper[a];
  }
  this->Radius = 0.5 * std::hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]);
}

RayGrid MakeOuterGrid(const TetrahedralMesh& mesh, bool parallel, int width, int height)
{
  const MeshBox box(mesh);
  const std::array<double, 3> position = { box.Middle[0] + 1.7 * box.Radius,
    box.Middle[1] + 1.1 * box.Radius, box.Middle[2] + 2.1 * box.Radius };
  const std::array<double, 3> up = { 0.1, 1, 0.2 };
  return parallel ? MakeParallelGrid(position, box.Middle, up, 0.9 * box.Radius, width, height)
                  : MakePerspectiveGrid(position, box.Middle, up, 35, width, height);
}

RayGrid MakeInnerGrid(const TetrahedralMesh& mesh, int width, int height)
{
  const MeshBox box(mesh);
  const double r = box.Radius;
  const std::array<double, 3> position = { box.Middle[0] + 0.11 * r, box.Middle[1] - 0.07 * r,
    box.Middle[2] + 0.05 * r };
  return MakePerspectiveGrid(position,
    { position[0] + 0.7 * r, position[1] + 0.4 * r, position[2] - 0.3 * r }, { 0.1, 0.2, 1 }, 100,
    width, height);
}

std::vector<Light> MakeIsosurfaceLights(const TetrahedralMesh& mesh)
{
  const MeshBox box(mesh);
  const auto makeLight = [](bool positional, const std::array<double, 3>& place)
  {
    Light light;
    light.Positional = positional;
    std::copy_n(place.data(), 3, light.Position);
    for (int c = 0; c < 3; ++c)
    {
      light.Ambient[c] = 0.5f;
      light.Diffuse[c] = 0.5f + 0.2f * static_cast<float>(c);
      light.Specular[c] = 0.9f - 0.2f * static_cast<float>(c);
    }
    return light;
  };
  const auto place = [&](double x, double y, double z) -> std::array<double, 3>
  {
    return { box.Middle[0] + x * box.Radius, box.Middle[1] + y * box.Radius,
      box.Middle[2] + z * box.Radius };
  };
  const Light distant = makeLight(false, { 0.6, 0.8, 0 });
  Light fading = makeLight(true, place(-2, 1, 1.5));
  fading.Attenuation[0] = 0.2;
  fading.Attenuation[1] = 0.1 / box.Radius;
  fading.Attenuation[2] = 0.05 / box.Radius / box.Radius;
  Light spot = makeLight(true, place(1, 1, 2));
  const double length = std::sqrt(6.);
  const double axis[3] = { -1 / length, -1 / length, -2 / length };
  std::copy_n(axis, 3, spot.Axis);
  spot.ConeCosine = 0.97;
  spot.Exponent = 3;
  return { distant, fading, spot };
}

} // namespace tetralux
