// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Cached.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace tetralux
{
namespace
{

TEST(CacheKey, ComparesBitsInOrder)
{
  constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CacheKey::Of(1, NotANumber), CacheKey::Of(1, NotANumber));
  EXPECT_NE(CacheKey::Of(1, 2), CacheKey::Of(2, 1));
  EXPECT_NE(CacheKey::Of(0.), CacheKey::Of(-0.));
  EXPECT_NE(CacheKey::Of(1), CacheKey::Of(1, 0));
  const int a = 0;
  const int b = 0;
  EXPECT_EQ(CacheKey::Of(&a), CacheKey::Of(&a));
  EXPECT_NE(CacheKey::Of(&a), CacheKey::Of(&b));
}

TEST(Cached, BuildsOnceForAKey)
{
  Cached<int> cached;
  EXPECT_EQ(cached.GetVersion(), 0u);
  EXPECT_EQ(cached.Get(), 0);
  int builds = 0;
  const auto build = [&builds] { return ++builds; };
  // An empty key is a key, too.
  EXPECT_TRUE(cached.Update(CacheKey(), build));
  EXPECT_FALSE(cached.Update(CacheKey(), build));
  const std::uint64_t first = cached.GetVersion();
  EXPECT_NE(first, 0u);
  EXPECT_TRUE(cached.Update(CacheKey::Of(1.5), build));
  EXPECT_EQ(cached.Get(), 2);
  EXPECT_NE(cached.GetVersion(), first);
  // An earlier key is not remembered.
  EXPECT_TRUE(cached.Update(CacheKey(), build));
  EXPECT_EQ(builds, 3);
}

TEST(Cached, IsEmptyAfterAFailedBuild)
{
  Cached<int> cached;
  cached.Update(CacheKey::Of(1), [] { return 7; });
  EXPECT_THROW(cached.Update(CacheKey::Of(2), []() -> int { throw std::runtime_error("no"); }),
    std::runtime_error);
  EXPECT_EQ(cached.Get(), 0);
  EXPECT_EQ(cached.GetVersion(), 0u);
  EXPECT_TRUE(cached.Update(CacheKey::Of(1), [] { return 8; }));
}

TEST(Cached, VersionsAreUniqueAmongCaches)
{
  Cached<int> a;
  Cached<int> b;
  a.Update(CacheKey::Of(1), [] { return 1; });
  b.Update(CacheKey::Of(1), [] { return 1; });
  EXPECT_NE(a.GetVersion(), b.GetVersion());
}

} // namespace
} // namespace tetralux
