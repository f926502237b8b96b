// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CountingSort_h
#define tetralux_CountingSort_h

#include <algorithm>
#include <cstdint>
#include <memory>

#include <omp.h>

namespace tetralux
{

/// Memory whose elements start undefined, so that the threads which fill it are the first to touch
/// it.
template <class T>
std::unique_ptr<T[]> NewArray(std::int64_t size)
{
  return std::unique_ptr<T[]>(new T[size]);
}

/// Calls body(part, begin, end) in parallel for equal contiguous parts of [0, size).
template <class Body>
void ForEachPart(int numberOfParts, std::int64_t size, const Body& body)
{
#pragma omp parallel for schedule(static, 1)
  for (int part = 0; part < numberOfParts; ++part)
  {
    body(part, size * part / numberOfParts, size * (part + 1) / numberOfParts);
  }
}

/// Items grouped by a small integer: bucket b holds Items[Begin[b]] ... Items[Begin[b + 1] - 1].
struct Buckets
{
  std::unique_ptr<std::int32_t[]> Begin;
  std::unique_ptr<std::int32_t[]> Items;
};

/// Groups the items 0 ... numberOfItems - 1, at most 2^31 - 1, by bucketOf(item), which is called
/// twice for each item and must be in 0 ... numberOfBuckets - 1. Items of a bucket are ascending,
/// whatever the number of threads.
template <class BucketOf>
Buckets SortIntoBuckets(
  std::int64_t numberOfItems, std::int64_t numberOfBuckets, const BucketOf& bucketOf)
{
  // Every part counts for itself; the parts are limited so that the counts stay in proportion to
  // the items.
  const int numberOfParts = static_cast<int>(std::min<std::int64_t>(
    omp_get_max_threads(), 1 + 2 * numberOfItems / std::max<std::int64_t>(1, numberOfBuckets)));
  auto next = NewArray<std::int32_t>(numberOfParts * numberOfBuckets);
  ForEachPart(numberOfParts, numberOfItems,
    [&](int part, std::int64_t begin, std::int64_t end)
    {
      std::int32_t* counts = next.get() + part * numberOfBuckets;
      std::fill_n(counts, numberOfBuckets, 0);
      for (std::int64_t item = begin; item < end; ++item)
      {
        ++counts[bucketOf(item)];
      }
    });

  Buckets buckets{ NewArray<std::int32_t>(numberOfBuckets + 1),
    NewArray<std::int32_t>(numberOfItems) };
  std::int32_t position = 0;
  for (std::int64_t bucket = 0; bucket < numberOfBuckets; ++bucket)
  {
    buckets.Begin[bucket] = position;
    for (int part = 0; part < numberOfParts; ++part)
    {
      std::int32_t& count = next[part * numberOfBuckets + bucket];
      position += count;
      count = position - count;
    }
  }
  buckets.Begin[numberOfBuckets] = position;

  ForEachPart(numberOfParts, numberOfItems,
    [&](int part, std::int64_t begin, std::int64_t end)
    {
      std::int32_t* positions = next.get() + part * numberOfBuckets;
      for (std::int64_t item = begin; item < end; ++item)
      {
        buckets.Items[positions[bucketOf(item)]++] = static_cast<std::int32_t>(item);
      }
    });
  return buckets;
}

} // namespace tetralux

#endif
