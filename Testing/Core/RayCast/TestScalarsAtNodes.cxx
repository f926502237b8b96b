// SPDX-License-Identifier: BSD-3-Clause

// Scalars that are a node of the transfer function, or are beside it by less than single precision
// tells apart. Nodes are numbers of single precision, and scalars along rays may be of double.

#include "RayScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

namespace
{

using namespace tetralux;

constexpr int ImageSize = 16;
constexpr double Attenuation = 1; ///< per world unit, everywhere

/// An integrator by what chooses it, a precision and kernels.
struct NodeCase
{
  OpticalModel Model;
  bool OneColor; ///< the optical depth alone decides
  Precision Arithmetic;
  bool Portable;
};

std::ostream& operator<<(std::ostream& stream, const NodeCase& c)
{
  return stream << "model " << static_cast<int>(c.Model) << ", one colour " << c.OneColor
                << ", precision " << static_cast<int>(c.Arithmetic) << ", portable " << c.Portable;
}

/// Rays through a box of length 1. Scalars are around a node, within a few numbers of single
/// precision, and attenuation is the same on both sides of it.
RayScene MakeNodeScene(const NodeCase& c)
{
  constexpr double Node = 0.3;
  constexpr double Spread = 2e-7; // seven numbers of single precision between 0 and 1
  RayScene scene;
  scene.Mesh = MakeBox(6, 6, 6, { 0, 0, 0 }, { 1, 1, 1 }, 0.15);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> beside(-Spread, Spread);
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    scene.Scalars.push_back(Node + beside(generator));
  }
  const TransferFunction::Value value = { { 1, 1, 1 }, Attenuation };
  const TransferFunction::Value other = { { 1, 1, c.OneColor ? 1. : 0. }, Attenuation };
  scene.Function.Nodes = { { 0, value, value }, { Node, value, value }, { 1, other, other } };
  scene.Model = c.Model;
  scene.Grid =
    MakeParallelGrid({ 0.5, 0.5, 5 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.3, ImageSize, ImageSize);
  return scene;
}

class ScalarsAtNodes : public testing::TestWithParam<NodeCase>
{
};

TEST_P(ScalarsAtNodes, CountEachLengthOnce)
{
  const NodeCase& c = GetParam();
  const RayScene scene = MakeNodeScene(c);
  VolumeScene volume = scene.MakeVolumeScene();
  RayCastOptions options;
  options.MaximumError = 0; // rays go on to their ends
  options.Arithmetic = c.Arithmetic;
  options.Kernels = ChooseKernels(c.Portable);
  const RayPicture picture = Cast(volume, scene, options);

  // Green is the same everywhere.
  const bool emission = c.Model == OpticalModel::EmissionOnly;
  const int channel = emission ? 1 : 3;
  const double exact = emission ? Attenuation : -std::expm1(-Attenuation);
  // Cells meet at coordinates that are rounded: some ten cells a ray, each by 2^-24 of the box at
  // most, and sums by as much.
  constexpr double Rounding = 4e-6;
  double largest = 0;
  for (std::size_t p = 0; p < picture.Depths.size(); ++p)
  {
    largest = std::max(largest, std::abs(picture.Colors[4 * p + channel] - exact));
  }
  EXPECT_LE(largest, Rounding);
}

std::vector<NodeCase> MakeNodeCases()
{
  std::vector<NodeCase> cases;
  for (const bool portable : { false, true })
  {
    for (const Precision precision : { Precision::Single, Precision::Double })
    {
      cases.push_back({ OpticalModel::EmissionAbsorption, false, precision, portable });
      cases.push_back({ OpticalModel::EmissionAbsorption, true, precision, portable });
      cases.push_back({ OpticalModel::EmissionOnly, false, precision, portable });
      cases.push_back({ OpticalModel::AbsorptionOnly, false, precision, portable });
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(All, ScalarsAtNodes, testing::ValuesIn(MakeNodeCases()));

} // namespace
