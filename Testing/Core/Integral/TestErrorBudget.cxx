// SPDX-License-Identifier: BSD-3-Clause
#include "Integral/ErrorBudget.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tetralux
{
namespace
{

/// Calls check(spending, shares, sum) for all that frames may spend error on.
template <class Check>
void ForEachSpending(const Check& check)
{
  constexpr double MaximumError = 1e-3;
  for (int bits = 0; bits < 32; ++bits)
  {
    const ErrorSpending spending{ (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0,
      (bits & 8) != 0, (bits & 16) != 0 };
    if (spending.Tabulated && spending.LightVaries)
    {
      continue; // where light varies in cells no table is used
    }
    const ErrorBudget budget = MakeErrorBudget(MaximumError, spending);
    check(spending, budget,
      (budget.Functions + budget.Geometry + budget.Rounding + budget.Termination + budget.Table +
        budget.Buffer + budget.Light) /
        MaximumError);
  }
}

TEST(ErrorBudget, SharesAddUpToWhatIsAllowed)
{
  ForEachSpending(
    [](const ErrorSpending& spending, const ErrorBudget& budget, double sum)
    {
      EXPECT_LE(sum, 1 + 1e-15);
      if (spending.EndsEarly)
      {
        EXPECT_DOUBLE_EQ(sum, 1) << "what nobody else takes, rays that end early take";
      }
      EXPECT_GE(std::min({ budget.Functions, budget.Termination, budget.Table, budget.Buffer,
                  budget.Light }),
        0);
      EXPECT_GT(std::min(budget.Geometry, budget.Rounding), 0);
    });
}

TEST(ErrorBudget, WhatIsNotSpentHasNoShare)
{
  ForEachSpending(
    [](const ErrorSpending& spending, const ErrorBudget& budget, double)
    {
      EXPECT_EQ(budget.Table > 0, spending.Tabulated);
      EXPECT_EQ(budget.Buffer > 0, spending.Buffered);
      EXPECT_EQ(budget.Light > 0, spending.LightVaries);
      EXPECT_EQ(budget.Functions > 0, spending.Approximated);
      EXPECT_TRUE(spending.EndsEarly || budget.Termination == 0);
    });
}

TEST(ErrorBudget, ChoicesDoNotChangeTheSharesOfTablesAndFunctions)
{
  ForEachSpending(
    [](const ErrorSpending& spending, const ErrorBudget& budget, double)
    {
      const ErrorBudget table = MakeErrorBudget(1e-3, { false, true, false, false });
      const ErrorBudget functions =
        MakeErrorBudget(1e-3, { false, false, false, true, spending.LightVaries });
      EXPECT_TRUE(!spending.Tabulated || budget.Table == table.Table);
      EXPECT_TRUE(!spending.Approximated || budget.Functions == functions.Functions);
    });
}

TEST(ErrorBudget, RaysGoOnLongerWhereGeometryTakesMore)
{
  const ErrorBudget whole = MakeErrorBudget(1, { true, false, false, false });
  ErrorBudget budget = whole;
  budget.CoverGeometry(0.5 * whole.Geometry);
  EXPECT_EQ(budget.Termination, whole.Termination);
  budget.CoverGeometry(whole.Geometry + 0.125);
  EXPECT_EQ(budget.Geometry, whole.Geometry + 0.125);
  EXPECT_EQ(budget.Termination, whole.Termination - 0.125);
  budget.CoverGeometry(100);
  EXPECT_GT(budget.Termination, 0) << "rays have to end";
  EXPECT_DOUBLE_EQ(budget.Geometry + budget.Termination, whole.Geometry + whole.Termination);
}

} // namespace
} // namespace tetralux
