// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/FaceTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

using tetralux::FaceTable;

TEST(FaceTable, AsAMap)
{
  std::mt19937_64 random(1);
  // From the smallest table, which has to grow, and from a large one.
  for (const std::size_t expectedSize : { 0u, 10000u })
  {
    FaceTable table(expectedSize);
    std::map<std::array<std::int32_t, 3>, std::int32_t> map;
    for (int step = 0; step < 20000; ++step)
    {
      // Few points, so that triangles come back; some with huge ids.
      std::array<std::int32_t, 3> ids;
      for (std::int32_t& id : ids)
      {
        id = static_cast<std::int32_t>(random() % 20);
        id = random() % 4 == 0 ? 2147483647 - id : id;
      }
      std::array<std::int32_t, 3> key = ids;
      std::sort(key.begin(), key.end());
      const auto found = map.find(key);
      ASSERT_EQ(
        table.Find(ids[0], ids[1], ids[2]), found == map.end() ? FaceTable::None : found->second);
      // About as many are taken away as come.
      const auto value = static_cast<std::int32_t>(random() % 1000);
      if (random() % 2 == 0)
      {
        table.Set(ids[1], ids[2], ids[0], FaceTable::None);
        map.erase(key);
      }
      else
      {
        table.Set(ids[2], ids[0], ids[1], value);
        map[key] = value;
      }
    }
    EXPECT_GT(map.size(), 1000u);
    for (const auto& [key, value] : map)
    {
      EXPECT_EQ(table.Find(key[0], key[1], key[2]), value);
    }
  }
}

TEST(FaceTable, IsEmptyAtFirst)
{
  FaceTable table;
  EXPECT_EQ(table.Find(0, 1, 2), FaceTable::None);
  table.Set(0, 1, 2, FaceTable::None);
  EXPECT_EQ(table.Find(0, 1, 2), FaceTable::None);
  table.Set(0, 1, 2, 0);
  EXPECT_EQ(table.Find(2, 0, 1), 0);
  EXPECT_EQ(table.Find(0, 1, 3), FaceTable::None);
}
