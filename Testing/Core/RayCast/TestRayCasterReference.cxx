// SPDX-License-Identifier: BSD-3-Clause

// The ray caster against the reference renderer.

#include "BoxScene.h"
#include "ComparedScenes.h"
#include "RayScene.h"
#include "ReferenceGrazing.h"

#include "Generate/GeneratedMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;
using namespace tetralux::box_scene;

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// What the ray caster promises: the largest error of a channel, where no silhouette is grazed.
constexpr double ErrorGoal = 1e-4;

/// Largest error of a depth, relative to the largest depth: coordinates are rounded to 2^-24 of the
/// mesh's radius, and a face met at a slant moves along the ray by more.
constexpr double DepthError = 1e-5;

/// Pixels whose depth may be off by more: the first contribution of their ray is in a cell that
/// another one hides only just not.
constexpr double DepthOutlierShare = 0.005;

double GetError(const RayPicture& picture, const ReferenceImage& reference, std::size_t pixel)
{
  double error = 0;
  for (std::size_t i = 4 * pixel; i < 4 * pixel + 4; ++i)
  {
    const double difference = std::abs(picture.Colors[i] - reference.Rgba[i]);
    error = std::isnan(difference) ? Infinity : std::max(error, difference);
  }
  return error;
}

/// The largest of the depths.
double GetDepthScale(const ReferenceImage& reference)
{
  double largest = 0;
  for (const double depth : reference.Depth)
  {
    largest = std::max(largest, depth == -1 ? 0 : std::abs(depth)); // -1: nothing there
  }
  return largest;
}

/// Renders the scene in every precision and with every kernel; fails where a pixel that is not
/// grazed is off by more than is promised.
void CompareWithReference(
  const std::string& name, const RayScene& scene, double largestGrazedShare = GrazedShare)
{
  const ReferenceImage reference = scene.RenderReference();
  const std::size_t pixels = reference.Depth.size();
  std::size_t covered = 0;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    covered += reference.Rgba[4 * p + 3] > 0;
  }
  ASSERT_GT(covered, pixels / 20) << "a scene without a picture";
  const double depthScale = GetDepthScale(reference);

  struct Version
  {
    Precision Arithmetic;
    bool Portable;
  };
  const Version versions[] = { { Precision::Automatic, false }, { Precision::Single, false },
    { Precision::Double, false }, { Precision::Single, true }, { Precision::Double, true } };
  VolumeScene volume = scene.MakeVolumeScene();
  std::vector<RayPicture> pictures;
  std::vector<std::uint8_t> isOff(pixels, 0);
  for (const Version& version : versions)
  {
    RayCastOptions options;
    options.Arithmetic = version.Arithmetic;
    options.Kernels = ChooseKernels(version.Portable);
    pictures.push_back(Cast(volume, scene, options));
    for (std::size_t p = 0; p < pixels; ++p)
    {
      isOff[p] |= GetError(pictures.back(), reference, p) > ErrorGoal;
    }
  }

  // The kernels for any processor compute the same, but for rounding. Rays must not end early here:
  // one may end a cell before the other.
  std::array<std::vector<double>, 2> kernelDifferences;
  double geometryError = 0;
  for (std::vector<double>& differences : kernelDifferences)
  {
    RayCastOptions options;
    options.Arithmetic =
      &differences == &kernelDifferences[0] ? Precision::Single : Precision::Double;
    options.MaximumError = 1e-9;
    const RayPicture fast = Cast(volume, scene, options);
    options.Kernels = InstructionSet::Generic;
    const RayPicture portable = Cast(volume, scene, options);
    geometryError = std::max(geometryError, fast.Statistics.GeometryError);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      double difference = 0;
      for (std::size_t i = 4 * p; i < 4 * p + 4; ++i)
      {
        difference =
          std::max(difference, static_cast<double>(std::abs(fast.Colors[i] - portable.Colors[i])));
      }
      differences.push_back(difference);
      isOff[p] |= difference > KernelDifference;
    }
  }
  const std::vector<double> grazing = scene.MeasureGrazing(reference, isOff);

  for (std::size_t v = 0; v < pictures.size(); ++v)
  {
    const RayPicture& picture = pictures[v];
    const RayCastStatistics& statistics = picture.Statistics;
    std::ostringstream version;
    version << name << ", " << GetName(versions[v].Arithmetic) << " precision"
            << (versions[v].Arithmetic == Precision::Automatic
                   ? statistics.DoublePrecision ? " (double)" : " (single)"
                   : "")
            << ", " << statistics.InstructionSet;
    SCOPED_TRACE(version.str());

    // Single precision that was forced is as good as it says.
    const double allowed = versions[v].Arithmetic == Precision::Single
      ? std::max(ErrorGoal, statistics.ErrorEstimate)
      : ErrorGoal;
    EXPECT_FALSE(std::isnan(statistics.ErrorEstimate));
    double largest = 0;
    std::size_t worst = 0;
    std::size_t grazed = 0;
    double depthError = 0;
    std::size_t depthOutliers = 0;
    for (std::size_t p = 0; p < pixels; ++p)
    {
      const double error = GetError(picture, reference, p);
      if (isOff[p] && grazing[p] > GrazingThreshold)
      {
        ++grazed;
        continue;
      }
      if (error > largest)
      {
        largest = error;
        worst = p;
      }
      const bool both = picture.Depths[p] != -1 && reference.Depth[p] != -1;
      const double difference = std::abs(picture.Depths[p] - reference.Depth[p]);
      if ((picture.Depths[p] != -1) != (reference.Depth[p] != -1) ||
        !(difference <= DepthError * depthScale))
      {
        depthOutliers += picture.Depths[p] != -1 || reference.Depth[p] != -1;
      }
      else if (both)
      {
        depthError = std::max(depthError, difference / depthScale);
      }
    }
    std::cout << version.str() << ": error " << largest << ", estimate " << statistics.ErrorEstimate
              << "; depth " << depthError << ", " << depthOutliers << " outliers; " << grazed
              << " of " << covered << " pixels grazed\n";
    EXPECT_LE(largest, allowed) << "pixel " << worst % scene.Grid.Width << ", "
                                << worst / scene.Grid.Width;
    EXPECT_LE(static_cast<double>(grazed), largestGrazedShare * static_cast<double>(covered));
    EXPECT_LE(static_cast<double>(depthOutliers), DepthOutlierShare * static_cast<double>(covered));
  }

  for (std::size_t p = 0; p < pixels; ++p)
  {
    if (!(isOff[p] && grazing[p] > GrazingThreshold))
    {
      ASSERT_LE(kernelDifferences[0][p], std::max(KernelDifference, geometryError))
        << name << ", pixel " << p << ", single precision, portable kernels";
      ASSERT_LE(kernelDifferences[1][p], KernelDifference)
        << name << ", pixel " << p << ", double precision, portable kernels";
    }
  }
}

class RayCasterScenes : public testing::TestWithParam<NamedScene>
{
};

TEST_P(RayCasterScenes, AgreesWithReference)
{
  CompareWithReference(GetParam().Name, GetParam().Make(), GetParam().LargestGrazedShare);
}

INSTANTIATE_TEST_SUITE_P(RayCaster, RayCasterScenes, testing::ValuesIn(ListComparedScenes()),
  [](const testing::TestParamInfo<NamedScene>& info) { return info.param.Name; });

TEST(RayCaster, AgreesWithReferenceForEveryKindOfCropping)
{
  std::mt19937_64 generator(27);
  std::uniform_real_distribution<double> unit(0, 1);
  RayScene scene = MakeBoxScene(5);
  scene.Limits.Cropping = true;
  // VTK's names: subvolume, fence, inverted fence, cross, inverted cross; then any others.
  std::vector<std::uint32_t> allFlags = { 0x2000, 0x2ebfeba, 0x5140145, 0x417410, 0x7be8bef };
  for (int i = 0; i < 15; ++i)
  {
    allFlags.push_back(static_cast<std::uint32_t>(generator() & 0x7ffffff));
  }
  for (std::size_t i = 0; i < allFlags.size(); ++i)
  {
    scene.Limits.CroppingFlags = allFlags[i];
    for (int a = 0; a < 3; ++a)
    {
      scene.Limits.CroppingPlanes[2 * a] = 0.1 + 0.4 * unit(generator);
      scene.Limits.CroppingPlanes[2 * a + 1] = 0.55 + 0.4 * unit(generator);
    }
    // Also where rays are parallel to cropping planes.
    const double turn = unit(generator);
    scene.Grid = i % 3 == 0
      ? MakeParallelGrid({ 0.511, 0.523, 4 }, { 0.511, 0.523, 0 }, { 0, 1, 0 }, 0.7, 20, 20)
      : LookAtUnitCube(
          { 0.5 + 3 * std::cos(6 * turn), 1.7 * turn, 0.5 + 3 * std::sin(6 * turn) }, 20);
    std::ostringstream name;
    name << "Cropping " << std::hex << allFlags[i];
    CompareWithReference(name.str(), scene);
  }
}

TEST(RayCaster, AgreesWithReferenceForEveryGeneratedMesh)
{
  const std::map<std::string, std::map<std::string, double>> parameters = {
    { "ring", { { "around", 24 }, { "across", 4 } } },
    { "ball", { { "cells", 14 } } },
    { "swinging-ball", { { "cells", 9 }, { "time", 0.3 } } },
    { "cylinder-with-hole", { { "across", 3 }, { "around", 24 }, { "along", 10 } } },
    { "boundary-layer", { { "cells", 6 }, { "layers", 20 } } },
    { "gear", { { "teeth", 8 }, { "across", 3 }, { "along", 3 } } },
    { "helical-gear", { { "teeth", 8 }, { "across", 3 }, { "along", 8 } } },
    { "heat-sink", { { "fins", 4 }, { "cells", 2 } } },
    { "schoenhardt", { { "cells", 2 } } },
    { "cubes", { { "count", 2 }, { "cells", 3 } } },
    { "cavity", { { "cells", 9 } } },
    { "shared-edge", { { "cells", 5 } } },
    { "checkerboard", { { "blocks", 4 }, { "cells", 2 } } },
    { "cycle", { { "cells", 3 } } },
    { "random", { { "cells", 9 } } },
  };
  for (const Generator& generator : GetGenerators())
  {
    ASSERT_EQ(parameters.count(generator.Name), 1u)
      << "a new mesh needs parameters of a small one here: " << generator.Name;
    GeneratedMesh generated = GenerateMesh(generator.Name, parameters.at(generator.Name));
    RayScene scene;
    scene.Mesh = std::move(generated.Mesh);
    scene.Scalars = std::move(generated.Scalars);
    Vector lo = { Infinity, Infinity, Infinity };
    Vector hi = { -Infinity, -Infinity, -Infinity };
    for (std::size_t i = 0; i < scene.Mesh.Points.size(); ++i)
    {
      lo[i % 3] = std::min(lo[i % 3], scene.Mesh.Points[i]);
      hi[i % 3] = std::max(hi[i % 3], scene.Mesh.Points[i]);
    }
    Vector middle;
    double diagonal = 0;
    for (int a = 0; a < 3; ++a)
    {
      middle[a] = 0.5 * (lo[a] + hi[a]);
      diagonal = std::hypot(diagonal, hi[a] - lo[a]);
    }
    scene.Function = MakeColorfulFunction(15 / diagonal);
    const auto [low, high] = std::minmax_element(scene.Scalars.begin(), scene.Scalars.end());
    for (TransferFunction::Node& node : scene.Function.Nodes)
    {
      node.Scalar = *low + node.Scalar * (*high - *low);
    }
    scene.Grid = MakePerspectiveGrid(
      { middle[0] + 1.2 * diagonal, middle[1] + 0.9 * diagonal, middle[2] + 1.1 * diagonal },
      middle, { 0, 0.1, 1 }, 30, ImageSize, ImageSize);
    CompareWithReference(generator.Name, scene);
  }
}

TEST(RayCaster, ManyCrossings)
{
  // Every other hexahedron of a long box: more crossings of a ray than there is room for at first.
  constexpr int Length = 90;
  RayScene scene;
  scene.Mesh = MakeBox(Length, 3, 3, { 0, 0, 0 }, { 9, 1, 1 });
  std::vector<std::int32_t> kept;
  for (int hexahedron = 0; hexahedron < Length * 9; ++hexahedron)
  {
    const int i = hexahedron % Length;
    const int j = hexahedron / Length % 3;
    const int k = hexahedron / Length / 3;
    if ((i + j + k) % 2 == 0)
    {
      const auto first = scene.Mesh.Cells.begin() + 20 * hexahedron;
      kept.insert(kept.end(), first, first + 20);
    }
  }
  scene.Mesh.Cells = std::move(kept);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(3);
  scene.Grid = MakePerspectiveGrid({ -4, 0.52, 0.47 }, { 9, 0.5, 0.5 }, { 0, 1, 0 }, 14, 24, 24);
  CompareWithReference("ManyCrossings", scene);

  // A path begins at one crossing and ends at another.
  scene.Grid = MakeTile(scene.Grid, 12, 12, 1, 1);
  scene.Function = MakeConstantFunction(1e-3, { 1, 1, 1 });
  VolumeScene volume = scene.MakeVolumeScene();
  EXPECT_GT(Cast(volume, scene).Statistics.Paths, 32);
}

} // namespace
