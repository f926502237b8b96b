// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/IntervalTable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

void CheckValue(const TransferFunction::Value& value, std::size_t node)
{
  bool valid = std::isfinite(value.Attenuation) && value.Attenuation >= 0;
  for (double c : value.Color)
  {
    valid = valid && std::isfinite(c);
  }
  if (!valid)
  {
    throw std::invalid_argument("node " + std::to_string(node) +
      " of the transfer function has a colour or attenuation that is not finite or is negative");
  }
}

void Check(const TransferFunction& function)
{
  if (function.Nodes.empty())
  {
    throw std::invalid_argument("the transfer function has no nodes; it needs at least one");
  }
  for (std::size_t k = 0; k < function.Nodes.size(); ++k)
  {
    const TransferFunction::Node& node = function.Nodes[k];
    if (!std::isfinite(node.Scalar) || (k > 0 && !(function.Nodes[k - 1].Scalar < node.Scalar)))
    {
      throw std::invalid_argument("node " + std::to_string(k) +
        " of the transfer function is not finite or not above the node before it");
    }
    CheckValue(node.Left, k);
    CheckValue(node.Right, k);
  }
}

/// Slope of what is a at a distance of 0 and b at a distance of reach. Rounded towards zero as far
/// as it takes for a + slope x to stay between a and b in single precision, whether product and sum
/// are rounded once or twice: no colour comes out negative, and no attenuation.
float GetSlope(float a, float b, float reach)
{
  if (reach == 0)
  {
    return 0;
  }
  constexpr double Largest = std::numeric_limits<float>::max();
  const double exact = (static_cast<double>(b) - a) / reach;
  auto slope = static_cast<float>(std::clamp(exact, -Largest, Largest));
  const auto overshoots = [&]
  {
    const float product = slope * reach;
    const float once = std::fma(slope, reach, a);
    const float twice = product + a;
    return a < b ? once > b || twice > b : once < b || twice < b;
  };
  while (overshoots())
  {
    slope = std::nextafter(slope, 0.f);
  }
  return slope;
}

IntervalTable::Interval MakeInterval(
  float lo, float hi, const TransferFunction::Value& left, const TransferFunction::Value& right)
{
  // Seen from the end with less attenuation, nothing is ever subtracted from an attenuation: next
  // to a scalar where it vanishes, it keeps its relative accuracy.
  const bool fromLeft = left.Attenuation <= right.Attenuation;
  const TransferFunction::Value& near = fromLeft ? left : right;
  const TransferFunction::Value& far = fromLeft ? right : left;
  // The distance of the rounded nodes, so that the values at both ends are met.
  const float reach = fromLeft ? hi - lo : lo - hi;
  IntervalTable::Interval interval{};
  interval.Lo = lo;
  interval.Hi = hi;
  interval.Reference = fromLeft ? lo : hi;
  interval.Attenuation = static_cast<float>(near.Attenuation);
  interval.AttenuationSlope =
    GetSlope(interval.Attenuation, static_cast<float>(far.Attenuation), reach);
  for (int c = 0; c < 3; ++c)
  {
    interval.Color[c] = static_cast<float>(near.Color[c]);
    interval.ColorSlope[c] = GetSlope(interval.Color[c], static_cast<float>(far.Color[c]), reach);
  }
  return interval;
}

/// Adds the bulge of a run to a channel of its interval: with u = d / reach, 4 bulge u (1 - u),
/// whichever end d is measured from.
void AddBulge(IntervalTable::Interval& interval, int c, double bulge)
{
  const double reach =
    interval.Reference == interval.Lo ? interval.Hi - interval.Lo : interval.Lo - interval.Hi;
  if (bulge == 0 || reach == 0)
  {
    return;
  }
  const float far = interval.Color[c] + interval.ColorSlope[c] * reach;
  interval.ColorSlope[c] += static_cast<float>(4 * bulge / reach);
  interval.ColorBend[c] = static_cast<float>(-4 * bulge / (reach * reach));
  if (interval.Color[c] >= 0 && far >= 0)
  {
    // So that none of the roundings on the way to a colour makes it negative.
    constexpr float Roundings = 1.f / (1 << 22);
    interval.Color[c] += Roundings *
      (interval.Color[c] + std::abs(interval.ColorSlope[c] * reach) +
        std::abs(interval.ColorBend[c] * reach * reach));
  }
}

std::vector<FunctionRun> FindRuns(const TransferFunction& function, const RunTolerance& tolerance)
{
  if (tolerance.Allows())
  {
    return FindFunctionRuns(function, tolerance).Runs;
  }
  std::vector<FunctionRun> runs;
  for (std::size_t k = 0; k + 1 < function.Nodes.size(); ++k)
  {
    runs.push_back({ k, k + 1, { 0, 0, 0 } });
  }
  return runs;
}

/// An interval without an end on one side.
IntervalTable::Interval MakeConstantInterval(
  float lo, float hi, float reference, const TransferFunction::Value& value)
{
  IntervalTable::Interval interval = MakeInterval(reference, reference, value, value);
  interval.Lo = lo;
  interval.Hi = hi;
  return interval;
}

} // namespace

IntervalTable MakeIntervalTable(const TransferFunction& function, const RunTolerance& tolerance)
{
  Check(function);
  IntervalTable table;
  const std::vector<TransferFunction::Node>& nodes = function.Nodes;
  const double first = nodes.front().Scalar;
  const double last = nodes.back().Scalar;
  table.Offset = 0.5 * first + 0.5 * last;
  table.Scale = 0.5 * last - 0.5 * first;
  if (!(table.Scale > 0))
  {
    // One node: any scale near that of the scalars, which are not known here.
    table.Scale = first != 0 ? std::abs(first) : 1;
  }
  const auto map = [&table](double s)
  { return static_cast<float>((s - table.Offset) / table.Scale); };

  constexpr float Infinity = std::numeric_limits<float>::infinity();
  table.Intervals.push_back(
    MakeConstantInterval(-Infinity, map(first), map(first), nodes.front().Left));
  for (const FunctionRun& run : FindRuns(function, tolerance))
  {
    const TransferFunction::Node& begin = nodes[run.First];
    const TransferFunction::Node& end = nodes[run.Last];
    IntervalTable::Interval interval =
      MakeInterval(map(begin.Scalar), map(end.Scalar), begin.Right, end.Left);
    for (int c = 0; c < 3; ++c)
    {
      AddBulge(interval, c, run.Bulge[c]);
      table.Curved = table.Curved || interval.ColorBend[c] != 0;
    }
    table.Intervals.push_back(interval);
    table.Exact = table.Exact && run.Last == run.First + 1;
  }
  table.Intervals.push_back(
    MakeConstantInterval(map(last), Infinity, map(last), nodes.back().Right));

  table.MaximumAttenuation = GetLargestAttenuation(function);
  double previous = nodes.front().Left.Attenuation;
  for (const TransferFunction::Node& node : nodes)
  {
    table.AttenuationVariation += std::abs(node.Left.Attenuation - previous) +
      std::abs(node.Right.Attenuation - node.Left.Attenuation);
    previous = node.Right.Attenuation;
  }
  return table;
}

TransferFunction::Value Evaluate(const TransferFunction& function, double scalar)
{
  const std::vector<TransferFunction::Node>& nodes = function.Nodes;
  if (scalar < nodes.front().Scalar)
  {
    return nodes.front().Left;
  }
  // The last node that is not above the scalar.
  const auto next = std::upper_bound(nodes.begin(), nodes.end(), scalar,
    [](double s, const TransferFunction::Node& node) { return s < node.Scalar; });
  const TransferFunction::Node& node = *(next - 1);
  if (next == nodes.end())
  {
    return node.Right;
  }
  const double f = (scalar - node.Scalar) / (next->Scalar - node.Scalar);
  TransferFunction::Value value;
  value.Attenuation = (1 - f) * node.Right.Attenuation + f * next->Left.Attenuation;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = (1 - f) * node.Right.Color[c] + f * next->Left.Color[c];
  }
  return value;
}

} // namespace tetralux
