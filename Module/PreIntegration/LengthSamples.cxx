// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/LengthSamples.h"

#include "Base/Check.h"
#include "Integral/SegmentIntegral.h"
#include "Simd/LaneCount.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetralux
{

LengthSamples::LengthSamples(const LengthAxisMap& axis, double largestDepth)
{
  const int halvings = GetHalvings(largestDepth);
  const double longest = axis.GetLength(axis.Size - 1);
  if (PointsPerPanel * (halvings + 1) < axis.Size - 1)
  {
    int row = 1;
    for (int p = 0; p <= halvings; ++p)
    {
      const double begin = p == 0 ? 0 : std::ldexp(1, p - 1 - halvings);
      const double end = std::ldexp(1, p - halvings);
      row = this->AddPanel(axis, longest, begin, end, row, p == halvings);
    }
    TETRALUX_CHECK(row == axis.Size);
  }
  else
  {
    for (int r = 1; r < axis.Size; ++r)
    {
      this->Lengths.push_back(static_cast<float>(axis.GetLength(r) / longest));
    }
  }
  while (this->Lengths.size() % LaneCount != 0)
  {
    this->Lengths.push_back(this->Lengths.back());
  }
}

int LengthSamples::GetHalvings(double largestDepth)
{
  if (!(largestDepth > FirstDepth))
  {
    return 0;
  }
  return static_cast<int>(
    std::ceil(std::log2(std::min(largestDepth, LargestSingleDepth) / FirstDepth)));
}

int LengthSamples::AddPanel(
  const LengthAxisMap& axis, double longest, double begin, double end, int firstRow, bool last)
{
  Panel panel;
  panel.FirstRow = firstRow;
  panel.FirstPoint = static_cast<int>(this->Lengths.size());
  const double pi = std::acos(-1.);
  const double middle = 0.5 * (begin + end);
  const double half = 0.5 * (end - begin);
  double points[PointsPerPanel], factors[PointsPerPanel];
  for (int k = 0; k < PointsPerPanel; ++k)
  {
    // Of the first kind: none is at length 0.
    const double point = middle - half * std::cos((k + 0.5) * pi / PointsPerPanel);
    this->Lengths.push_back(static_cast<float>(point));
    points[k] = static_cast<double>(this->Lengths.back());
  }
  // Weights of the barycentric formula.
  for (int k = 0; k < PointsPerPanel; ++k)
  {
    double product = 1;
    for (int j = 0; j < PointsPerPanel; ++j)
    {
      product *= j == k ? 1 : 2 * (points[k] - points[j]) / half;
    }
    factors[k] = 1 / product;
  }
  int row = firstRow;
  for (; row < axis.Size && (last || axis.GetLength(row) / longest <= end); ++row)
  {
    const double length = axis.GetLength(row) / longest;
    double terms[PointsPerPanel];
    double sum = 0;
    int exact = -1;
    for (int k = 0; k < PointsPerPanel; ++k)
    {
      const double difference = length - points[k];
      exact = difference == 0 ? k : exact;
      terms[k] = factors[k] / difference;
      sum += terms[k];
    }
    for (int k = 0; k < PointsPerPanel; ++k)
    {
      const double weight = exact >= 0 ? (k == exact ? 1 : 0) : terms[k] / sum;
      panel.Weights.push_back(static_cast<float>(weight * (length / points[k])));
    }
  }
  panel.EndRow = row;
  this->Panels.push_back(std::move(panel));
  return row;
}

} // namespace tetralux
