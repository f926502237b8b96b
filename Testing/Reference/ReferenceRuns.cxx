// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRuns.h"

#include <algorithm>
#include <tuple>

namespace tetralux
{
namespace
{

/// One of both faces by which a ray passes a cell.
struct Side
{
  std::size_t Passage;
  int Which; ///< 0 or 1, of CellPassage::Faces
};

/// For each side of each passage the passage behind it, or None.
class Neighbours
{
public:
  static constexpr std::size_t None = static_cast<std::size_t>(-1);

  explicit Neighbours(const std::vector<CellPassage>& passages)
    : Behind(passages.size(), { None, None })
  {
    std::vector<Side> sides;
    for (std::size_t passage = 0; passage < passages.size(); ++passage)
    {
      sides.push_back({ passage, 0 });
      sides.push_back({ passage, 1 });
    }
    const auto face = [&](const Side& side) { return passages[side.Passage].Faces[side.Which]; };
    std::sort(sides.begin(), sides.end(),
      [&](const Side& a, const Side& b)
      {
        return std::make_tuple(face(a), a.Passage, a.Which) <
          std::make_tuple(face(b), b.Passage, b.Which);
      });
    for (auto first = sides.begin(), last = first; first != sides.end(); first = last)
    {
      last = std::find_if(
        first, sides.end(), [&](const Side& side) { return face(side) != face(*first); });
      if (last - first == 2)
      {
        this->Behind[first[0].Passage][first[0].Which] = first[1].Passage;
        this->Behind[first[1].Passage][first[1].Which] = first[0].Passage;
      }
    }
  }

  std::size_t Get(const Side& side) const { return this->Behind[side.Passage][side.Which]; }

private:
  std::vector<std::array<std::size_t, 2>> Behind;
};

} // namespace

std::vector<std::size_t> OrderPassages(const std::vector<CellPassage>& passages)
{
  const Neighbours neighbours(passages);
  std::vector<Side> ends;
  for (std::size_t passage = 0; passage < passages.size(); ++passage)
  {
    for (const int which : { 0, 1 })
    {
      if (neighbours.Get({ passage, which }) == Neighbours::None)
      {
        ends.push_back({ passage, which });
      }
    }
  }
  std::stable_sort(ends.begin(), ends.end(),
    [&](const Side& a, const Side& b)
    { return passages[a.Passage].Distances[a.Which] < passages[b.Passage].Distances[b.Which]; });
  for (std::size_t passage = 0; passage < passages.size(); ++passage)
  {
    ends.push_back({ passage, 0 }); // of rings
  }

  std::vector<std::size_t> order;
  std::vector<bool> taken(passages.size(), false);
  for (Side side : ends)
  {
    while (!taken[side.Passage])
    {
      taken[side.Passage] = true;
      order.push_back(side.Passage);
      const Side exit = { side.Passage, 1 - side.Which };
      const std::size_t next = neighbours.Get(exit);
      if (next == Neighbours::None)
      {
        break;
      }
      const auto& face = passages[exit.Passage].Faces[exit.Which];
      side = { next, passages[next].Faces[0] == face ? 0 : 1 };
    }
  }
  return order;
}

} // namespace tetralux
