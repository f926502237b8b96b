// SPDX-License-Identifier: BSD-3-Clause

// Active in every build.
#define TETRALUX_CHECKS
#include "Base/Check.h"

#include <gtest/gtest.h>

namespace
{

TEST(CheckDeathTest, AFalseConditionAborts)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const int index = 7;
  EXPECT_DEATH(TETRALUX_CHECK(index < 5), "TestCheck.cxx:[0-9]+: check failed: index < 5");
}

TEST(Check, ATrueConditionIsEvaluatedOnce)
{
  int evaluations = 0;
  TETRALUX_CHECK(++evaluations > 0);
  EXPECT_EQ(evaluations, 1);
}

} // namespace
