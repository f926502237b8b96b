// SPDX-License-Identifier: BSD-3-Clause
#include "ComparedScenes.h"

#include "BoxScene.h"
#include "Generate/GeneratedMeshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace tetralux
{
namespace box_scene
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

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

} // namespace

#define SCENE(name)                                                                                \
  NamedScene { #name, &name }
#define GRAZING_SCENE(name, share)                                                                 \
  NamedScene { #name, &name, share }
std::vector<NamedScene> ListComparedScenes()
{
  return { SCENE(Perspective), SCENE(Parallel), SCENE(Inside), SCENE(InsideOfWholeLines),
    GRAZING_SCENE(AlongGridLines, 0.1), SCENE(AlongDiagonals),
    GRAZING_SCENE(ThroughFacesOfCellScalars, 0.5), SCENE(FarAway), SCENE(VeryFarAway),
    SCENE(HugeWorld), SCENE(TinyWorld), SCENE(BoundaryLayer), SCENE(BoundaryLayerFromAbove),
    SCENE(OpticalDepthOfAMillion), SCENE(Steps), SCENE(OneStep), SCENE(Needle), SCENE(TinyScalars),
    SCENE(HugeScalars), SCENE(OffsetScalars), SCENE(ScalarsBeyondTheFunction), SCENE(ConstantField),
    SCENE(ConstantFieldAtAStep), SCENE(PlateauAtAStep), SCENE(CellScalars),
    SCENE(MissingPointScalars), SCENE(MissingCellScalars), SCENE(ClippingPlanes),
    SCENE(MaximumDistances), SCENE(Sheared), SCENE(FlatCells) };
}
#undef SCENE
#undef GRAZING_SCENE

} // namespace box_scene
} // namespace tetralux
