// SPDX-License-Identifier: BSD-3-Clause
// Tables that are chosen: right enough, small, and of what is given.
#include "ModelRays.h"
#include "PreIntegration/PreIntegrationError.h"
#include "PreIntegration/TableChoice.h"
#include "SampleFunctions.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <random>
#include <vector>

namespace tetralux
{
namespace
{

/// Of which a segment may have so many that few rays are integrated in a moment.
constexpr int ManyNodes = 20000;

TEST(TableChoice, ChosenTablesMeetTheirGoal)
{
  std::mt19937_64 generator(15);
  const TransferFunction functions[] = { MakeNeedle(0.4, 0.02, 30),
    MakeRandomFunction(generator, 12, 2, false) };
  int tables = 0;
  for (const TransferFunction& function : functions)
  {
    std::size_t bytes = 0;
    for (const double maximumError : { 1e-1, 1e-2, 1e-3, 1e-4 })
    {
      TableGoal goal;
      goal.MaximumError = maximumError;
      goal.MaximumBytes = std::size_t{ 1 } << 23;
      goal.LookupCost = 0.1;
      RayModel model;
      model.PathLength = 5;
      model.LongestSegment = goal.LongestSegment = 0.5;
      goal.Rays = std::make_shared<RaySample>(DrawModelRays(model));
      const TableChoice choice = ChoosePreIntegrationTable(function, goal);
      EXPECT_FALSE(choice.Reason.empty());
      if (!choice.Table)
      {
        EXPECT_LE(maximumError, 1e-2); // only where it is hard
        continue;
      }
      ++tables;
      const PreIntegrationTable& table = *choice.Table;
      EXPECT_LE(table.GetNumberOfBytes(), goal.MaximumBytes);
      EXPECT_GE(table.GetNumberOfBytes(), bytes);
      bytes = table.GetNumberOfBytes();
      EXPECT_NEAR(EstimatePictureError(function, table, *goal.Rays), choice.PictureError, 2e-5);
      EXPECT_LE(choice.PictureError, maximumError);
    }
  }
  EXPECT_GE(tables, 3);
}

/// What tables are measured by does not grow with the function without a bound.
TEST(TableChoice, MeasuresFewRaysWhereThereAreManyNodes)
{
  std::mt19937_64 generator(3);
  TableGoal goal;
  goal.MaximumError = 1; // any table is right enough
  goal.ScalarSize = 32;
  goal.LengthSize = 8;
  constexpr std::size_t NumberOfRays = 512;
  constexpr int SegmentsPerRay = 10;
  RaySample sample;
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t i = 0; i < NumberOfRays; ++i)
  {
    std::vector<RaySegment> ray;
    for (int k = 0; k < SegmentsPerRay; ++k)
    {
      ray.push_back({ unit(generator), unit(generator), 0.1 });
    }
    sample.Rays.push_back(ray);
  }
  goal.Rays = std::make_shared<RaySample>(sample);
  EXPECT_EQ(CountTableRays(MakeRandomFunction(generator, 100, 2, false), sample), NumberOfRays);
  const TransferFunction many = MakeRandomFunction(generator, ManyNodes, 2, false);
  EXPECT_LT(CountTableRays(many, sample), NumberOfRays);
  EXPECT_GE(CountTableRays(many, sample), NumberOfRays / 2);
  EXPECT_TRUE(ChoosePreIntegrationTable(many, goal).Table);
  const TransferFunction most = MakeRandomFunction(generator, 20 * ManyNodes, 2, false);
  const TableChoice none = ChoosePreIntegrationTable(most, goal);
  EXPECT_FALSE(none.Table);
  EXPECT_EQ(none.Reason, "closed form: a segment has too many pieces to find a table that is right")
    << "none is tried";
}

/// The caller may know of fewer pieces than the function has.
TEST(TableChoice, TakesThePiecesThatItIsGiven)
{
  std::mt19937_64 generator(3);
  const TransferFunction function = MakeRandomFunction(generator, 100, 2, false);
  TableGoal goal;
  goal.MaximumError = 1; // any table is right enough
  goal.Rays = std::make_shared<RaySample>(DrawModelRays({}));
  EXPECT_TRUE(ChoosePreIntegrationTable(function, goal).Table);
  goal.PiecesPerSegment = goal.LookupCost;
  EXPECT_FALSE(ChoosePreIntegrationTable(function, goal).Table);
}

TEST(TableChoice, KeepsToWhatIsGiven)
{
  const TransferFunction function = MakeNeedle(0.4, 0.1, 5);
  TableGoal goal;
  goal.MaximumError = 1; // any table is right enough
  goal.LookupCost = 0;
  goal.Rays = std::make_shared<RaySample>(DrawModelRays({}));
  goal.ScalarSize = 50;
  goal.LengthSize = 20;
  goal.AnyScale = goal.AnyAxis = goal.AnyFormat = false;
  goal.Scale = LengthScale::Linear;
  goal.Axis = ScalarAxis::Uniform;
  goal.Format = TexelFormat::UNorm8;
  const TableChoice choice = ChoosePreIntegrationTable(function, goal);
  ASSERT_TRUE(choice.Table);
  EXPECT_EQ(choice.Table->Settings.ScalarSize, 50);
  EXPECT_EQ(choice.Table->Settings.LengthSize, 20);
  EXPECT_EQ(choice.Table->Settings.Axis, ScalarAxis::Uniform);
  EXPECT_EQ(choice.Table->Settings.Format, TexelFormat::UNorm8);
  // One ramp is one piece: never worth a table.
  goal.LookupCost = 3;
  EXPECT_FALSE(ChoosePreIntegrationTable({ { function.Nodes[0] } }, goal).Table);
}

} // namespace
} // namespace tetralux
