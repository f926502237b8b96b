// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Cached_h
#define tetralux_Cached_h

// Data that is kept until what it was made from changes.

#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace tetralux
{

/// A number that no other call of this process returns; never 0. Equal versions mean equal data.
inline std::uint64_t MakeVersion()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

/// What something was made from: versions, numbers and addresses, in a fixed order. Numbers are
/// compared by their bits, so not-a-number equals itself.
class CacheKey
{
public:
  CacheKey() = default;

  template <class... Inputs>
  static CacheKey Of(const Inputs&... inputs)
  {
    CacheKey key;
    (key.Add(inputs), ...);
    return key;
  }

  template <class Input>
  void Add(const Input& input)
  {
    if constexpr (std::is_pointer_v<Input>)
    {
      this->Words.push_back(reinterpret_cast<std::uintptr_t>(input));
    }
    else
    {
      static_assert(std::is_arithmetic_v<Input> || std::is_enum_v<Input>,
        "a key is made of numbers and addresses");
      static_assert(sizeof(Input) <= sizeof(std::uint64_t), "a number has at most 64 bits");
      std::uint64_t word = 0;
      std::memcpy(&word, &input, sizeof(Input));
      this->Words.push_back(word);
    }
  }

  bool operator==(const CacheKey& other) const { return this->Words == other.Words; }
  bool operator!=(const CacheKey& other) const { return this->Words != other.Words; }

private:
  std::vector<std::uint64_t> Words;
};

/// The key and the version of data that is stored elsewhere.
class CacheStamp
{
public:
  /// Whether the data was made from this key.
  bool Has(const CacheKey& key) const { return this->Version != 0 && this->Key == key; }

  /// The data was made from this key just now.
  void Set(CacheKey key)
  {
    this->Key = std::move(key);
    this->Version = MakeVersion();
  }

  /// There is no data.
  void Reset() { *this = CacheStamp(); }

  /// 0: there is no data.
  std::uint64_t GetVersion() const { return this->Version; }

private:
  CacheKey Key;
  std::uint64_t Version = 0;
};

/// A value and what it was made from.
template <class T>
class Cached
{
public:
  /// Replaces the value by build(), or by build of the old value if it takes one, for its memory;
  /// unless the value was made from an equal key. Returns whether it was replaced. Where build
  /// throws, the value is gone.
  template <class Build>
  bool Update(CacheKey key, const Build& build)
  {
    if (this->Stamp.Has(key))
    {
      return false;
    }
    this->Stamp.Reset();
    if constexpr (std::is_invocable_v<Build, T>)
    {
      this->Value = build(std::exchange(this->Value, T()));
    }
    else
    {
      this->Value = T();
      this->Value = build();
    }
    this->Stamp.Set(std::move(key));
    return true;
  }

  void Reset()
  {
    this->Stamp.Reset();
    this->Value = T();
  }

  /// A default value until the first Update.
  const T& Get() const { return this->Value; }

  std::uint64_t GetVersion() const { return this->Stamp.GetVersion(); }

private:
  T Value = T();
  CacheStamp Stamp;
};

} // namespace tetralux

#endif
