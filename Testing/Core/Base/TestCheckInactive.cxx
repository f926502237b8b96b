// SPDX-License-Identifier: BSD-3-Clause

// Inactive in every build.
#undef TETRALUX_CHECKS
#include "Base/Check.h"

#include <gtest/gtest.h>

namespace
{

TEST(Check, AnInactiveConditionIsNotEvaluated)
{
  int evaluations = 0;
  TETRALUX_CHECK(++evaluations < 0);
  EXPECT_EQ(evaluations, 0);
}

} // namespace
