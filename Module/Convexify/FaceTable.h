// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FaceTable_h
#define tetralux_FaceTable_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// A hash table from triangles, by their three point ids in any order, to one number each.
class FaceTable
{
public:
  static constexpr std::int32_t None = -1;

  /// expectedSize: how many triangles come at the same time; more cost time only.
  explicit FaceTable(std::size_t expectedSize = 0)
  {
    std::size_t capacity = 16;
    while (capacity < 2 * expectedSize)
    {
      capacity *= 2;
    }
    this->Slots.resize(capacity);
  }

  /// The number of a triangle, None where it has none.
  std::int32_t Find(std::int32_t a, std::int32_t b, std::int32_t c) const
  {
    return this->Slots[this->FindSlot(Sort(a, b, c))].Value;
  }

  /// Gives a triangle a number, or takes it away with None.
  void Set(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t value)
  {
    const Key key = Sort(a, b, c);
    std::size_t slot = this->FindSlot(key);
    if (this->Slots[slot].Points[0] == Empty)
    {
      if (value == None)
      {
        return;
      }
      // A taken number leaves its slot behind, until the table grows.
      if (2 * ++this->UsedSlots > this->Slots.size())
      {
        this->Grow();
        slot = this->FindSlot(key);
      }
    }
    this->Slots[slot] = { key, value };
  }

private:
  using Key = std::array<std::int32_t, 3>;
  static constexpr std::int32_t Empty = -1;

  struct Slot
  {
    Key Points = { Empty, Empty, Empty };
    std::int32_t Value = None;
  };

  static Key Sort(std::int32_t a, std::int32_t b, std::int32_t c)
  {
    Key key = { a, b, c };
    std::sort(key.begin(), key.end());
    return key;
  }

  std::size_t FindSlot(const Key& key) const
  {
    // 2^64 divided by the golden ratio spreads neighboring ids.
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u;
    std::uint64_t hash = static_cast<std::uint32_t>(key[0]) * factor;
    hash = (hash ^ hash >> 32 ^ static_cast<std::uint32_t>(key[1])) * factor;
    hash = (hash ^ hash >> 32 ^ static_cast<std::uint32_t>(key[2])) * factor;
    const std::size_t mask = this->Slots.size() - 1;
    std::size_t slot = hash >> 32 & mask;
    while (this->Slots[slot].Points[0] != Empty && this->Slots[slot].Points != key)
    {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  void Grow()
  {
    std::vector<Slot> old = std::move(this->Slots);
    const auto kept = static_cast<std::size_t>(
      std::count_if(old.begin(), old.end(), [](const Slot& slot) { return slot.Value != None; }));
    std::size_t capacity = 16;
    while (capacity < 4 * (kept + 1))
    {
      capacity *= 2;
    }
    this->Slots.assign(capacity, Slot());
    this->UsedSlots = kept + 1;
    for (const Slot& slot : old)
    {
      if (slot.Value != None)
      {
        this->Slots[this->FindSlot(slot.Points)] = slot;
      }
    }
  }

  std::vector<Slot> Slots;
  std::size_t UsedSlots = 0;
};

} // namespace tetralux

#endif
