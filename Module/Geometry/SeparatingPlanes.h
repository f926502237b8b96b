// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SeparatingPlanes_h
#define tetralux_SeparatingPlanes_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace tetralux
{

/// The least and the greatest dot product of a direction with the points of a set. Without points,
/// Least is above Greatest.
struct SetExtent
{
  double Least = std::numeric_limits<double>::max();
  double Greatest = std::numeric_limits<double>::lowest();

  bool IsEmpty() const { return this->Least > this->Greatest; }
};

/// A direction, and the extent of each set along it.
struct SetExtents
{
  std::array<double, 3> Direction;
  std::vector<SetExtent> Sets;
};

/// How far sets may reach over a plane between them, as a share of what they reach along its normal
/// together: what coordinates in single precision are rounded by, 6e-8 each, and some places more.
constexpr double SeparationOverlap = 1e-6;

/// Planes that cut space in two, then each side, until each set of points has a cell of its own. So
/// there is an order of the sets for each eye: what is on the eye's side of a plane comes before
/// what is on the other.
class SeparatingPlanes
{
public:
  /// Finds planes with the normals of the extents. Returns false if there are none between some
  /// sets. Sets without points have no cells.
  bool Find(const std::vector<SetExtents>& extents);

  /// Returns the sets, the nearest one first, those without points last. eye: a point, or for
  /// parallel rays the direction towards the eye, with 0 as the last coordinate.
  std::vector<int> FindOrder(const std::array<double, 4>& eye) const;

  /// Returns the part of a box (xmin, xmax, ymin, ...) that those planes leave a set which are
  /// perpendicular to an axis. Of a set without points, the last corner of the box.
  std::array<double, 6> CutBox(int set, const std::array<double, 6>& box) const;

private:
  /// A plane, Normal . x = Offset, or a set.
  struct Node
  {
    std::array<double, 3> Normal{};
    double Offset = 0;
    int Below = -1; ///< the nodes on both sides
    int Above = -1;
    int Set = -1; ///< if it is one
  };

  /// Where one direction parts sets: the first Count ones, in the order of their least values.
  struct Split
  {
    std::size_t Count = 0;
    double Offset = 0;
  };

  static Split FindSplit(const SetExtents& extents, std::vector<int>& sets);
  int AddNode(const std::vector<SetExtents>& extents, std::vector<int> sets);
  bool FindCell(int node, int set, std::array<double, 6>& box) const;

  std::vector<Node> Nodes;
  int Root = -1;
  std::vector<int> Empty; ///< sets without points
};

/// Sorts the sets, and returns the split that leaves about as many on both sides; Count is 0 if
/// there is none.
inline SeparatingPlanes::Split SeparatingPlanes::FindSplit(
  const SetExtents& extents, std::vector<int>& sets)
{
  const std::vector<SetExtent>& of = extents.Sets;
  std::sort(sets.begin(), sets.end(),
    [&](int a, int b)
    {
      return std::make_pair(of[a].Least, of[a].Greatest) <
        std::make_pair(of[b].Least, of[b].Greatest);
    });
  double least = std::numeric_limits<double>::max();
  double greatest = std::numeric_limits<double>::lowest();
  for (const SetExtent& extent : of)
  {
    least = std::min(least, extent.Least);
    greatest = std::max(greatest, extent.Greatest);
  }
  const double overlap = SeparationOverlap * (greatest - least);

  Split best;
  double reached = std::numeric_limits<double>::lowest();
  for (std::size_t count = 1; count < sets.size(); ++count)
  {
    reached = std::max(reached, of[sets[count - 1]].Greatest);
    const double next = of[sets[count]].Least;
    const std::size_t larger = std::max(count, sets.size() - count);
    if (next >= reached - overlap &&
      (best.Count == 0 || larger < std::max(best.Count, sets.size() - best.Count)))
    {
      best = { count, 0.5 * (reached + next) };
    }
  }
  return best;
}

/// Returns -1 if the sets can't be parted.
inline int SeparatingPlanes::AddNode(const std::vector<SetExtents>& extents, std::vector<int> sets)
{
  Node node;
  if (sets.size() == 1)
  {
    node.Set = sets.front();
  }
  else
  {
    std::vector<int> below, above;
    for (const SetExtents& along : extents)
    {
      const Split split = FindSplit(along, sets);
      const std::size_t larger = std::max(split.Count, sets.size() - split.Count);
      if (split.Count > 0 && (below.empty() || larger < std::max(below.size(), above.size())))
      {
        below.assign(sets.begin(), sets.begin() + static_cast<std::ptrdiff_t>(split.Count));
        above.assign(sets.begin() + static_cast<std::ptrdiff_t>(split.Count), sets.end());
        node.Normal = along.Direction;
        node.Offset = split.Offset;
      }
    }
    if (below.empty())
    {
      return -1;
    }
    node.Below = this->AddNode(extents, below);
    node.Above = this->AddNode(extents, above);
    if (node.Below < 0 || node.Above < 0)
    {
      return -1;
    }
  }
  this->Nodes.push_back(node);
  return static_cast<int>(this->Nodes.size()) - 1;
}

inline bool SeparatingPlanes::Find(const std::vector<SetExtents>& extents)
{
  this->Nodes.clear();
  this->Empty.clear();
  this->Root = -1;
  std::vector<int> sets;
  const std::vector<SetExtent>& any = extents.front().Sets;
  for (std::size_t set = 0; set < any.size(); ++set)
  {
    (any[set].IsEmpty() ? this->Empty : sets).push_back(static_cast<int>(set));
  }
  if (sets.empty())
  {
    return true;
  }
  this->Root = this->AddNode(extents, sets);
  return this->Root >= 0;
}

inline std::vector<int> SeparatingPlanes::FindOrder(const std::array<double, 4>& eye) const
{
  std::vector<int> order;
  std::vector<int> next; // the nearest one last
  if (this->Root >= 0)
  {
    next.push_back(this->Root);
  }
  while (!next.empty())
  {
    const Node& node = this->Nodes[next.back()];
    next.pop_back();
    if (node.Set >= 0)
    {
      order.push_back(node.Set);
      continue;
    }
    const std::array<double, 3>& n = node.Normal;
    const bool isAbove = n[0] * eye[0] + n[1] * eye[1] + n[2] * eye[2] - node.Offset * eye[3] > 0;
    next.push_back(isAbove ? node.Below : node.Above);
    next.push_back(isAbove ? node.Above : node.Below);
  }
  order.insert(order.end(), this->Empty.begin(), this->Empty.end());
  return order;
}

/// Returns whether the set is below the node, and cuts the box by the planes on the way then.
inline bool SeparatingPlanes::FindCell(int index, int set, std::array<double, 6>& box) const
{
  if (index < 0)
  {
    return false;
  }
  const Node& node = this->Nodes[index];
  if (node.Set >= 0)
  {
    return node.Set == set;
  }
  const bool isBelow = this->FindCell(node.Below, set, box);
  if (!isBelow && !this->FindCell(node.Above, set, box))
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<double, 3> alongAxis{};
    alongAxis[axis] = 1;
    if (node.Normal == alongAxis)
    {
      double& least = box[2 * axis];
      double& greatest = box[2 * axis + 1];
      (isBelow ? greatest : least) =
        isBelow ? std::min(greatest, node.Offset) : std::max(least, node.Offset);
    }
  }
  return true;
}

inline std::array<double, 6> SeparatingPlanes::CutBox(
  int set, const std::array<double, 6>& box) const
{
  std::array<double, 6> cut = box;
  return this->FindCell(this->Root, set, cut)
    ? cut
    : std::array<double, 6>{ box[1], box[1], box[3], box[3], box[5], box[5] };
}

} // namespace tetralux

#endif
