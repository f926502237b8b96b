// SPDX-License-Identifier: BSD-3-Clause

// Lengths of rays that are known without any renderer.

#include "BoxScene.h"
#include "MeshParts.h"
#include "RayScene.h"

#include "Generate/GeneratedMeshes.h"
#include "View/RayDisplacements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <vector>

namespace
{

using namespace tetralux;
using namespace tetralux::box_scene;

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

} // namespace
