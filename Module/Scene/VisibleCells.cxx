// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/VisibleCells.h"

#include "Optics/IntervalTable.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

struct Range
{
  double Lo, Hi;
};

/// Where the attenuation is above zero, but perhaps at single scalars: disjoint, ascending.
std::vector<Range> FindVisibleRanges(const TransferFunction& function)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  const std::vector<TransferFunction::Node>& nodes = function.Nodes;
  std::vector<Range> ranges;
  const auto add = [&ranges](double lo, double hi, bool visible)
  {
    if (!visible)
    {
      return;
    }
    if (!ranges.empty() && ranges.back().Hi == lo)
    {
      ranges.back().Hi = hi;
    }
    else
    {
      ranges.push_back({ lo, hi });
    }
  };
  add(-Infinity, nodes.front().Scalar, nodes.front().Left.Attenuation > 0);
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
  {
    add(nodes[k].Scalar, nodes[k + 1].Scalar,
      nodes[k].Right.Attenuation > 0 || nodes[k + 1].Left.Attenuation > 0);
  }
  add(nodes.back().Scalar, Infinity, nodes.back().Right.Attenuation > 0);
  return ranges;
}

/// For each cell 1 where all its scalars are finite and isVisible(least, largest).
template <class PredicateT>
std::vector<std::uint8_t> FindCells(Span<const std::int32_t> cells, Span<const double> scalars,
  bool scalarsOfCells, PredicateT isVisible)
{
  const std::int64_t n = static_cast<std::int64_t>(cells.size() / 4);
  std::vector<std::uint8_t> visible(n);
#pragma omp parallel for schedule(static)
  for (std::int64_t t = 0; t < n; ++t)
  {
    double lo, hi;
    bool finite = true;
    if (scalarsOfCells)
    {
      lo = hi = scalars[t];
      finite = std::isfinite(lo);
    }
    else
    {
      lo = hi = scalars[cells[4 * t]];
      for (int i = 0; i < 4; ++i)
      {
        const double s = scalars[cells[4 * t + i]];
        finite = finite && std::isfinite(s);
        lo = std::min(lo, s);
        hi = std::max(hi, s);
      }
    }
    visible[t] = finite && isVisible(lo, hi);
  }
  return visible;
}

} // namespace

std::vector<std::uint8_t> FindVisibleCells(const TransferFunction& function,
  Span<const std::int32_t> cells, Span<const double> scalars, bool scalarsOfCells)
{
  const std::vector<Range> ranges = FindVisibleRanges(function);
  return FindCells(cells, scalars, scalarsOfCells,
    [&](double lo, double hi)
    {
      if (lo == hi)
      {
        return Evaluate(function, lo).Attenuation > 0;
      }
      const auto range = std::upper_bound(
        ranges.begin(), ranges.end(), lo, [](double s, const Range& r) { return s < r.Hi; });
      return range != ranges.end() && range->Lo < hi;
    });
}

std::vector<std::uint8_t> FindCrossedCells(Span<const Isosurface> surfaces,
  Span<const std::int32_t> cells, Span<const double> scalars, double rounding)
{
  std::vector<double> values;
  for (const Isosurface& surface : surfaces)
  {
    if (surface.Opacity > 0)
    {
      values.push_back(surface.Value);
    }
  }
  std::sort(values.begin(), values.end());
  return FindCells(cells, scalars, false,
    [&](double lo, double hi)
    {
      const auto value = std::lower_bound(values.begin(), values.end(), lo - rounding);
      return value != values.end() && *value <= hi + rounding;
    });
}

} // namespace tetralux
