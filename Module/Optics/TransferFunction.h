// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TransferFunction_h
#define tetralux_TransferFunction_h

#include <algorithm>
#include <cmath>
#include <vector>

namespace tetralux
{

/// Colour c(s) and attenuation tau(s) over the scalar s (Weiler et al. 2003, section 3.3),
/// piecewise linear, with a step allowed at every node.
///
/// Between nodes k and k + 1 the function is linear from Nodes[k].Right to Nodes[k + 1].Left. Below
/// the first node it is Nodes.front().Left, above the last one Nodes.back().Right.
struct TransferFunction
{
  struct Value
  {
    double Color[3];    ///< red, green, blue, not multiplied by anything; usually 0..1
    double Attenuation; ///< tau, per world unit of length, at least 0, finite
  };

  struct Node
  {
    double Scalar; ///< in the units of the scalars, finite
    Value Left;    ///< limit from smaller scalars
    Value Right;   ///< limit from larger scalars
  };

  /// Strictly ascending in Scalar; at least one.
  std::vector<Node> Nodes;
};

/// The largest channel of a colour of any node, absolute.
inline double GetLargestColor(const TransferFunction& function)
{
  double largest = 0;
  for (const TransferFunction::Node& node : function.Nodes)
  {
    for (int c = 0; c < 3; ++c)
    {
      largest = std::max({ largest, std::abs(node.Left.Color[c]), std::abs(node.Right.Color[c]) });
    }
  }
  return largest;
}

/// Whether a channel of a colour of any node is below 0.
inline bool HasNegativeColors(const TransferFunction& function)
{
  const auto isNegative = [](const TransferFunction::Value& value)
  { return std::any_of(value.Color, value.Color + 3, [](double c) { return c < 0; }); };
  return std::any_of(function.Nodes.begin(), function.Nodes.end(),
    [&](const TransferFunction::Node& node)
    { return isNegative(node.Left) || isNegative(node.Right); });
}

/// The largest attenuation of any node, per world unit.
inline double GetLargestAttenuation(const TransferFunction& function)
{
  double largest = 0;
  for (const TransferFunction::Node& node : function.Nodes)
  {
    largest = std::max({ largest, node.Left.Attenuation, node.Right.Attenuation });
  }
  return largest;
}

} // namespace tetralux

#endif
