// SPDX-License-Identifier: BSD-3-Clause

// Several scalars in the ray caster, against small steps through every cell.

#include "RayScene.h"
#include "ReferenceComponents.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;

/// Of a channel: half of MaximumError, and what the steps of the reference leave.
constexpr double ErrorGoal = 1e-4;

/// The same, where rays go on to their ends.
constexpr double ExactGoal = 1e-5;

constexpr int ImageSize = 20;

/// Of scalars that are whole numbers.
constexpr int LargestScalar = 4;

struct ComponentScene
{
  RayScene Rays; ///< its scalars are those of the first component
  std::vector<std::vector<double>> Scalars;
  ComponentFunctions Components;
};

/// Another field over the same box.
std::vector<double> MakeOtherField(const TetrahedralMesh& mesh, int number)
{
  std::vector<double> field;
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    const double* x = &mesh.Points[3 * p];
    field.push_back(0.5 + 0.5 * std::sin(3 * x[number % 3] + 2 * x[(number + 1) % 3] + number));
  }
  return field;
}

/// The attenuation of a function alone, or its colour alone.
TransferFunction Keep(TransferFunction function, bool colors)
{
  for (TransferFunction::Node& node : function.Nodes)
  {
    for (TransferFunction::Value* value : { &node.Left, &node.Right })
    {
      if (colors)
      {
        value->Attenuation = 0;
      }
      else
      {
        std::fill_n(value->Color, 3, 0.);
      }
    }
  }
  return function;
}

ComponentScene MakeScene(int components, bool dependent, double largestAttenuation)
{
  ComponentScene scene;
  scene.Rays.Mesh = MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.15);
  scene.Rays.Grid = MakePerspectiveGrid(
    { 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, ImageSize, ImageSize);
  const double k = largestAttenuation;
  const TransferFunction functions[MostComponents] = { MakeColorfulFunction(k),
    MakeLinearFunction({ { 0.2, 1, 0, 0, 0.3 * k }, { 0.5, 0, 0.5, 1, 0 }, { 0.9, 1, 1, 1, k } }),
    MakeFunctionWithSteps(), MakeLinearFunction({ { 0, 0, 1, 0, 0 }, { 1, 1, 0, 1, 0.5 * k } }) };
  scene.Components.Dependent = dependent;
  for (int c = 0; c < components; ++c)
  {
    scene.Scalars.push_back(
      c == 0 ? MakeSmoothField(scene.Rays.Mesh) : MakeOtherField(scene.Rays.Mesh, c));
    scene.Components.Functions.push_back(
      dependent ? Keep(functions[c], c + 1 < components) : functions[c]);
  }
  scene.Rays.Scalars = scene.Scalars[0];
  scene.Rays.Function = scene.Components.Functions[0];
  return scene;
}

ComponentScene OfCells(ComponentScene scene)
{
  scene.Rays.CellScalars = true;
  for (std::vector<double>& values : scene.Scalars)
  {
    std::vector<double> ofCells;
    for (std::size_t cell = 0; cell < scene.Rays.Mesh.GetNumberOfCells(); ++cell)
    {
      ofCells.push_back(values[scene.Rays.Mesh.Cells[4 * cell]]);
    }
    values = ofCells;
  }
  scene.Rays.Scalars = scene.Scalars[0];
  return scene;
}

ComponentScene Limited(ComponentScene scene)
{
  scene.Rays.Limits.Planes.push_back({ -1, 0.3, -0.5, 0.7 });
  scene.Rays.Limits.Cropping = true;
  scene.Rays.Limits.CroppingFlags = 0x7ffdfff;
  const double planes[6] = { 0.2, 0.7, 0.3, 0.8, 0.1, 0.6 };
  std::copy_n(planes, 6, scene.Rays.Limits.CroppingPlanes);
  return scene;
}

VolumeScene MakeVolume(const ComponentScene& scene)
{
  VolumeScene volume = scene.Rays.MakeVolumeScene();
  const TetrahedralMesh& mesh = volume.Mesh.GetMesh()->GetMesh();
  const auto& originals = scene.Rays.CellScalars ? mesh.OriginalCells : mesh.OriginalPoints;
  std::vector<std::vector<double>> others;
  for (std::size_t c = 1; c < scene.Scalars.size(); ++c)
  {
    others.emplace_back();
    for (const std::int64_t id : originals)
    {
      others.back().push_back(scene.Scalars[c][id]);
    }
  }
  volume.Mesh.SetOtherScalars(others);
  volume.Optics.SetComponents(scene.Components);
  return volume;
}

std::vector<double> RenderReference(const ComponentScene& scene)
{
  return RenderComponents(scene.Rays.GetReferenceMesh(), scene.Scalars, scene.Components,
    scene.Rays.Grid, scene.Rays.GetLimits());
}

double FindLargestError(const std::vector<float>& picture, const std::vector<double>& expected)
{
  double largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const double error = std::abs(picture[i] - expected[i]);
    largest = error <= largest ? largest : error; // what is no number counts
  }
  return largest;
}

struct NamedScene
{
  std::string Name;
  ComponentScene (*Make)();
};

std::ostream& operator<<(std::ostream& stream, const NamedScene& scene)
{
  return stream << scene.Name;
}

class RayCasterComponents : public testing::TestWithParam<NamedScene>
{
};

TEST_P(RayCasterComponents, MatchSmallSteps)
{
  const ComponentScene scene = GetParam().Make();
  const std::vector<double> expected = RenderReference(scene);
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.5);
  VolumeScene volume = MakeVolume(scene);
  const RayPicture picture = Cast(volume, scene.Rays);
  EXPECT_LE(FindLargestError(picture.Colors, expected), ErrorGoal);
  EXPECT_GE(picture.Statistics.ErrorEstimate, 0);
  EXPECT_LE(picture.Statistics.ErrorEstimate, ErrorGoal);

  // Rays that go on to their ends, to the rounding of single precision.
  RayCastOptions exact;
  exact.MaximumError = 0;
  EXPECT_LE(FindLargestError(Cast(volume, scene.Rays, exact).Colors, expected), ExactGoal);

  RayCastOptions portable;
  portable.Kernels = InstructionSet::Generic;
  EXPECT_LE(FindLargestError(Cast(volume, scene.Rays, portable).Colors, expected), ErrorGoal);
  RayCastOptions imaginary;
  imaginary.ReentryBy = Reentry::Imaginary;
  EXPECT_LE(FindLargestError(Cast(volume, scene.Rays, imaginary).Colors, expected), ErrorGoal);
  ForEachThreadCount([&] { EXPECT_EQ(Cast(volume, scene.Rays).Colors, picture.Colors); });
}

INSTANTIATE_TEST_SUITE_P(Scenes, RayCasterComponents,
  testing::Values(NamedScene{ "TwoIndependent", [] { return MakeScene(2, false, 8); } },
    NamedScene{ "FourIndependent", [] { return MakeScene(4, false, 4); } },
    NamedScene{ "DenseIndependent", [] { return MakeScene(3, false, 300); } },
    NamedScene{ "ThinIndependent", [] { return MakeScene(3, false, 0.5); } },
    NamedScene{ "TwoDependent", [] { return MakeScene(2, true, 20); } },
    NamedScene{ "FourDependent", [] { return MakeScene(4, true, 20); } },
    NamedScene{ "Limited", [] { return Limited(MakeScene(2, false, 20)); } },
    NamedScene{ "OfCells", [] { return OfCells(MakeScene(3, false, 8)); } },
    NamedScene{ "DependentOfCells", [] { return OfCells(MakeScene(2, true, 8)); } }),
  [](const auto& info) { return info.param.Name; });

/// Nodes at whole numbers, steps at some of them, nothing between others.
TransferFunction MakeRandomFunction(std::mt19937& random, double largestAttenuation)
{
  const auto draw = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const auto make = [&]
  {
    TransferFunction::Value value = { { draw(), draw(), draw() }, 0 };
    value.Attenuation = draw() < 0.4 ? 0 : largestAttenuation * draw();
    return value;
  };
  TransferFunction function;
  for (int scalar = 0; scalar <= LargestScalar; ++scalar)
  {
    const TransferFunction::Value left = make();
    function.Nodes.push_back({ static_cast<double>(scalar), left, draw() < 0.5 ? left : make() });
  }
  return function;
}

TEST(RayCasterComponentsBehavior, ScalarsAtNodesAreInOneInterval)
{
  // Scalars are at nodes at all points: in many cells all along, in others at both ends.
  constexpr int Scenes = 24;
  for (int i = 0; i < Scenes; ++i)
  {
    SCOPED_TRACE(i);
    std::mt19937 random(i);
    ComponentScene scene;
    scene.Rays.Mesh = MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, i + 1);
    scene.Rays.Grid = MakePerspectiveGrid(
      { 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, ImageSize / 2, ImageSize / 2);
    scene.Components.Dependent = i % 2 != 0;
    const int components = 2 + i % 3;
    const double largestAttenuation = std::pow(10., i % 4);
    for (int c = 0; c < components; ++c)
    {
      scene.Scalars.emplace_back();
      std::uniform_int_distribution<int> draw(0, i % 5 == 0 ? 1 : LargestScalar);
      for (std::size_t p = 0; p < scene.Rays.Mesh.GetNumberOfPoints(); ++p)
      {
        scene.Scalars.back().push_back(draw(random));
      }
      const TransferFunction function = MakeRandomFunction(random, largestAttenuation);
      scene.Components.Functions.push_back(
        scene.Components.Dependent ? Keep(function, c + 1 < components) : function);
    }
    scene.Rays.Scalars = scene.Scalars[0];
    scene.Rays.Function = scene.Components.Functions[0];
    VolumeScene volume = MakeVolume(scene);
    EXPECT_LE(FindLargestError(Cast(volume, scene.Rays).Colors, RenderReference(scene)), ErrorGoal);
  }
}

TEST(RayCasterComponentsBehavior, OneOfThemAloneIsTheScalar)
{
  // What the others add is nothing: the picture is that of the first one, in the other kernel.
  ComponentScene scene = MakeScene(2, false, 20);
  scene.Components.Functions[1] = MakeConstantFunction(0, { 1, 1, 1 });
  VolumeScene several = MakeVolume(scene);
  VolumeScene one = scene.Rays.MakeVolumeScene();
  RayCastOptions options;
  options.Arithmetic = Precision::Double;
  const RayPicture expected = Cast(one, scene.Rays, options);
  const RayPicture picture = Cast(several, scene.Rays);
  constexpr double Rounding = 2e-6; // of the weights of segments, and of adding them up
  for (std::size_t i = 0; i < expected.Colors.size(); ++i)
  {
    ASSERT_NEAR(picture.Colors[i], expected.Colors[i], Rounding);
  }
  EXPECT_EQ(picture.Depths, expected.Depths);
  // And back.
  several.Optics.SetComponents({});
  EXPECT_EQ(Cast(several, scene.Rays, options).Colors, expected.Colors);
}

TEST(RayCasterComponentsBehavior, ScalarsThatAreNoNumbersAreEmpty)
{
  ComponentScene scene = MakeScene(2, false, 20);
  const std::size_t middle = scene.Scalars[1].size() / 2;
  scene.Scalars[1][middle] = std::numeric_limits<double>::quiet_NaN();
  scene.Rays.Scalars[middle] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> expected = RenderReference(scene);
  VolumeScene volume = MakeVolume(scene);
  EXPECT_LE(FindLargestError(Cast(volume, scene.Rays).Colors, expected), ErrorGoal);
  EXPECT_GT(volume.Mesh.GetNumberOfBlankCells(), 0);
}

TEST(RayCasterComponentsBehavior, RefusesOtherNumbers)
{
  ComponentScene scene = MakeScene(2, false, 20);
  VolumeScene volume = MakeVolume(scene);
  volume.Mesh.SetOtherScalars({});
  EXPECT_THROW(Cast(volume, scene.Rays), std::invalid_argument);
  EXPECT_THROW(volume.Mesh.SetOtherScalars({ { 1, 2, 3 } }), std::invalid_argument);
  scene.Components.Functions.resize(1);
  EXPECT_THROW(volume.Optics.SetComponents(scene.Components), std::invalid_argument);
}

} // namespace
