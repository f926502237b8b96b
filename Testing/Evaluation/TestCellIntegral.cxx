// SPDX-License-Identifier: BSD-3-Clause

// The integral through cells in double precision, against the oracle and closed forms.

#include "CellIntegral/CellIntegral.h"
#include "Generate/GeneratedMeshes.h"
#include "RayScene.h"
#include "SampleFunctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

constexpr int Width = 12;
constexpr int Height = 9;
constexpr double LargestAttenuation = 8; ///< per world unit

std::vector<double> Integrate(const RayScene& scene, int threads = 1)
{
  VolumeScene volume = scene.MakeVolumeScene();
  return IntegrateCells(volume, scene.Grid, scene.GetLimits(), threads);
}

/// The largest difference of a channel from the oracle's.
double FindError(const RayScene& scene)
{
  const std::vector<double> pixels = Integrate(scene);
  const ReferenceImage exact = scene.RenderReference();
  EXPECT_GT(*std::max_element(exact.Rgba.begin(), exact.Rgba.end()), 0.01);
  double largest = 0;
  for (std::size_t k = 0; k < pixels.size(); ++k)
  {
    const double error = std::abs(pixels[k] - exact.Rgba[k]);
    largest = error <= largest ? largest : error;
  }
  return largest;
}

RayScene MakeScene(unsigned seed)
{
  std::mt19937_64 generator(seed);
  RayScene scene;
  scene.Mesh = MakeBox(5, 5, 5, { 0, 0, 0 }, { 1, 1, 1 }, 0.15);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeRandomFunction(generator, 12, LargestAttenuation, true);
  scene.Grid =
    MakePerspectiveGrid({ 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, Width, Height);
  return scene;
}

void SetCellScalars(RayScene& scene)
{
  std::vector<double> scalars;
  for (std::size_t cell = 0; cell < scene.Mesh.GetNumberOfCells(); ++cell)
  {
    scalars.push_back(scene.Scalars[scene.Mesh.Cells[4 * cell]]);
  }
  scene.Scalars = scalars;
  scene.CellScalars = true;
}

TEST(CellIntegral, IsThatOfTheOracle)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    RayScene scene = MakeScene(seed);
    EXPECT_LE(FindError(scene), CellIntegralError);
    SetCellScalars(scene);
    EXPECT_LE(FindError(scene), CellIntegralError);
  }
}

TEST(CellIntegral, IsThatOfTheOracleForAnyCameraAndPlace)
{
  RayScene scene = MakeScene(7);
  scene.Grid =
    MakeParallelGrid({ 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 0.8, Width, Height);
  EXPECT_LE(FindError(scene), CellIntegralError);

  // From inside, up to a far plane, with a clipping plane.
  const std::array<double, 3> eye = { 0.4, 0.45, 0.3 };
  const std::array<double, 3> focus = { 0.6, 0.5, 0.9 };
  scene.Grid = MakePerspectiveGrid(eye, focus, { 0, 1, 0 }, 80, Width, Height);
  AddClippingRange(scene.Limits, eye, focus, 0.01, 0.45);
  scene.Limits.Planes.push_back({ 1, 0.3, 0, -0.4 });
  EXPECT_LE(FindError(scene), CellIntegralError);

  // Mirrored, sheared and moved.
  scene = MakeScene(8);
  const double worldFromMesh[3][4] = { { -2, 0.3, 0, 1.5 }, { 0, 1.2, 0.1, -0.1 },
    { 0.2, 0, 1.7, -0.4 } };
  PlaceMesh(scene.Grid, worldFromMesh);
  EXPECT_LE(FindError(scene), CellIntegralError);
}

TEST(CellIntegral, IsThatOfTheOracleThroughHolesAndFolds)
{
  for (const char* name : { "ring", "heat-sink" })
  {
    SCOPED_TRACE(name);
    RayScene scene = MakeScene(9);
    scene.Mesh = GenerateMesh(name, {}).Mesh;
    scene.Scalars = MakeSmoothField(scene.Mesh);
    double center[3], radius;
    {
      const VolumeScene volume = scene.MakeVolumeScene();
      std::copy_n(volume.Mesh.GetMesh()->GetCenter(), 3, center);
      radius = volume.Mesh.GetMesh()->GetRadius();
    }
    scene.Grid =
      MakePerspectiveGrid({ center[0] + 3.1 * radius, center[1] + 2 * radius, center[2] + radius },
        { center[0], center[1], center[2] }, { 0, 1, 0 }, 25, Width, Height);
    EXPECT_LE(FindError(scene), CellIntegralError);
  }
}

/// Through vertices, along edges and in faces: the oracle displaces rays to a side of its own, and
/// the scalar is the same on both.
TEST(CellIntegral, GoesThroughEachCellOnceAlongEdges)
{
  RayScene scene;
  scene.Mesh = MakeBox(6, 6, 6, { 0, 0, 0 }, { 1, 1, 1 }, 0);
  scene.Scalars.assign(scene.Mesh.GetNumberOfPoints(), 0.5);
  scene.Function = MakeConstantFunction(LargestAttenuation, { 1, 0.5, 0.25 });
  // Pixels of 1/12; a pixel's centre is half a pixel from the image's.
  constexpr double Pixel = 1. / 12;
  const double x = 0.5 + 0.5 * Pixel;
  scene.Grid = MakeParallelGrid({ x, x, 5 }, { x, x, 0 }, { 0, 1, 0 }, 0.5 * 10 * Pixel, 10, 10);
  const std::vector<double> pixels = Integrate(scene);
  for (std::size_t p = 0; p < pixels.size(); p += 4)
  {
    EXPECT_NEAR(pixels[p + 3], -std::expm1(-LargestAttenuation), CellIntegralError) << p / 4;
  }
}

/// Thousands of nodes on a straight line are none, and add nothing but roundings.
TEST(CellIntegral, AddsUpThousandsOfPieces)
{
  constexpr int Pieces = 5000;
  RayScene scene = MakeScene(1);
  const auto evaluate = [](double s) {
    return TransferFunction::Value{ { s, 1 - s, 0.5 }, 0.1 + LargestAttenuation * s };
  };
  scene.Function.Nodes = { { 0, evaluate(0), evaluate(0) }, { 1, evaluate(1), evaluate(1) } };
  // The field goes up and down many times.
  for (double& s : scene.Scalars)
  {
    s = 0.5 + 0.5 * std::sin(40 * s);
  }
  const std::vector<double> expected = Integrate(scene);
  // Where a colour is a product with an attenuation, halves of a piece add up to it.
  scene.Function.Nodes.clear();
  for (int k = 0; k <= Pieces; ++k)
  {
    const double s = static_cast<double>(k) / Pieces;
    scene.Function.Nodes.push_back({ s, evaluate(s), evaluate(s) });
  }
  const std::vector<double> pixels = Integrate(scene);
  double largest = 0;
  for (std::size_t k = 0; k < pixels.size(); ++k)
  {
    largest = std::max(largest, std::abs(pixels[k] - expected[k]));
  }
  EXPECT_LE(largest, CellIntegralError);
}

/// Scalars within a few roundings of a node, where attenuation is the same on both sides.
TEST(CellIntegral, CountsEachLengthOnceAtANode)
{
  constexpr double Node = 0.3;
  RayScene scene = MakeScene(1);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> exponent(-54, -20);
  for (std::size_t p = 0; p < scene.Scalars.size(); ++p)
  {
    scene.Scalars[p] = Node + (p % 2 ? 1 : -1) * std::exp2(exponent(generator));
  }
  const TransferFunction::Value value = { { 1, 1, 1 }, LargestAttenuation };
  const TransferFunction::Value other = { { 1, 1, 0 }, LargestAttenuation };
  scene.Function.Nodes = { { 0, value, value }, { Node, value, value }, { 1, other, other } };
  scene.Grid = MakeParallelGrid({ 0.5, 0.5, 5 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.3, Width, Height);
  const std::vector<double> pixels = Integrate(scene);
  for (std::size_t p = 0; p < pixels.size(); p += 4)
  {
    EXPECT_NEAR(pixels[p + 3], -std::expm1(-LargestAttenuation), CellIntegralError) << p / 4;
  }
}

TEST(CellIntegral, LeavesOutWhatHasNoScalar)
{
  RayScene scene = MakeScene(1);
  scene.Scalars[100] = std::numeric_limits<double>::quiet_NaN();
  scene.Scalars[60] = std::numeric_limits<double>::infinity();
  EXPECT_LE(FindError(scene), CellIntegralError);
}

TEST(CellIntegral, ThreadsDoNotMatter)
{
  const RayScene scene = MakeScene(2);
  EXPECT_EQ(Integrate(scene, 1), Integrate(scene, 3));
}

TEST(CellIntegral, RefusesWhatIsNoSuchIntegral)
{
  RayScene scene = MakeScene(3);
  scene.Model = OpticalModel::MaximumIntensity;
  EXPECT_THROW(Integrate(scene), std::invalid_argument);
  scene = MakeScene(3);
  scene.Limits.Cropping = true;
  EXPECT_THROW(Integrate(scene), std::invalid_argument);
  scene = MakeScene(3);
  scene.MaximumDistances.assign(Width * Height, 1.f);
  EXPECT_THROW(Integrate(scene), std::invalid_argument);
}

} // namespace
} // namespace tetralux
