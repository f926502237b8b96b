// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RawVector_h
#define tetralux_RawVector_h

#include <memory>
#include <type_traits>
#include <vector>

namespace tetralux
{

/// An allocator whose elements are left as they are in memory, so that large arrays are not written
/// twice, and are written first by the threads that fill them.
template <class T>
struct RawAllocator : std::allocator<T>
{
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

  template <class U>
  struct rebind
  {
    using other = RawAllocator<U>;
  };

  template <class U, class... Arguments>
  void construct(U* element, Arguments&&... arguments)
  {
    if constexpr (sizeof...(Arguments) > 0)
    {
      ::new (static_cast<void*>(element)) U(std::forward<Arguments>(arguments)...);
    }
  }
};

/// A vector whose resize leaves new elements without a value.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

} // namespace tetralux

#endif
