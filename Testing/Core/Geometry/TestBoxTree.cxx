// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/BoxTree.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace
{

using tetralux::Box;

/// Boxes with corners on a small lattice, so that many only touch, and some are flat.
Box DrawBox(std::mt19937_64& random)
{
  Box box;
  for (int a = 0; a < 3; ++a)
  {
    box.Low[a] = static_cast<double>(random() % 12);
    box.High[a] = box.Low[a] + static_cast<double>(random() % 4);
  }
  return box;
}

bool Meet(const Box& box0, const Box& box1)
{
  for (int a = 0; a < 3; ++a)
  {
    if (std::max(box0.Low[a], box1.Low[a]) > std::min(box0.High[a], box1.High[a]))
    {
      return false;
    }
  }
  return true;
}

} // namespace

TEST(BoxTree, FindsWhatBruteForceFinds)
{
  std::mt19937_64 random(1);
  tetralux::BoxTree tree;
  struct Entry
  {
    Box Bounds;
    std::int32_t Leaf;
  };
  std::map<std::int32_t, Entry> entries;
  std::int32_t number = 0;
  for (int step = 0; step < 3000; ++step)
  {
    // Grows, then shrinks until nothing is left, then grows again.
    const bool isGrowing = step % 1500 < 700;
    if (entries.empty() || random() % 8 < (isGrowing ? 6u : 1u))
    {
      const Box box = DrawBox(random);
      entries[number] = { box, tree.Insert(box, number) };
      ++number;
    }
    else
    {
      auto entry = entries.begin();
      std::advance(entry, static_cast<std::ptrdiff_t>(random() % entries.size()));
      tree.Remove(entry->second.Leaf);
      entries.erase(entry);
    }
    const Box query = DrawBox(random);
    std::multiset<std::int32_t> expected;
    for (const auto& [id, entry] : entries)
    {
      if (Meet(entry.Bounds, query))
      {
        expected.insert(id);
      }
    }
    std::multiset<std::int32_t> found;
    EXPECT_TRUE(tree.ForEach(query,
      [&found](std::int32_t id)
      {
        found.insert(id);
        return true;
      }));
    ASSERT_EQ(found, expected);
  }
}

TEST(BoxTree, EndsAtTheFirstRefusal)
{
  tetralux::BoxTree tree;
  const Box box = { { 0, 0, 0 }, { 1, 1, 1 } };
  EXPECT_TRUE(tree.ForEach(box, [](std::int32_t) { return false; })); // nothing to refuse
  for (int i = 0; i < 5; ++i)
  {
    tree.Insert(box, i);
  }
  int calls = 0;
  EXPECT_FALSE(tree.ForEach(box, [&calls](std::int32_t) { return ++calls < 3; }));
  EXPECT_EQ(calls, 3);
}

TEST(BoxTree, Boxes)
{
  const Box box = { { 0, 0, 0 }, { 1, 2, 3 } };
  const Box beside = { { 1, 2, 3 }, { 2, 2, 4 } }; // a corner in common
  EXPECT_TRUE(box.Meets(beside));
  for (int a = 0; a < 3; ++a)
  {
    Box apart = beside;
    apart.Low[a] += 0.5;
    apart.High[a] += 0.5;
    EXPECT_FALSE(box.Meets(apart));
    EXPECT_FALSE(apart.Meets(box));
  }
  const Box joined = box.Join(beside);
  EXPECT_EQ(joined.Low, box.Low);
  EXPECT_EQ(joined.High, beside.High);
  EXPECT_EQ(joined.GetSize(), 2 + 2 + 4);
}
