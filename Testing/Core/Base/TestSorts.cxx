// SPDX-License-Identifier: BSD-3-Clause
#include "Base/CountingSort.h"
#include "Base/DisjointSets.h"
#include "Base/RadixSort.h"

#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace
{

/// What SortIntoBuckets promises, by a stable sort.
void CheckBuckets(const std::vector<std::int32_t>& keys, std::int64_t numberOfBuckets)
{
  const auto size = static_cast<std::int64_t>(keys.size());
  const tetralux::Buckets buckets = tetralux::SortIntoBuckets(
    size, numberOfBuckets, [&keys](std::int64_t item) { return keys[item]; });
  std::vector<std::int32_t> expected(keys.size());
  std::iota(expected.begin(), expected.end(), 0);
  std::stable_sort(expected.begin(), expected.end(),
    [&keys](std::int32_t a, std::int32_t b) { return keys[a] < keys[b]; });
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), buckets.Items.get()));
  std::int64_t begin = 0;
  for (std::int64_t b = 0; b <= numberOfBuckets; ++b)
  {
    while (begin < size && keys[expected[begin]] < b)
    {
      ++begin;
    }
    ASSERT_EQ(buckets.Begin[b], begin);
  }
}

std::vector<tetralux::KeyedItem> MakeItems(const std::vector<std::uint32_t>& keys)
{
  std::vector<tetralux::KeyedItem> items;
  for (const std::uint32_t key : keys)
  {
    items.push_back({ key, static_cast<std::int32_t>(items.size()) });
  }
  return items;
}

void CheckSortByKey(const std::vector<std::uint32_t>& keys)
{
  std::vector<tetralux::KeyedItem> expected = MakeItems(keys);
  std::stable_sort(
    expected.begin(), expected.end(), [](const auto& a, const auto& b) { return a.Key < b.Key; });
  std::vector<tetralux::KeyedItem> items = MakeItems(keys);
  std::vector<tetralux::KeyedItem> buffer;
  tetralux::SortByKey(items, buffer);
  ASSERT_EQ(items.size(), expected.size());
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    ASSERT_EQ(items[i].Key, expected[i].Key);
    ASSERT_EQ(items[i].Item, expected[i].Item);
  }
}

} // namespace

TEST(CountingSort, AsAStableSort)
{
  std::mt19937_64 random(1);
  ForEachThreadCount(
    [&random]
    {
      for (const auto& [size, buckets] : { std::pair(0, 5), std::pair(1, 1), std::pair(7, 100),
             std::pair(1000, 1), std::pair(5000, 7), std::pair(20000, 20000) })
      {
        SCOPED_TRACE(testing::Message() << size << " items, " << buckets << " buckets");
        std::vector<std::int32_t> keys(size);
        for (std::int32_t& key : keys)
        {
          key = static_cast<std::int32_t>(random() % buckets);
        }
        CheckBuckets(keys, buckets);
      }
    });
}

TEST(CountingSort, PartsCoverEachItemOnce)
{
  for (const int parts : { 1, 2, 3, 7 })
  {
    for (const std::int64_t size : { 0, 1, 6, 100 })
    {
      std::vector<int> count(size, 0);
      tetralux::ForEachPart(parts, size,
        [&count](int, std::int64_t begin, std::int64_t end)
        {
          for (std::int64_t i = begin; i < end; ++i)
          {
            ++count[i]; // parts are disjoint, so that no two threads meet
          }
        });
      EXPECT_EQ(std::count(count.begin(), count.end(), 1), size);
    }
  }
}

TEST(RadixSort, AsAStableSort)
{
  std::mt19937_64 random(2);
  ForEachThreadCount(
    [&random]
    {
      // The sizes cover one part and several; the masks keys that have digits in common.
      for (const std::size_t size : { 0u, 1u, 2u, 1000u, 100000u })
      {
        for (const std::uint32_t mask :
          { 0xffffffffU, 0x7ffU, 0x3ff800U, 0xffc00000U, 0x80000001U, 0U })
        {
          SCOPED_TRACE(testing::Message() << size << " items, mask " << mask);
          std::vector<std::uint32_t> keys(size);
          for (std::uint32_t& key : keys)
          {
            key = 0x12345678U ^ (static_cast<std::uint32_t>(random()) & mask);
          }
          CheckSortByKey(keys);
        }
      }
    });
}

TEST(RadixSort, SortableBitsHaveTheOrderOfFloats)
{
  using Limits = std::numeric_limits<float>;
  std::vector<float> values = { -Limits::infinity(), Limits::lowest(), -1, -Limits::min(),
    -Limits::denorm_min(), 0, Limits::denorm_min(), Limits::min(), 1, Limits::max(),
    Limits::infinity() };
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i)
  {
    const auto bits = static_cast<std::uint32_t>(random());
    float value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isnan(value))
    {
      values.push_back(value);
    }
  }
  for (const float a : values)
  {
    for (const float b : values)
    {
      EXPECT_EQ(a < b, tetralux::GetSortableBits(a) < tetralux::GetSortableBits(b));
    }
  }
  EXPECT_LT(tetralux::GetSortableBits(-0.f), tetralux::GetSortableBits(0.f));
}

TEST(DisjointSets, AsLabels)
{
  constexpr int size = 200;
  std::mt19937_64 random(4);
  tetralux::DisjointSets sets(size);
  std::vector<std::int32_t> labels(size); // the smallest element of each set
  std::iota(labels.begin(), labels.end(), 0);
  for (int i = 0; i < 300; ++i)
  {
    const auto a = static_cast<std::int32_t>(random() % size);
    const auto b = static_cast<std::int32_t>(random() % size);
    const auto [low, high] = std::minmax({ labels[a], labels[b] });
    EXPECT_EQ(sets.Unite(a, b), low != high);
    std::replace(labels.begin(), labels.end(), high, low);
    for (std::int32_t element = 0; element < size; ++element)
    {
      ASSERT_EQ(sets.Find(element), labels[element]);
    }
  }
}
