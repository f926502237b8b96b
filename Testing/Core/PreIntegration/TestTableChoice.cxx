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

namespace tetralux
{
namespace
{

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
      EXPECT_GT(choice.PiecesPerSegment, 1);
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
