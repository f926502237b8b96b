// SPDX-License-Identifier: BSD-3-Clause
#include "Integral/IntegrationPlan.h"
#include "ReferenceIntegral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace tetralux;

namespace
{

using Value = TransferFunction::Value;

const double UnitRange[2] = { 0, 1 };

const OpticalModel Models[] = { OpticalModel::EmissionAbsorption, OpticalModel::EmissionOnly,
  OpticalModel::AbsorptionOnly, OpticalModel::MaximumIntensity };

/// Up, a step down, and up again, in several colours.
TransferFunction MakeFunction()
{
  const Value a{ { 1, 0, 0.2 }, 0.5 }, b{ { 0, 1, 0.4 }, 3 }, c{ { 0.5, 0.5, 0.1 }, 1 };
  return { { { 0, a, a }, { 0.3, b, c }, { 0.7, c, c }, { 1, b, b } } };
}

} // namespace

TEST(IntegrationPlan, EachModelHasItsTable)
{
  const TransferFunction function = MakeFunction();
  const TableShape shapes[] = { TableShape::ScalarsLength, TableShape::Scalars, TableShape::Scalars,
    TableShape::Scalar };
  for (int k = 0; k < 4; ++k)
  {
    const IntegrationPlan plan = MakeIntegrationPlan(Models[k], function, UnitRange);
    EXPECT_EQ(plan.Table, shapes[k]) << plan.Reason;
    EXPECT_FALSE(plan.Transparent);
    EXPECT_FALSE(plan.ConstantColor);
    EXPECT_EQ(plan.LargestNumberOfPieces, 3);
  }
}

TEST(IntegrationPlan, ConstantColorNeedsNoColorTable)
{
  TransferFunction function = MakeFunction();
  for (TransferFunction::Node& node : function.Nodes)
  {
    node.Left = { { 0.1, 0.2, 0.3 }, node.Left.Attenuation };
    node.Right = { { 0.1, 0.2, 0.3 }, node.Right.Attenuation };
  }
  IntegrationPlan plan = MakeIntegrationPlan(OpticalModel::EmissionAbsorption, function, UnitRange);
  EXPECT_EQ(plan.Table, TableShape::Scalars);
  EXPECT_TRUE(plan.ConstantColor);
  EXPECT_EQ(plan.Color[1], 0.2);

  // Another colour where nothing is seen does not count.
  const Value nothing{ { 0.9, 0.9, 0.9 }, 0 };
  function.Nodes.push_back({ 1.5, { { 0.1, 0.2, 0.3 }, 3 }, nothing });
  function.Nodes.push_back({ 2, nothing, nothing });
  const double range[2] = { 0, 2 };
  plan = MakeIntegrationPlan(OpticalModel::EmissionAbsorption, function, range);
  EXPECT_TRUE(plan.ConstantColor);
  EXPECT_EQ(plan.Table, TableShape::Scalars);
}

TEST(IntegrationPlan, OneRampNeedsNoTable)
{
  const TransferFunction function = MakeFunction();
  const double ranges[][2] = { { 0, 0.2 }, { 0.31, 0.7 }, { 0.7, 1 }, { 1, 5 }, { -3, -1 },
    { 0.5, 0.5 } };
  for (const auto& range : ranges)
  {
    for (const OpticalModel model : Models)
    {
      const IntegrationPlan plan = MakeIntegrationPlan(model, function, range);
      EXPECT_EQ(plan.Table, TableShape::None) << range[0] << " " << range[1];
      EXPECT_EQ(plan.LargestNumberOfPieces, 1);
    }
  }
  // The end of the range is on the far side of a step.
  const double step[2] = { 0.1, 0.3 };
  EXPECT_EQ(
    MakeIntegrationPlan(OpticalModel::EmissionOnly, function, step).Table, TableShape::Scalars);
}

TEST(IntegrationPlan, NothingToSeeIsNoticed)
{
  TransferFunction function = MakeFunction();
  const Value nothing{ { 1, 1, 1 }, 0 };
  function.Nodes.push_back({ 2, nothing, nothing });
  const double beyond[2] = { 2, 4 };
  for (const OpticalModel model : Models)
  {
    EXPECT_TRUE(MakeIntegrationPlan(model, function, beyond).Transparent);
    EXPECT_EQ(MakeIntegrationPlan(model, function, beyond).Table, TableShape::None);
  }
}

TEST(IntegrationPlan, SurfacesCountWhereTheyAre)
{
  const std::vector<Isosurface> surfaces = { { 0.2, { 1, 0, 0 }, 0.5f }, { 0.4, { 0, 1, 0 }, 0 },
    { 0.9, { 0, 0, 1 }, 1 } };
  const auto plan = [&](double lo, double hi)
  {
    const double range[2] = { lo, hi };
    return MakeIntegrationPlan(OpticalModel::Isosurfaces, {}, range, surfaces);
  };
  EXPECT_EQ(plan(0, 1).Table, TableShape::Scalars);
  EXPECT_EQ(plan(0, 0.5).Table, TableShape::None);
  EXPECT_FALSE(plan(0, 0.5).Transparent);
  EXPECT_TRUE(plan(0.3, 0.5).Transparent); // only one that can't be seen
}

TEST(IntegrationPlan, MeansAreExact)
{
  const TransferFunction function = MakeFunction();
  const double range[2] = { -0.2, 1.3 };
  const ScalarTable table = MakeMeanTable(function, range, 40);
  ASSERT_EQ(table.Shape, TableShape::Scalars);
  ASSERT_EQ(table.Texels.size(), 40u * 40 * 4);
  for (int b = 0; b < 40; ++b)
  {
    for (int f = 0; f < 40; ++f)
    {
      const double sf = table.GetScalar(f), sb = table.GetScalar(b);
      const float* texel = &table.Texels[4 * (40 * b + f)];
      EXPECT_NEAR(texel[3], IntegrateReference(function, sf, sb, 1).OpticalDepth, 1e-6);
      // Thin enough for nothing to hide anything.
      constexpr double Thin = 1e-8;
      const ReferenceSegment thin = IntegrateReference(function, sf, sb, Thin);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(texel[c], thin.Color[c] / Thin, 1e-6);
      }
      EXPECT_EQ(texel[3], table.Texels[4 * (40 * f + b) + 3]);
    }
  }
}

TEST(IntegrationPlan, TransferTableIsTheFunction)
{
  TransferFunction function = MakeFunction();
  function.Nodes[0].Left.Attenuation = function.Nodes[0].Right.Attenuation = 0.25;
  const double range[2] = { 0, 0.2 };
  const ScalarTable table = MakeTransferTable(function, range, 5);
  ASSERT_EQ(table.Texels.size(), 20u);
  EXPECT_NEAR(table.Texels[3], 0.25, 1e-7);
  EXPECT_NEAR(table.Texels[0], 0.25, 1e-7); // premultiplied red
  // At 0.05 opacity is 0.25 + 2.75 / 6, red is 5 / 6.
  EXPECT_NEAR(table.Texels[7], 0.25 + 2.75 / 6, 1e-6);
  EXPECT_NEAR(table.Texels[4], (0.25 + 2.75 / 6) * 5 / 6, 1e-6);
  EXPECT_EQ(table.Texels[19], 1); // an opacity of more than 1
}

TEST(IntegrationPlan, SurfacesAreInOrder)
{
  const std::vector<Isosurface> surfaces = { { 0.2, { 1, 0, 0 }, 0.5f },
    { 0.6, { 0, 1, 0 }, 0.5f } };
  const ScalarTable table = MakeIsosurfaceTable(surfaces, UnitRange, 11);
  const auto texel = [&](int f, int b) { return &table.Texels[4 * (11 * b + f)]; };
  EXPECT_EQ(texel(0, 1)[3], 0);
  EXPECT_FLOAT_EQ(texel(0, 4)[0], 0.5f);
  EXPECT_FLOAT_EQ(texel(0, 10)[0], 0.5f);
  EXPECT_FLOAT_EQ(texel(0, 10)[1], 0.25f);
  EXPECT_FLOAT_EQ(texel(0, 10)[3], 0.75f);
  EXPECT_FLOAT_EQ(texel(10, 0)[0], 0.25f);
  EXPECT_FLOAT_EQ(texel(10, 0)[1], 0.5f);
}

TEST(IntegrationPlan, WrongTablesAreRefused)
{
  const TransferFunction function = MakeFunction();
  const double reversed[2] = { 1, 0 };
  const double infinite[2] = { 0, INFINITY };
  EXPECT_THROW(MakeMeanTable(function, reversed, 10), std::invalid_argument);
  EXPECT_THROW(MakeMeanTable(function, infinite, 10), std::invalid_argument);
  EXPECT_THROW(MakeTransferTable(function, UnitRange, 1), std::invalid_argument);
  EXPECT_THROW(MakeIsosurfaceTable({}, UnitRange, 5000), std::invalid_argument);
}
