// SPDX-License-Identifier: BSD-3-Clause

// Where the texels of a pre-integration table lie.

#include "Optics/IntervalTable.h"
#include "PreIntegration/PreIntegrationBuilder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tetralux
{
namespace
{

constexpr int LargestSize = 4096;

void Require(bool condition, const std::string& message)
{
  if (!condition)
  {
    throw std::invalid_argument("pre-integration table: " + message);
  }
}

/// Scalars where a transfer function bends or steps, and how much: of the attenuation or of a
/// channel of attenuation times colour, whichever is most, in units of the largest of all.
struct Bend
{
  double Scalar;
  double Step;
  double Slope; ///< change of the slope, per unit of the scalar
  bool IsStep;
};

std::vector<Bend> GetBends(const TransferFunction& function)
{
  const std::vector<TransferFunction::Node>& nodes = function.Nodes;
  // Attenuation, and channels of attenuation times colour.
  const auto getChannel = [](const TransferFunction::Value& value, int channel)
  { return channel < 3 ? value.Attenuation * value.Color[channel] : value.Attenuation; };
  double largest[4] = { 0, 0, 0, 0 };
  for (const TransferFunction::Node& node : nodes)
  {
    for (int c = 0; c < 4; ++c)
    {
      largest[c] = std::max(
        { largest[c], std::abs(getChannel(node.Left, c)), std::abs(getChannel(node.Right, c)) });
    }
  }
  const double scale = std::max({ largest[0], largest[1], largest[2], largest[3] });
  std::vector<Bend> bends;
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    Bend bend{ nodes[k].Scalar, 0, 0, false };
    for (int c = 0; c < 4; ++c)
    {
      const auto get = [&](const TransferFunction::Value& value)
      { return scale > 0 ? getChannel(value, c) / scale : 0; };
      const double before = k == 0
        ? 0
        : (get(nodes[k].Left) - get(nodes[k - 1].Right)) / (nodes[k].Scalar - nodes[k - 1].Scalar);
      const double after = k + 1 == nodes.size()
        ? 0
        : (get(nodes[k + 1].Left) - get(nodes[k].Right)) / (nodes[k + 1].Scalar - nodes[k].Scalar);
      bend.Step = std::max(bend.Step, std::abs(get(nodes[k].Right) - get(nodes[k].Left)));
      bend.Slope = std::max(bend.Slope, std::abs(after - before));
      bend.IsStep = bend.IsStep || nodes[k].Right.Attenuation != nodes[k].Left.Attenuation ||
        (c < 3 && nodes[k].Right.Color[c] != nodes[k].Left.Color[c]);
    }
    bends.push_back(bend);
  }
  return bends;
}

/// Those first that linear interpolation across them would miss most, with texels as far apart as
/// their neighbours, or range.
std::vector<Bend> SortByImportance(const std::vector<Bend>& bends, double range)
{
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < bends.size(); ++k)
  {
    const double before = k > 0 ? bends[k].Scalar - bends[k - 1].Scalar : range;
    const double after = k + 1 < bends.size() ? bends[k + 1].Scalar - bends[k].Scalar : range;
    const double width = std::min({ before, after, range });
    order.emplace_back(-(bends[k].Step + 0.25 * bends[k].Slope * width), k);
  }
  std::sort(order.begin(), order.end());
  std::vector<Bend> sorted;
  sorted.reserve(order.size());
  for (const auto& entry : order)
  {
    sorted.push_back(bends[entry.second]);
  }
  return sorted;
}

/// A step between two texels.
struct Cell
{
  double Begin, End;
  int Halvings;  ///< since the interval between two nodes
  double Weight; ///< how much a smaller step would help

  bool operator<(const Cell& other) const
  {
    return this->Weight < other.Weight ||
      (this->Weight == other.Weight && this->Begin > other.Begin);
  }
};

/// About the error of the mean attenuation of segments that begin in the cell and end beyond a
/// bend: that of linear interpolation across the bend where it is next to the cell; of 1 /
/// distance, in which the mean falls, farther away.
double GetWeight(const Cell& cell, const std::vector<Bend>& bends)
{
  const double width = cell.End - cell.Begin;
  double weight = 0;
  for (const Bend& bend : bends)
  {
    const double distance = std::max({ 0., bend.Scalar - cell.End, cell.Begin - bend.Scalar });
    const double near = std::min(bend.Step + 0.25 * bend.Slope * width, 1.);
    const double share = distance > 0 ? std::min(width / distance, 1.) : 1.;
    weight += near * share * share;
  }
  // Next to a step of the function the largest error stays whatever the width, but fewer segments
  // see it: something between both counts.
  return weight * std::sqrt(std::sqrt(width));
}

} // namespace

ScalarAxisMap MakeScalarAxis(
  const TransferFunction& function, const PreIntegrationSettings& settings)
{
  Require(2 <= settings.ScalarSize && settings.ScalarSize <= LargestSize,
    "a scalar size of " + std::to_string(settings.ScalarSize) + ", it must be in 2.." +
      std::to_string(LargestSize));
  const double lo = settings.ScalarRange[0];
  double hi = settings.ScalarRange[1];
  Require(std::isfinite(lo) && std::isfinite(hi) && lo <= hi && std::isfinite(hi - lo),
    "a scalar range from " + std::to_string(lo) + " to " + std::to_string(hi) +
      ", it must be finite and ascending");

  ScalarAxisMap axis;
  const IntervalTable intervals = MakeIntervalTable(function);
  axis.Offset = intervals.Offset;
  axis.Scale = intervals.Scale;
  if (!(lo < hi))
  {
    hi = lo + std::max(axis.Scale, 1e-3 * std::abs(lo)); // a range that holds the one scalar
  }
  const auto map = [&axis](double s) { return static_cast<float>((s - axis.Offset) / axis.Scale); };
  Require(std::isfinite(map(lo)) && std::isfinite(map(hi)) && map(lo) < map(hi),
    "a scalar range that single precision can't hold beside that of the transfer function's nodes");

  const auto addInterval = [&axis, &map](double begin, double end, int coordinate, int steps)
  {
    ScalarAxisMap::Interval interval{ map(begin), map(end), static_cast<float>(coordinate), 0 };
    const float width = interval.Hi - interval.Lo;
    if (width > 0)
    {
      interval.Slope =
        std::min(static_cast<float>(steps) / width, std::numeric_limits<float>::max());
    }
    axis.Intervals.push_back(interval);
  };

  if (settings.Axis == ScalarAxis::Uniform)
  {
    const int steps = settings.ScalarSize - 1;
    for (int i = 0; i <= steps; ++i)
    {
      const double t = static_cast<double>(i) / steps;
      axis.Texels.push_back(std::clamp((1 - t) * lo + t * hi, lo, hi));
    }
    addInterval(lo, hi, 0, steps);
    return axis;
  }

  // Texels on the nodes, those that matter most where there are too many; then the step is halved
  // that helps most, until all texels are used.
  const std::vector<Bend> bends = GetBends(function);
  std::vector<double> breaks = { lo, hi };
  std::vector<double> doubled;
  for (const Bend& bend : SortByImportance(bends, hi - lo))
  {
    const double s = bend.Scalar;
    const bool isInside = lo < s && s < hi;
    const bool isDoubled = bend.IsStep && (isInside || s == hi);
    const std::size_t texels = breaks.size() + doubled.size() + isInside + isDoubled;
    if (texels <= static_cast<std::size_t>(settings.ScalarSize))
    {
      if (isInside)
      {
        breaks.push_back(s);
      }
      if (isDoubled)
      {
        doubled.push_back(s);
      }
    }
  }
  std::sort(breaks.begin(), breaks.end());
  std::sort(doubled.begin(), doubled.end());
  std::vector<Cell> cells;
  // Weighing a cell takes all nodes, which may be thousands: not where no texel is left.
  const bool isHalved =
    breaks.size() + doubled.size() < static_cast<std::size_t>(settings.ScalarSize);
  const auto addCell = [&](double begin, double end, int halvings)
  {
    Cell cell{ begin, end, halvings, 0 };
    cell.Weight = isHalved ? GetWeight(cell, bends) : 0;
    cells.push_back(cell);
    std::push_heap(cells.begin(), cells.end());
  };
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
  {
    addCell(breaks[k], breaks[k + 1], 0);
  }
  // A kernel's scalars are rounded to 2^-24 of the range: a step of 2^-15 is known to 1 / 512.
  const double narrowest = std::ldexp(std::max(std::abs(map(lo)), std::abs(map(hi))), -15);
  while (static_cast<int>(cells.size() + 1 + doubled.size()) < settings.ScalarSize)
  {
    const Cell cell = cells.front();
    if (cell.Weight < 0)
    {
      break;
    }
    std::pop_heap(cells.begin(), cells.end());
    cells.pop_back();
    const double middle = cell.Begin + 0.5 * (cell.End - cell.Begin);
    if ((cell.End - cell.Begin) / axis.Scale < narrowest ||
      !(cell.Begin < middle && middle < cell.End))
    {
      cells.push_back({ cell.Begin, cell.End, cell.Halvings, -1 });
      std::push_heap(cells.begin(), cells.end());
      continue;
    }
    addCell(cell.Begin, middle, cell.Halvings + 1);
    addCell(middle, cell.End, cell.Halvings + 1);
  }

  // Neighbours of equal width between the same nodes are one interval of the map.
  std::sort(
    cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.Begin < b.Begin; });
  axis.Texels.push_back(lo);
  std::size_t first = 0;
  int coordinate = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const double end = cells[i].End;
    axis.Texels.push_back(end);
    const bool isDoubled = std::binary_search(doubled.begin(), doubled.end(), end);
    if (isDoubled)
    {
      axis.Texels.push_back(end);
    }
    const bool isNode = std::binary_search(breaks.begin(), breaks.end(), end);
    if (isNode || cells[i + 1].Halvings != cells[first].Halvings)
    {
      const int steps = static_cast<int>(i + 1 - first);
      addInterval(cells[first].Begin, end, coordinate, steps);
      coordinate += steps + (isDoubled ? 1 : 0);
      first = i + 1;
    }
  }
  if (!doubled.empty() && doubled.back() == hi)
  {
    addInterval(hi, hi, coordinate, 0); // the right side of a step at the very end
  }
  return axis;
}

LengthAxisMap MakeLengthAxis(const PreIntegrationSettings& settings)
{
  Require(2 <= settings.LengthSize && settings.LengthSize <= LargestSize,
    "a length size of " + std::to_string(settings.LengthSize) + ", it must be in 2.." +
      std::to_string(LargestSize));
  Require(std::isfinite(settings.LongestSegment) && settings.LongestSegment > 0,
    "a longest segment of " + std::to_string(settings.LongestSegment) +
      ", it must be a positive number");
  LengthAxisMap axis;
  axis.Scale = settings.Scale;
  axis.Size = settings.LengthSize;
  if (settings.Scale == LengthScale::Logarithmic)
  {
    const int steps = settings.StepsPerDoubling;
    Require(1 <= steps && steps <= 256 && (steps & (steps - 1)) == 0 && steps < axis.Size,
      std::to_string(steps) + " steps for each doubling of " + std::to_string(axis.Size) +
        " lengths, they must be a power of 2 in 1..256 and below the number of lengths");
    axis.StepsPerDoubling = steps;
  }
  axis.Delta = settings.LongestSegment / axis.GetLength(axis.Size - 1);
  axis.InverseDelta = static_cast<float>(1 / axis.Delta);
  Require(std::isnormal(axis.InverseDelta) && std::isnormal(static_cast<float>(axis.Delta)),
    "lengths that single precision can't hold");
  return axis;
}

} // namespace tetralux
