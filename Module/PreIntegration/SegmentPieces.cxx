// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/SegmentPieces.h"

#include "Base/Check.h"
#include "Integral/SegmentIntegral.h"

#include <algorithm>

namespace tetralux
{

SegmentPieces::SegmentPieces(
  const TransferFunction& function, const ScalarAxisMap& axis, double longest)
  : Nodes(function.Nodes)
  , Texels(axis.Texels)
  , Longest(longest)
{
  for (std::size_t i = 0; i < this->Texels.size(); ++i)
  {
    const bool left = i + 1 < this->Texels.size() && this->Texels[i] == this->Texels[i + 1];
    const double s = this->Texels[i];
    // The number of nodes below: of a scalar on a node, with the node's left or right side.
    const auto next = left
      ? std::lower_bound(this->Nodes.begin(), this->Nodes.end(), s,
          [](const TransferFunction::Node& node, double scalar) { return node.Scalar < scalar; })
      : std::upper_bound(this->Nodes.begin(), this->Nodes.end(), s,
          [](double scalar, const TransferFunction::Node& node) { return scalar < node.Scalar; });
    this->Intervals.push_back(static_cast<std::size_t>(next - this->Nodes.begin()));
  }
}

void SegmentPieces::Find(int front, int back, std::vector<SegmentPiece>& pieces) const
{
  pieces.clear();
  const double s0 = this->Texels[front];
  const double s1 = this->Texels[back];
  std::size_t k = this->Intervals[front];
  const std::size_t last = this->Intervals[back];
  if (s0 == s1)
  {
    // Constant; from one side of a step to the other, half of each.
    const double share = k == last ? 1 : 0.5;
    this->Add(k, s0, s0, share, pieces);
    if (k != last)
    {
      this->Add(last, s0, s0, share, pieces);
    }
    return;
  }
  const double range = s1 - s0;
  double s = s0;
  while (true)
  {
    double next = s1;
    std::size_t nextInterval = k;
    if (s0 < s1 && k < this->Nodes.size() && this->Nodes[k].Scalar < s1)
    {
      next = this->Nodes[k].Scalar;
      nextInterval = k + 1;
    }
    else if (s1 < s0 && k > 0 && this->Nodes[k - 1].Scalar > s1)
    {
      next = this->Nodes[k - 1].Scalar;
      nextInterval = k - 1;
    }
    if (next != s)
    {
      this->Add(k, s, next, (next - s) / range, pieces);
    }
    if (nextInterval == k)
    {
      return;
    }
    s = next;
    k = nextInterval;
    TETRALUX_CHECK(k <= this->Nodes.size());
  }
}

void SegmentPieces::Add(
  std::size_t interval, double s0, double s1, double share, std::vector<SegmentPiece>& pieces) const
{
  const TransferFunction::Value values[2] = { this->Evaluate(interval, s0),
    this->Evaluate(interval, s1) };
  if (!(values[0].Attenuation > 0 || values[1].Attenuation > 0))
  {
    return;
  }
  SegmentPiece piece;
  const double largest = std::max(values[0].Attenuation, values[1].Attenuation);
  const double length = std::min(share * this->Longest, LargestSingleDepth / largest);
  for (int end = 0; end < 2; ++end)
  {
    piece.Depth[end] = static_cast<float>(values[end].Attenuation * length);
    for (int c = 0; c < 3; ++c)
    {
      piece.Color[end][c] = static_cast<float>(values[end].Color[c]);
    }
  }
  pieces.push_back(piece);
}

TransferFunction::Value SegmentPieces::Evaluate(std::size_t interval, double s) const
{
  if (interval == 0)
  {
    return this->Nodes.front().Left;
  }
  if (interval == this->Nodes.size())
  {
    return this->Nodes.back().Right;
  }
  const TransferFunction::Node& a = this->Nodes[interval - 1];
  const TransferFunction::Node& b = this->Nodes[interval];
  const double t = (s - a.Scalar) / (b.Scalar - a.Scalar);
  TransferFunction::Value value;
  value.Attenuation = (1 - t) * a.Right.Attenuation + t * b.Left.Attenuation;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = (1 - t) * a.Right.Color[c] + t * b.Left.Color[c];
  }
  return value;
}

} // namespace tetralux
