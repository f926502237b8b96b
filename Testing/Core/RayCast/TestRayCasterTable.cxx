// SPDX-License-Identifier: BSD-3-Clause

// Rays integrated by lookups in a pre-integration table.

#include "RayScene.h"

#include "PreIntegration/PreIntegrationBuilder.h"
#include "PreIntegration/PreIntegrationError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;

/// Lookups of the ray caster and of PreIntegrationTable::Lookup interpolate alike, but the ray
/// volume's products are rounded once with sums, and scalars and lengths are those of a ray.
constexpr double LookupDifference = 2e-6;

constexpr int ImageSize = 48;

RayScene MakeScene()
{
  RayScene scene;
  scene.Mesh = MakeBox(9, 9, 9, { 0, 0, 0 }, { 1, 1, 1 }, 0.15);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(20);
  scene.Grid = MakePerspectiveGrid(
    { 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, ImageSize, ImageSize);
  return scene;
}

std::shared_ptr<PreIntegrationTable> MakeTable(
  const RayScene& scene, const PreIntegrationSettings& settings)
{
  auto table = std::make_shared<PreIntegrationTable>();
  BuildPreIntegrationTable(scene.Function, settings, *table);
  return table;
}

double GetLargestDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max<double>(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

PreIntegrationSettings MakeSettings(LengthScale scale, ScalarAxis axis, TexelFormat format)
{
  PreIntegrationSettings settings;
  settings.ScalarSize = 96;
  settings.LengthSize = 48;
  settings.StepsPerDoubling = 8;
  settings.Scale = scale;
  settings.Axis = axis;
  settings.Format = format;
  settings.LongestSegment = 0.5;
  return settings;
}

TEST(RayCasterTable, IsTheClosedFormButForTheErrorOfTheTable)
{
  const RayScene scene = MakeScene();
  VolumeScene volume = scene.MakeVolumeScene();
  const RayPicture exact = Cast(volume, scene);
  for (const LengthScale scale : { LengthScale::Linear, LengthScale::Logarithmic })
  {
    for (const ScalarAxis axis : { ScalarAxis::Uniform, ScalarAxis::Nodes })
    {
      for (const TexelFormat format :
        { TexelFormat::UNorm8, TexelFormat::UNorm16, TexelFormat::Half, TexelFormat::Float })
      {
        const auto table = MakeTable(scene, MakeSettings(scale, axis, format));
        const PreIntegrationError error = EstimatePreIntegrationError(scene.Function, *table);
        // A ray of this scene crosses at most 40 cells.
        const double bound = GetPictureError(error, std::sqrt(3.), 40);
        volume.Optics.SetTable(table, bound);
        for (const bool portable : { false, true })
        {
          for (const Precision precision : { Precision::Single, Precision::Double })
          {
            RayCastOptions options;
            options.Arithmetic = precision;
            options.Kernels = ChooseKernels(portable);
            const RayPicture picture = Cast(volume, scene, options);
            EXPECT_EQ(picture.Statistics.Integration, Integrator::Table);
            EXPECT_EQ(picture.Statistics.TableError, bound);
            const double difference = GetLargestDifference(exact.Colors, picture.Colors);
            EXPECT_LE(difference, bound);
            EXPECT_GT(difference, 0) << "no table was looked at";
          }
        }
      }
    }
  }
}

/// One tetrahedron, rays along its height: each is one segment, which Lookup knows.
TEST(RayCasterTable, LooksUpAsTheTableDoes)
{
  RayScene scene;
  scene.Mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  scene.Mesh.Cells = { 0, 1, 2, 3 };
  scene.Scalars = { 0.05, 0.4, 0.62, 0.97 };
  scene.Function = MakeColorfulFunction(20);
  scene.Function.Nodes[4].Right.Attenuation = 2; // a step
  scene.Grid = MakeParallelGrid({ 0.3, 0.3, 5 }, { 0.3, 0.3, 0 }, { 0, 1, 0 }, 0.3, 24, 24);
  VolumeScene volume = scene.MakeVolumeScene();
  for (const LengthScale scale : { LengthScale::Linear, LengthScale::Logarithmic })
  {
    for (const ScalarAxis axis : { ScalarAxis::Uniform, ScalarAxis::Nodes })
    {
      const auto table = MakeTable(scene, MakeSettings(scale, axis, TexelFormat::Float));
      volume.Optics.SetTable(table, 1);
      RayCastOptions options;
      options.Arithmetic = Precision::Double;
      const RayPicture picture = Cast(volume, scene, options);
      int covered = 0;
      for (int y = 0; y < 24; ++y)
      {
        for (int x = 0; x < 24; ++x)
        {
          const double px = 0.3 + 0.6 * ((x + 0.5) / 24 - 0.5);
          const double py = 0.3 + 0.6 * ((y + 0.5) / 24 - 0.5);
          const double height = 1 - px - py;
          if (height <= 0.01)
          {
            continue;
          }
          ++covered;
          const auto at = [&](double z)
          {
            return (1 - px - py - z) * scene.Scalars[0] + px * scene.Scalars[1] +
              py * scene.Scalars[2] + z * scene.Scalars[3];
          };
          float rgba[4];
          table->Lookup(at(height), at(0), height, rgba);
          for (int c = 0; c < 4; ++c)
          {
            EXPECT_NEAR(picture.Colors[4 * (24 * y + x) + c], rgba[c], LookupDifference)
              << "pixel " << x << ", " << y;
          }
        }
      }
      EXPECT_GT(covered, 200);
    }
  }
}

TEST(RayCasterTable, AnotherTransferFunctionNeedsAnotherTable)
{
  RayScene scene = MakeScene();
  VolumeScene volume = scene.MakeVolumeScene();
  volume.Optics.SetTable(
    MakeTable(scene, MakeSettings(LengthScale::Linear, ScalarAxis::Nodes, TexelFormat::Float)), 1);
  EXPECT_EQ(Cast(volume, scene).Statistics.Integration, Integrator::Table);
  volume.Optics.SetTransferFunction(MakeColorfulFunction(5));
  EXPECT_EQ(Cast(volume, scene).Statistics.Integration, Integrator::ClosedForm);
}

} // namespace
