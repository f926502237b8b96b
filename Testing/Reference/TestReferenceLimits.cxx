// SPDX-License-Identifier: BSD-3-Clause
// What limits keep of the oracle's rays.
#include "ReferenceIntegral.h"
#include "ReferencePictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace
{

using namespace tetralux;
using namespace tetralux::reference_pictures;

TEST(Reference, CameraInsideSeesWhatItsClippingRangeKeeps)
{
  const Scene scene = MakeConstantScene(MakeBox(5, 5, 5, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3));
  const Vector position{ 0.4, 0.6, 0.5 };
  const Vector focalPoint{ 0.4, 0.6, -1 };
  const RayGrid grid = MakePerspectiveGrid(position, focalPoint, { 0, 1, 0 }, 60, 21, 21);
  RayLimits limits;
  AddClippingRange(limits, position, focalPoint, 0.1, 0.3);
  const ReferenceImage image = scene.Render(Grey, grid, limits);
  const ReferenceImage unlimited = scene.Render(Grey, grid);
  for (int pixel = 0; pixel < 21 * 21; ++pixel)
  {
    const WorldRay ray = GetRay(grid, pixel % 21, pixel / 21);
    const double slant = 1 / static_cast<double>(-ray.Direction[2]);
    EXPECT_NEAR(image.Length[pixel], 0.2 * slant, 1e-14);
    EXPECT_NEAR(image.Depth[pixel], 0.1 * slant, 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], 1 - std::exp(-1.5 * 0.2 * slant), 1e-14);
    const Chord chord = ClipByBox(ray, { 0, 0, 0 }, { 1, 1, 1 });
    EXPECT_NEAR(unlimited.Length[pixel], chord.Length(), 1e-14);
    EXPECT_LT(unlimited.Depth[pixel], 0);
  }
}

TEST(Reference, CroppingKeepsTheFlaggedRegions)
{
  const Scene scene = MakeConstantScene(MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3));
  const RayGrid grid =
    MakePerspectiveGrid({ 1.5, 1.9, 2.3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 35, 19, 17);
  RayLimits limits;
  limits.Cropping = true;
  const double planes[6] = { 0.3, 0.6, 0.25, 0.7, 0.4, 0.85 };
  std::copy(planes, planes + 6, limits.CroppingPlanes);
  const double borders[3][4] = { { 0, 0.3, 0.6, 1 }, { 0, 0.25, 0.7, 1 }, { 0, 0.4, 0.85, 1 } };
  std::vector<std::uint32_t> flags{ 0x2000, 0x7ffffff, 0, 0x4e4 };
  for (int bit = 0; bit < 27; ++bit)
  {
    flags.push_back(1u << bit);
  }
  std::mt19937_64 generator(8);
  for (int i = 0; i < 8; ++i)
  {
    flags.push_back(static_cast<std::uint32_t>(generator()) & 0x7ffffff);
  }
  for (const std::uint32_t flag : flags)
  {
    limits.CroppingFlags = flag;
    const ReferenceImage image = scene.Render(Grey, grid, limits);
    for (int pixel = 0; pixel < 19 * 17; ++pixel)
    {
      const WorldRay ray = GetRay(grid, pixel % 19, pixel / 19);
      double length = 0;
      for (int region = 0; region < 27; ++region)
      {
        const int i[3] = { region % 3, region / 3 % 3, region / 9 };
        if (flag >> region & 1)
        {
          length += ClipByBox(ray, { borders[0][i[0]], borders[1][i[1]], borders[2][i[2]] },
            { borders[0][i[0] + 1], borders[1][i[1] + 1], borders[2][i[2] + 1] })
                      .Length();
        }
      }
      EXPECT_NEAR(image.Length[pixel], length, 1e-14) << "flags " << flag << " pixel " << pixel;
      EXPECT_NEAR(image.Rgba[4 * pixel + 3], 1 - std::exp(-1.5 * length), 1e-13);
    }
  }
}

TEST(Reference, MaximumDistancesEndTheRays)
{
  const Vector gradient{ 0, 0, 1 };
  const Scene scene =
    MakeLinearScene(MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3), gradient, 0);
  const TransferFunction ramp = MakeLinearFunction({ { 0, 1, 0, 0, 0.5 }, { 1, 0, 1, 0, 3.0 } });
  const RayGrid grid = MakeParallelGrid({ 0.5, 0.5, 2 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.1, 5, 1);
  const float distances[5] = { 0.5f, 1.0f, 1.25f, 2.0f, std::numeric_limits<float>::infinity() };
  RayLimits limits;
  limits.MaximumDistances = distances;
  const ReferenceImage image = scene.Render(ramp, grid, limits);
  const double lengths[5] = { 0, 0, 0.25, 1, 1 };
  for (int pixel = 0; pixel < 5; ++pixel)
  {
    EXPECT_NEAR(image.Length[pixel], lengths[pixel], 1e-15);
    const ReferenceSegment expected =
      IntegrateReference(ramp, 1, 1 - lengths[pixel], lengths[pixel]);
    EXPECT_NEAR(image.Rgba[4 * pixel + 1], expected.Color[1], 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], expected.Alpha, 1e-14);
  }
}

} // namespace
