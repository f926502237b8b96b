// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_DisjointSets_h
#define tetralux_DisjointSets_h

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace tetralux
{

/// Union-find whose roots are the smallest elements of their sets.
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size)
    : Parents(size)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }

  std::int32_t Find(std::int32_t element)
  {
    while (this->Parents[element] != element)
    {
      this->Parents[element] = this->Parents[this->Parents[element]];
      element = this->Parents[element];
    }
    return element;
  }

  /// Returns whether the two were in different sets.
  bool Unite(std::int32_t element0, std::int32_t element1)
  {
    const auto [smaller, larger] = std::minmax({ this->Find(element0), this->Find(element1) });
    this->Parents[larger] = smaller;
    return smaller != larger;
  }

private:
  std::vector<std::int32_t> Parents;
};

} // namespace tetralux

#endif
