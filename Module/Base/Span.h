// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Span_h
#define tetralux_Span_h

#include <cstddef>
#include <type_traits>
#include <vector>

namespace tetralux
{

/// A view of contiguous elements that it does not own: the part of C++20's std::span that the
/// kernels need. Indexing is unchecked; the caller validates sizes once, up front.
template <class T>
class Span
{
public:
  constexpr Span() = default;
  constexpr Span(T* data, std::size_t size)
    : Data(data)
    , Size(size)
  {
  }
  template <class Allocator>
  Span(std::vector<std::remove_const_t<T>, Allocator>& v)
    : Data(v.data())
    , Size(v.size())
  {
  }
  template <class Allocator, class U = T, class = std::enable_if_t<std::is_const_v<U>>>
  Span(const std::vector<std::remove_const_t<T>, Allocator>& v)
    : Data(v.data())
    , Size(v.size())
  {
  }
  template <class U, class = std::enable_if_t<std::is_same_v<const U, T>>>
  constexpr Span(Span<U> s)
    : Data(s.data())
    , Size(s.size())
  {
  }

  constexpr T* data() const { return this->Data; }
  constexpr std::size_t size() const { return this->Size; }
  constexpr bool empty() const { return this->Size == 0; }
  constexpr T& operator[](std::size_t i) const { return this->Data[i]; }
  constexpr T* begin() const { return this->Data; }
  constexpr T* end() const { return this->Data + this->Size; }

private:
  T* Data = nullptr;
  std::size_t Size = 0;
};

} // namespace tetralux

#endif
