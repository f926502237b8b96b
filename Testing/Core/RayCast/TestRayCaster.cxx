// SPDX-License-Identifier: BSD-3-Clause

// The ray caster against the reference renderer, and against what is known without any renderer.

#include "RayScene.h"

#include "Generate/GeneratedMeshes.h"
#include "MeshParts.h"
#include "ReferenceGrazing.h"
#include "View/RayDisplacements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;
using Vector = std::array<double, 3>;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// What the ray caster promises: the largest error of a channel, where no silhouette is grazed.
constexpr double ErrorGoal = 1e-4;

/// Portable kernels round twice where the others round once; half of the error goal would already
/// mean that they compute something else.
constexpr double KernelDifference = 1e-5;

/// Pixels that a silhouette grazes are no more than this share of those covered, unless a scene
/// puts them there.
constexpr double GrazedShare = 0.01;

/// Largest error of a depth, relative to the largest depth: coordinates are rounded to 2^-24 of the
/// mesh's radius, and a face met at a slant moves along the ray by more.
constexpr double DepthError = 1e-5;

/// Pixels whose depth may be off by more: the first contribution of their ray is in a cell that
/// another one hides only just not.
constexpr double DepthOutlierShare = 0.005;

constexpr int ImageSize = 64;

RayGrid LookAtUnitCube(const Vector& from, int size = ImageSize)
{
  return MakePerspectiveGrid(from, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, size, size);
}

const Vector Oblique = { 3.1, 2.2, 2.7 };

TetrahedralMesh MakeUnitBox(int n, double jitter = 0.15)
{
  return MakeBox(n, n, n, { 0, 0, 0 }, { 1, 1, 1 }, jitter);
}

RayScene MakeBoxScene(int n = 11, double jitter = 0.15)
{
  RayScene scene;
  scene.Mesh = MakeUnitBox(n, jitter);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(20);
  scene.Grid = LookAtUnitCube(Oblique);
  return scene;
}

/// One of the scenes that are compared with the reference.
struct NamedScene
{
  std::string Name;
  RayScene (*Make)();
  double LargestGrazedShare = GrazedShare;
};

std::ostream& operator<<(std::ostream& stream, const NamedScene& scene)
{
  return stream << scene.Name;
}

//------------------------------------------------------------------------------------------------
// Scenes

RayScene Perspective() { return MakeBoxScene(); }

RayScene Parallel()
{
  RayScene scene = MakeBoxScene();
  scene.Grid = MakeParallelGrid(Oblique, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 0.8, ImageSize, ImageSize);
  return scene;
}

RayScene Inside()
{
  RayScene scene = MakeBoxScene();
  const Vector eye = { 0.4, 0.45, 0.3 };
  const Vector focalPoint = { 0.6, 0.5, 0.9 };
  scene.Grid = MakePerspectiveGrid(eye, focalPoint, { 0, 1, 0 }, 80, ImageSize, ImageSize);
  AddClippingRange(scene.Limits, eye, focalPoint, 0.01, 0.55);
  return scene;
}

/// Without a near plane rays reach behind the eye.
RayScene InsideOfWholeLines()
{
  RayScene scene = Inside();
  scene.Limits.Planes.clear();
  return scene;
}

/// Rays through vertices, along edges and within faces: the grid of pixels is that of the mesh.
/// Those within the hull's faces may be inside or outside.
RayScene AlongGridLines()
{
  RayScene scene;
  scene.Mesh = MakeUnitBox(12, 0);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(20);
  // Pixels of 1/24; a pixel's centre is half a pixel from the image's.
  constexpr double Pixel = 1. / 24;
  const double x = 0.5 + 0.5 * Pixel;
  scene.Grid = MakeParallelGrid({ x, x, 5 }, { x, x, 0 }, { 0, 1, 0 }, 0.5 * 30 * Pixel, 30, 30);
  return scene;
}

/// As before, along the diagonals of faces and of cells.
RayScene AlongDiagonals()
{
  RayScene scene = AlongGridLines();
  scene.Grid = MakeParallelGrid({ 3, 3, 3 }, { 0, 0, 0 }, { 0, 0, 1 }, 1, 31, 31);
  return scene;
}

RayScene ThroughFacesOfCellScalars()
{
  RayScene scene = AlongGridLines();
  scene.CellScalars = true;
  scene.Scalars.resize(scene.Mesh.GetNumberOfCells());
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> unit(0, 1);
  std::generate(scene.Scalars.begin(), scene.Scalars.end(), [&] { return unit(generator); });
  // Half of the rows run exactly between cells, which differ: either may be seen.
  scene.Grid.Origin[0] += 0.25 / 24;
  return scene;
}

RayScene MakeFarAway(double offset, double cell)
{
  constexpr int N = 11;
  const double size = N * cell;
  const Vector lower = { offset, -offset, 0.5 * offset };
  RayScene scene;
  scene.Mesh = MakeBox(N, N, N, lower, { lower[0] + size, lower[1] + size, lower[2] + size }, 0.1);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(20 / size);
  const Vector middle = { lower[0] + 0.5 * size, lower[1] + 0.5 * size, lower[2] + 0.5 * size };
  scene.Grid =
    MakePerspectiveGrid({ middle[0] + 2.6 * size, middle[1] + 1.7 * size, middle[2] + 2.2 * size },
      middle, { 0, 1, 0 }, 30, ImageSize, ImageSize);
  return scene;
}

RayScene FarAway() { return MakeFarAway(1e4, 1e-4); }

RayScene VeryFarAway() { return MakeFarAway(1e7, 1e-3); }

/// As large and as small as generated meshes may be, but for some.
RayScene HugeWorld() { return MakeFarAway(0, 1e26); }

RayScene TinyWorld() { return MakeFarAway(0, 1e-26); }

/// Layers whose thickness goes from 1e-7 to 0.1, each with the same share in the optical depth.
RayScene BoundaryLayer()
{
  RayScene scene;
  scene.Mesh =
    GenerateMesh("boundary-layer", { { "ratio", 1e6 }, { "cells", 8 }, { "layers", 30 } }).Mesh;
  constexpr double Thinnest = 1e-7;
  constexpr double TopDecade = 0;
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    scene.Scalars.push_back(std::log10(scene.Mesh.Points[3 * p + 2] + Thinnest));
  }
  std::vector<std::array<double, 5>> nodes;
  for (double decade = -7; decade <= TopDecade; decade += 1)
  {
    nodes.push_back({ decade, std::fmod(-decade, 2), (decade + 7) / 7, -decade / 7,
      0.08 * std::pow(10, -decade) });
  }
  scene.Function = MakeLinearFunction(nodes);
  scene.Grid =
    MakePerspectiveGrid({ 1.3, 0.9, -2 }, { 0.5, 0.5, 0.2 }, { 0, 1, 0 }, 35, ImageSize, ImageSize);
  return scene;
}

RayScene BoundaryLayerFromAbove()
{
  RayScene scene = BoundaryLayer();
  scene.Grid =
    MakePerspectiveGrid({ 0.2, 0.9, 4 }, { 0.5, 0.5, 0.2 }, { 0, 1, 0 }, 25, ImageSize, ImageSize);
  return scene;
}

/// An optical depth of a million in each cell, that starts on the way through the mesh.
RayScene OpticalDepthOfAMillion()
{
  RayScene scene = MakeBoxScene();
  const double attenuation = 1e6 * 11;
  scene.Function = MakeLinearFunction({ { 0.5, 0, 0, 1, 0 }, { 0.6, 1, 0, 0, attenuation },
    { 0.7, 0, 1, 0, attenuation }, { 0.8, 1, 1, 0, 0 } });
  return scene;
}

RayScene Steps()
{
  RayScene scene = MakeBoxScene();
  scene.Function.Nodes = {
    { 0.2, { { 0, 0, 1 }, 0 }, { { 0, 0.2, 1 }, 2 } },
    { 0.4, { { 0, 1, 1 }, 3 }, { { 1, 0, 0 }, 0 } },
    { 0.5, { { 1, 1, 0 }, 0 }, { { 0, 1, 0 }, 8 } },
    { 0.8, { { 0, 1, 0.5 }, 8 }, { { 1, 1, 1 }, 40 } },
  };
  return scene;
}

/// A single step between nothing and something: all scalars are beyond the one node.
RayScene OneStep()
{
  RayScene scene = MakeBoxScene();
  for (double& s : scene.Scalars)
  {
    s -= 0.6;
  }
  scene.Function.Nodes = { { 0, { { 0, 0, 0 }, 0 }, { { 1, 0.5, 0.2 }, 4 } } };
  return scene;
}

RayScene Needle()
{
  RayScene scene = MakeBoxScene();
  constexpr double Width = 1e-3;
  scene.Function = MakeLinearFunction({ { 0, 0, 0, 1, 0.1 }, { 0.5 - Width, 0, 1, 1, 0.1 },
    { 0.5, 1, 0.3, 0, 800 }, { 0.5 + Width, 0, 1, 0, 0.1 }, { 1, 1, 0, 0, 1 } });
  return scene;
}

RayScene MakeScaledScalars(double factor)
{
  RayScene scene = MakeBoxScene();
  for (double& s : scene.Scalars)
  {
    s *= factor;
  }
  for (TransferFunction::Node& node : scene.Function.Nodes)
  {
    node.Scalar *= factor;
  }
  return scene;
}

RayScene TinyScalars() { return MakeScaledScalars(1e-30); }

RayScene HugeScalars() { return MakeScaledScalars(1e30); }

/// Small differences of large scalars.
RayScene OffsetScalars()
{
  RayScene scene = MakeBoxScene();
  for (double& s : scene.Scalars)
  {
    s = 1e6 + s;
  }
  for (TransferFunction::Node& node : scene.Function.Nodes)
  {
    node.Scalar = 1e6 + node.Scalar;
  }
  return scene;
}

/// Most scalars are far outside of the transfer function's nodes.
RayScene ScalarsBeyondTheFunction()
{
  RayScene scene = MakeBoxScene();
  for (double& s : scene.Scalars)
  {
    s = 40 * (s - 0.5);
  }
  return scene;
}

RayScene ConstantField()
{
  RayScene scene = MakeBoxScene();
  std::fill(scene.Scalars.begin(), scene.Scalars.end(), 0.537);
  scene.Function = MakeColorfulFunction(5);
  return scene;
}

/// A step exactly at the scalar of the whole mesh: the value from larger scalars counts.
RayScene ConstantFieldAtAStep()
{
  RayScene scene = MakeBoxScene();
  std::fill(scene.Scalars.begin(), scene.Scalars.end(), 0.3);
  scene.Function.Nodes = {
    { 0, { { 1, 0, 0 }, 0 }, { { 1, 0, 0 }, 5 } },
    { 0.3, { { 0, 1, 0 }, 9 }, { { 0, 0.3, 1 }, 1.5 } },
    { 0.7, { { 1, 1, 1 }, 0.5 }, { { 1, 1, 1 }, 0 } },
  };
  return scene;
}

/// Half of the mesh at the lowest scalar, where the function has a step: transparent below.
RayScene PlateauAtAStep()
{
  RayScene scene = MakeBoxScene();
  for (double& s : scene.Scalars)
  {
    s = std::max(s, 0.55);
  }
  scene.Function.Nodes = {
    { 0.55, { { 0, 0, 0 }, 0 }, { { 0.2, 0.4, 1 }, 1.5 } },
    { 0.9, { { 1, 0.8, 0 }, 6 }, { { 1, 1, 1 }, 0 } },
  };
  return scene;
}

RayScene CellScalars()
{
  RayScene scene = MakeBoxScene();
  const std::vector<double> field = MakeSmoothField(scene.Mesh);
  scene.CellScalars = true;
  scene.Scalars.clear();
  for (std::size_t c = 0; c < scene.Mesh.Cells.size(); c += 4)
  {
    scene.Scalars.push_back(field[scene.Mesh.Cells[c]]);
  }
  return scene;
}

RayScene MissingPointScalars()
{
  RayScene scene = MakeBoxScene();
  for (std::size_t i = 0; i < scene.Scalars.size(); i += 7)
  {
    scene.Scalars[i] = i % 3 == 0 ? NaN : i % 3 == 1 ? Infinity : -Infinity;
  }
  return scene;
}

RayScene MissingCellScalars()
{
  RayScene scene = CellScalars();
  for (std::size_t i = 0; i < scene.Scalars.size(); i += 5)
  {
    scene.Scalars[i] = i % 3 == 0 ? NaN : i % 3 == 1 ? Infinity : -Infinity;
  }
  return scene;
}

RayScene ClippingPlanes()
{
  RayScene scene = MakeBoxScene();
  scene.Limits.Planes = { { 1, 0.3, -0.2, -0.35 }, { -0.2, -1, 0.4, 0.6 }, { 0, 0, -2, 1.7 } };
  return scene;
}

RayScene MaximumDistances()
{
  RayScene scene = MakeBoxScene();
  std::mt19937_64 generator(6);
  std::uniform_real_distribution<float> distance(3.5f, 5.f);
  for (int p = 0; p < ImageSize * ImageSize; ++p)
  {
    scene.MaximumDistances.push_back(distance(generator));
  }
  scene.MaximumDistances[ImageSize * 24 + 24] = -1;
  scene.MaximumDistances[ImageSize * 24 + 25] = 0;
  scene.MaximumDistances[ImageSize * 24 + 26] = std::numeric_limits<float>::infinity();
  return scene;
}

/// The mesh placed in the world by scaling, shear and mirroring.
RayScene Sheared()
{
  RayScene scene = MakeBoxScene();
  const double worldFromMesh[3][4] = { { 2, 0.7, 0, 10 }, { 0, 0.5, 0.3, -20 },
    { 0.4, 0, -1.5, 5 } };
  const Vector middle = { 11.35, -19.6, 4.45 };
  scene.Grid = MakePerspectiveGrid({ 16, -16, 12 }, middle, { 0, 1, 0 }, 22, ImageSize, ImageSize);
  PlaceMesh(scene.Grid, worldFromMesh);
  scene.Limits.Cropping = true;
  scene.Limits.CroppingFlags = 0x7ffe7f7u;
  const double planes[6] = { 0.2, 0.7, 0.3, 0.8, 0.1, 0.6 };
  std::copy_n(planes, 6, scene.Limits.CroppingPlanes);
  scene.Function = MakeColorfulFunction(8);
  return scene;
}

/// A layer of cells pressed flat between the others.
RayScene FlatCells()
{
  RayScene scene;
  scene.Mesh = MakeUnitBox(10, 0);
  for (std::size_t i = 2; i < scene.Mesh.Points.size(); i += 3)
  {
    double& z = scene.Mesh.Points[i];
    z = z > 0.35 && z < 0.45 ? 0.5 : z;
  }
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(20);
  scene.Grid = LookAtUnitCube(Oblique);
  return scene;
}

//------------------------------------------------------------------------------------------------
// Comparison with the reference

std::string GetName(Precision precision)
{
  return precision == Precision::Single ? "single"
    : precision == Precision::Double    ? "double"
                                        : "automatic";
}

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

#define SCENE(name)                                                                                \
  NamedScene { #name, &name }
#define GRAZING_SCENE(name, share)                                                                 \
  NamedScene { #name, &name, share }
INSTANTIATE_TEST_SUITE_P(RayCaster, RayCasterScenes,
  testing::Values(SCENE(Perspective), SCENE(Parallel), SCENE(Inside), SCENE(InsideOfWholeLines),
    GRAZING_SCENE(AlongGridLines, 0.1), SCENE(AlongDiagonals),
    GRAZING_SCENE(ThroughFacesOfCellScalars, 0.5), SCENE(FarAway), SCENE(VeryFarAway),
    SCENE(HugeWorld), SCENE(TinyWorld), SCENE(BoundaryLayer), SCENE(BoundaryLayerFromAbove),
    SCENE(OpticalDepthOfAMillion), SCENE(Steps), SCENE(OneStep), SCENE(Needle), SCENE(TinyScalars),
    SCENE(HugeScalars), SCENE(OffsetScalars), SCENE(ScalarsBeyondTheFunction), SCENE(ConstantField),
    SCENE(ConstantFieldAtAStep), SCENE(PlateauAtAStep), SCENE(CellScalars),
    SCENE(MissingPointScalars), SCENE(MissingCellScalars), SCENE(ClippingPlanes),
    SCENE(MaximumDistances), SCENE(Sheared), SCENE(FlatCells)),
  [](const testing::TestParamInfo<NamedScene>& info) { return info.param.Name; });
#undef SCENE
#undef GRAZING_SCENE

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

//------------------------------------------------------------------------------------------------
// Watertight

/// Length of a ray inside the unit cube.
double GetChord(const long double (&origin)[3], const long double (&direction)[3])
{
  long double begin = -std::numeric_limits<long double>::infinity();
  long double end = -begin;
  long double squared = 0;
  for (int a = 0; a < 3; ++a)
  {
    squared += direction[a] * direction[a];
    if (direction[a] == 0)
    {
      if (origin[a] < 0 || origin[a] > 1)
      {
        return 0;
      }
      continue;
    }
    const long double t0 = -origin[a] / direction[a];
    const long double t1 = (1 - origin[a]) / direction[a];
    begin = std::max(begin, std::min(t0, t1));
    end = std::min(end, std::max(t0, t1));
  }
  return begin < end ? static_cast<double>((end - begin) * std::sqrt(squared)) : 0;
}

double GetChord(const RayGrid& grid, int i, int j)
{
  long double origin[3], direction[3];
  for (int a = 0; a < 3; ++a)
  {
    origin[a] = grid.Origin[a] + static_cast<long double>(i) * grid.OriginStepX[a] +
      static_cast<long double>(j) * grid.OriginStepY[a];
    direction[a] = grid.Direction[a] + static_cast<long double>(i) * grid.DirectionStepX[a] +
      static_cast<long double>(j) * grid.DirectionStepY[a];
  }
  return GetChord(origin, direction);
}

/// A unit cube of one attenuation: the optical depth of a ray is its length inside.
constexpr double ThinAttenuation = 0.25;

/// Largest error of a length that is read from an opacity: the opacity is rounded to 2^-24, and up
/// to thirty segments are multiplied. A lost or doubled cell is off by its size, about 0.1.
constexpr double LengthError = 2e-5;

/// How far rounding may move a face of the unit cube.
constexpr double FaceError = 1. / (1 << 22);

/// Largest error of a length along a direction: a face that is met at a slant is found late by more
/// than it was moved, or the ray that passes an edge of it was displaced, at most twice here.
double GetLengthError(const double (&direction)[3])
{
  constexpr double Parallel = 1e-6; // such a ray is along a face, and not in the hull
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  double slant = 1;
  for (const double d : direction)
  {
    slant = std::abs(d) > Parallel * length ? std::min(slant, std::abs(d) / length) : slant;
  }
  const double displacement = std::hypot(RayDisplacements[1][0], RayDisplacements[1][1]);
  return LengthError + (1 + displacement) * FaceError / slant;
}

RayScene MakeConstantCube()
{
  RayScene scene = MakeBoxScene(9);
  scene.Function = MakeConstantFunction(ThinAttenuation, { 1, 0.5, 0.25 });
  return scene;
}

double GetLength(const RayPicture& picture, std::size_t pixel)
{
  return -std::log1p(-static_cast<double>(picture.Colors[4 * pixel + 3])) / ThinAttenuation;
}

TEST(RayCaster, OpticalDepthIsTheLengthOfAnyRay)
{
  std::mt19937_64 generator(13);
  std::uniform_real_distribution<double> unit(0, 1);
  RayScene scene = MakeConstantCube();
  VolumeScene volume = scene.MakeVolumeScene();
  double largest[2] = { 0, 0 };
  for (int camera = 0; camera < 12; ++camera)
  {
    // From all around and from inside, where a line reaches behind the eye.
    const double distance = camera % 4 == 3 ? 0.2 : 1.5 + 3 * unit(generator);
    const double longitude = 7 * unit(generator);
    const double height = 2 * unit(generator) - 1;
    const double around = std::sqrt(1 - height * height);
    scene.Grid = MakePerspectiveGrid(
      { 0.5 + distance * around * std::cos(longitude),
        0.5 + distance * around * std::sin(longitude), 0.5 + distance * height },
      { 0.5, 0.5, 0.5 }, { 0.3, 0.4, 0.5 }, 40, 96, 96);
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      RayCastOptions options;
      options.Arithmetic = precision;
      const RayPicture picture = Cast(volume, scene, options);
      for (int p = 0; p < 96 * 96; ++p)
      {
        const double error = std::abs(GetLength(picture, p) - GetChord(scene.Grid, p % 96, p / 96));
        ASSERT_LE(error, LengthError)
          << "camera " << camera << ", pixel " << p << ", " << GetName(precision) << " precision";
        double& most = largest[precision == Precision::Double];
        most = std::max(most, error);
      }
    }
  }
  std::cout << "error of lengths: " << largest[0] << " in single, " << largest[1]
            << " in double precision\n";
}

TEST(RayCaster, OpticalDepthIsTheLengthOfRaysThroughVerticesEdgesAndFaces)
{
  std::mt19937_64 generator(14);
  std::normal_distribution<double> normal;
  // With and without jitter: in a grid many faces and edges are in line.
  for (const double jitter : { 0., 0.15 })
  {
    RayScene scene = MakeConstantCube();
    scene.Mesh = MakeUnitBox(8, jitter);
    scene.Scalars = MakeSmoothField(scene.Mesh);
    VolumeScene volume = scene.MakeVolumeScene();
    scene.Grid.Width = scene.Grid.Height = 1;
    RayCastOptions options;
    options.NumberOfThreads = 1;
    for (int ray = 0; ray < 6000; ++ray)
    {
      // A corner of a cell, the middle of an edge or of a face; seen from another one, from any
      // direction, or along an axis or a diagonal.
      const auto pickTarget = [&](double(&target)[3])
      {
        const std::size_t cell = generator() % scene.Mesh.GetNumberOfCells();
        const int corners = 1 + static_cast<int>(generator() % 3);
        for (int a = 0; a < 3; ++a)
        {
          target[a] = 0;
          for (int c = 0; c < corners; ++c)
          {
            target[a] += scene.Mesh.Points[3 * scene.Mesh.Cells[4 * cell + c] + a] / corners;
          }
        }
      };
      double target[3], eye[3];
      pickTarget(target);
      if (ray % 3 == 0)
      {
        pickTarget(eye);
      }
      for (int a = 0; a < 3; ++a)
      {
        eye[a] = ray % 3 == 0 ? eye[a]
          : ray % 3 == 1      ? target[a] + 3 * normal(generator)
                              : target[a] + static_cast<double>(generator() % 3) - 1;
        scene.Grid.Origin[a] = eye[a];
        scene.Grid.Direction[a] = target[a] - eye[a];
        scene.Grid.DirectionStepX[a] = scene.Grid.DirectionStepY[a] = 0;
      }
      const double* d = scene.Grid.Direction;
      // A ray within the hull may count or not.
      bool inHull = d[0] == 0 && d[1] == 0 && d[2] == 0;
      for (int a = 0; a < 3; ++a)
      {
        constexpr double Near = 1e-6;
        inHull |= std::abs(d[a]) < Near && (eye[a] < Near || eye[a] > 1 - Near);
      }
      if (inHull)
      {
        continue;
      }
      for (const Precision precision : { Precision::Single, Precision::Double })
      {
        options.Arithmetic = precision;
        const RayPicture picture = Cast(volume, scene, options);
        ASSERT_NEAR(
          GetLength(picture, 0), GetChord(scene.Grid, 0, 0), GetLengthError(scene.Grid.Direction))
          << "ray " << ray << " from " << eye[0] << " " << eye[1] << " " << eye[2] << " to "
          << target[0] << " " << target[1] << " " << target[2] << ", " << GetName(precision)
          << " precision";
      }
    }
  }
}

/// Of units of length whose squares single precision has no numbers for, too.
TEST(RayCaster, OpticalDepthIsTheLengthAmongHangingNodesInAnyUnit)
{
  const TetrahedralMesh octree = MakeOctree(3, 2);
  const RayGrid rays =
    MakePerspectiveGrid({ 0.5, 4.5, 0.5 }, { 0.5, 0.5, 0.5 }, { 0, 0, 1 }, 18, 63, 63);
  for (const int exponent : { -66, 0, 66 })
  {
    SCOPED_TRACE(exponent);
    const double length = std::ldexp(1, exponent);
    RayScene scene;
    scene.Mesh = octree;
    std::transform(octree.Points.begin(), octree.Points.end(), scene.Mesh.Points.begin(),
      [length](double x) { return length * x; });
    scene.Scalars = std::vector<double>(octree.GetNumberOfPoints(), 0.5);
    scene.Function = MakeConstantFunction(ThinAttenuation / length, { 1, 0.5, 0.25 });
    scene.Grid = rays;
    for (double& x : scene.Grid.Origin)
    {
      x *= length;
    }
    VolumeScene volume = scene.MakeVolumeScene();
    RayCastOptions options;
    options.Arithmetic = Precision::Single;
    const RayPicture picture = Cast(volume, scene, options);
    for (int p = 0; p < rays.Width * rays.Height; ++p)
    {
      // Of all rays, those of the middle row and column run in the faces of cubes.
      ASSERT_NEAR(
        GetLength(picture, p), GetChord(rays, p % rays.Width, p / rays.Width), LengthError)
        << "pixel " << p;
    }
  }
}

TEST(RayCaster, WalksThroughAsManyCellsAsTheReferenceFinds)
{
  RayScene scene = MakeBoxScene(9);
  scene.Function = MakeConstantFunction(1e-3, { 1, 1, 1 }); // no ray ends early
  const std::int64_t expected = scene.RenderReference().NumberOfSegments;
  ASSERT_GT(expected, 10000);
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.Arithmetic = Precision::Double;
  EXPECT_EQ(Cast(volume, scene, options).Statistics.Segments, expected);
  // Rounded points move rays past edges, but almost never.
  options.Arithmetic = Precision::Single;
  EXPECT_NEAR(static_cast<double>(Cast(volume, scene, options).Statistics.Segments),
    static_cast<double>(expected), 1e-3 * static_cast<double>(expected));
}

//------------------------------------------------------------------------------------------------
// Threads, caches, errors

bool AreIdentical(const RayPicture& a, const RayPicture& b)
{
  return a.Colors.size() == b.Colors.size() &&
    std::memcmp(a.Colors.data(), b.Colors.data(), a.Colors.size() * sizeof(float)) == 0 &&
    std::memcmp(a.Depths.data(), b.Depths.data(), a.Depths.size() * sizeof(float)) == 0;
}

TEST(RayCaster, SamePictureForAnyNumberOfThreads)
{
  for (RayScene scene : { MakeBoxScene(), CellScalars() })
  {
    scene.Grid = LookAtUnitCube(Oblique, 101); // tiles at the borders are partial
    VolumeScene volume = scene.MakeVolumeScene();
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      RayCastOptions options;
      options.Arithmetic = precision;
      options.NumberOfThreads = 1;
      const RayPicture expected = Cast(volume, scene, options);
      for (const int threads : { 2, 3, 7 })
      {
        options.NumberOfThreads = threads;
        const RayPicture picture = Cast(volume, scene, options);
        EXPECT_TRUE(AreIdentical(picture, expected)) << threads << " threads";
        EXPECT_EQ(picture.Statistics.Segments, expected.Statistics.Segments);
        EXPECT_EQ(picture.Statistics.NumberOfThreads, threads);
      }
    }
  }
}

TEST(RayCaster, TilesMakeTheSamePictureAsTheWhole)
{
  RayScene scene = MakeBoxScene();
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  const RayPicture whole = Cast(volume, scene, options);
  RayScene part = scene;
  part.Grid = MakeTile(scene.Grid, 13, 7, 19, 23);
  const RayPicture tile = Cast(volume, part, options);
  for (int y = 0; y < 23; ++y)
  {
    for (int x = 0; x < 19; ++x)
    {
      for (int c = 0; c < 4; ++c)
      {
        // Origins of a tile are rounded.
        ASSERT_NEAR(tile.Colors[4 * (y * 19 + x) + c],
          whole.Colors[4 * ((y + 7) * ImageSize + x + 13) + c], KernelDifference);
      }
    }
  }
}

TEST(RayCaster, WhatIsSetAgainReplacesWhatWas)
{
  const auto cast = [](VolumeScene& volume, const RayScene& scene)
  {
    std::vector<RayPicture> pictures;
    for (const Precision precision : { Precision::Single, Precision::Double, Precision::Single })
    {
      RayCastOptions options;
      options.Arithmetic = precision;
      pictures.push_back(Cast(volume, scene, options));
    }
    EXPECT_TRUE(AreIdentical(pictures[0], pictures[2]));
    return pictures;
  };
  RayScene first = MakeBoxScene();
  VolumeScene volume = first.MakeVolumeScene();
  cast(volume, first);

  const auto expectFresh = [&](const RayScene& scene, const std::string& what)
  {
    VolumeScene fresh = scene.MakeVolumeScene();
    const std::vector<RayPicture> expected = cast(fresh, scene);
    const std::vector<RayPicture> actual = cast(volume, scene);
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_TRUE(AreIdentical(actual[i], expected[i])) << what << ", picture " << i;
    }
  };
  const auto inOrder = [](const RayScene& scene, const std::vector<std::int32_t>& ids)
  {
    std::vector<double> scalars;
    for (const std::int64_t id : ids)
    {
      scalars.push_back(scene.Scalars[id]);
    }
    return scalars;
  };

  RayScene scene = Steps(); // another range of nodes
  volume.Optics.SetTransferFunction(scene.Function);
  expectFresh(scene, "transfer function");

  for (TransferFunction::Node& node : scene.Function.Nodes)
  {
    node.Right.Color[0] *= 0.5; // the same range
    node.Right.Attenuation *= 2;
  }
  volume.Optics.SetTransferFunction(scene.Function);
  expectFresh(scene, "values of the transfer function");

  for (double& s : scene.Scalars)
  {
    s = 0.8 * s + 0.05;
  }
  volume.Mesh.SetPointScalars(inOrder(scene, volume.Mesh.GetMesh()->GetMesh().OriginalPoints));
  expectFresh(scene, "point scalars");

  const RayScene cells = CellScalars();
  scene.CellScalars = true;
  scene.Scalars = cells.Scalars;
  volume.Mesh.SetCellScalars(inOrder(scene, volume.Mesh.GetMesh()->GetMesh().OriginalCells));
  expectFresh(scene, "cell scalars");

  volume.Optics.SetTransferFunction(cells.Function);
  scene.Function = cells.Function;
  expectFresh(scene, "transfer function of cell scalars");
}

TEST(RayCaster, EndsRaysEarlyWithinTheErrorAskedFor)
{
  RayScene scene = MakeBoxScene();
  scene.Function = MakeColorfulFunction(60);
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.Arithmetic = Precision::Double;
  options.MaximumError = 1e-9;
  const RayPicture exact = Cast(volume, scene, options);
  std::int64_t segments = exact.Statistics.Segments;
  for (const double error : { 1e-4, 1e-2, 0.1 })
  {
    options.MaximumError = error;
    const RayPicture picture = Cast(volume, scene, options);
    EXPECT_EQ(picture.Statistics.TerminationError, 0.5 * error);
    EXPECT_LE(picture.Statistics.ErrorEstimate, error);
    EXPECT_LT(picture.Statistics.Segments, segments);
    segments = picture.Statistics.Segments;
    for (std::size_t i = 0; i < picture.Colors.size(); ++i)
    {
      ASSERT_LE(std::abs(picture.Colors[i] - exact.Colors[i]), 0.5 * error + 1e-6);
    }
  }
}

TEST(RayCaster, ClearWhereThereIsNothing)
{
  const auto expectClear = [](const RayScene& scene, const std::string& what)
  {
    SCOPED_TRACE(what);
    VolumeScene volume = scene.MakeVolumeScene();
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      RayCastOptions options;
      options.Arithmetic = precision;
      const RayPicture picture = Cast(volume, scene, options);
      EXPECT_TRUE(
        std::all_of(picture.Colors.begin(), picture.Colors.end(), [](float c) { return c == 0; }));
      EXPECT_TRUE(
        std::all_of(picture.Depths.begin(), picture.Depths.end(), [](float d) { return d == -1; }));
      EXPECT_FALSE(std::isnan(picture.Statistics.ErrorEstimate));
    }
  };
  RayScene scene = MakeBoxScene(3);
  scene.Mesh = {};
  scene.Scalars.clear();
  expectClear(scene, "no mesh");
  scene.CellScalars = true;
  expectClear(scene, "no cells");

  scene = MakeBoxScene(3);
  scene.Function = MakeConstantFunction(0, { 1, 1, 1 });
  expectClear(scene, "no attenuation");

  scene = MakeBoxScene(3);
  std::fill(scene.Scalars.begin(), scene.Scalars.end(), NaN);
  expectClear(scene, "no scalars");
  EXPECT_EQ(scene.MakeVolumeScene().Mesh.GetNumberOfBlankCells(), 3 * 3 * 3 * 5);

  scene = MakeBoxScene(3);
  scene.Grid = LookAtUnitCube({ 3, 2, 2 });
  scene.Limits.Planes.push_back({ 0, 0, 1, -1.5 });
  expectClear(scene, "all clipped");

  scene = MakeBoxScene(3);
  scene.Limits.Cropping = true;
  scene.Limits.CroppingFlags = 0;
  expectClear(scene, "all cropped");

  scene = MakeBoxScene(3);
  scene.Grid = MakePerspectiveGrid({ 5, 5, 5 }, { 5, 5, 6 }, { 0, 1, 0 }, 20, 16, 16);
  expectClear(scene, "beside the mesh");
}

TEST(RayCaster, ProgressIsToldAndAborts)
{
  RayScene scene = MakeBoxScene(5);
  scene.Grid = LookAtUnitCube(Oblique, 128);
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  for (const int threads : { 1, 3 })
  {
    options.NumberOfThreads = threads;
    std::vector<double> told;
    options.Progress = [&](double share)
    {
      told.push_back(share);
      return true;
    };
    EXPECT_FALSE(Cast(volume, scene, options).Statistics.Aborted);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_TRUE(std::all_of(told.begin(), told.end(), [](double t) { return t > 0 && t <= 1; }));
    ASSERT_FALSE(told.empty());
    EXPECT_EQ(told.back(), 1);
  }
  options.NumberOfThreads = 1;
  int calls = 0;
  options.Progress = [&](double)
  {
    ++calls;
    return false;
  };
  EXPECT_TRUE(Cast(volume, scene, options).Statistics.Aborted);
  EXPECT_EQ(calls, 1);

  // After an abort the next picture is as good as ever.
  options.Progress = nullptr;
  const RayPicture picture = Cast(volume, scene, options);
  EXPECT_FALSE(picture.Statistics.Aborted);
  VolumeScene fresh = scene.MakeVolumeScene();
  EXPECT_TRUE(AreIdentical(picture, Cast(fresh, scene, options)));
}

TEST(RayCaster, ExceptionsOfProgressReachTheCaller)
{
  const RayScene scene = MakeBoxScene(3);
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.Progress = [](double) -> bool { throw std::runtime_error("enough"); };
  options.NumberOfThreads = 1;
  EXPECT_THROW(Cast(volume, scene, options), std::runtime_error);
}

std::string GetError(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(RayCaster, RefusesWhatDoesNotFitInOneLine)
{
  const RayScene scene = MakeBoxScene(3);
  VolumeScene volume = scene.MakeVolumeScene();
  const std::size_t points = volume.Mesh.GetMesh()->GetMesh().GetNumberOfPoints();
  ASSERT_EQ(points, 64u);
  EXPECT_EQ(GetError(
              [&] {
                volume.Mesh.SetPointScalars({ 1, 2, 3 });
              }),
    "3 scalars were given for 64 points");
  EXPECT_EQ(GetError([&] { volume.Mesh.SetCellScalars(std::vector<double>(64)); }),
    "64 scalars were given for 135 cells");

  std::vector<float> colors(4 * ImageSize * ImageSize);
  std::vector<float> depths(ImageSize * ImageSize);
  const auto cast = [&](VolumeScene& c) { CastRays(c, scene.Grid, {}, {}, colors, depths); };
  EXPECT_EQ(GetError([&] { cast(volume); }), "no error");
  colors.pop_back();
  const std::string sizes = "the image arrays do not have the size of the ray grid";
  EXPECT_EQ(GetError([&] { cast(volume); }), sizes);
  colors.resize(4 * ImageSize * ImageSize);
  depths.push_back(0);
  EXPECT_EQ(GetError([&] { cast(volume); }), sizes);
  depths.pop_back();

  VolumeScene bare;
  EXPECT_EQ(GetError([&] { cast(bare); }),
    "a mesh and a transfer function must be set before rays are cast");
  EXPECT_EQ(
    GetError([&] { bare.Mesh.SetPointScalars({ 1 }); }), "the mesh must be set before its scalars");
  bare.Mesh.SetMesh(std::make_shared<WalkMesh>(scene.Mesh));
  bare.Optics.SetTransferFunction(scene.Function);
  EXPECT_EQ(
    GetError([&] { cast(bare); }), "scalars must be set after the mesh and before rays are cast");
  EXPECT_NE(GetError([&] { bare.Optics.SetTransferFunction({}); }), "no error");
}

} // namespace
