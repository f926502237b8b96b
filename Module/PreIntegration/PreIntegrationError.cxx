// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/PreIntegrationError.h"

#include "Integral/RayIntegral.h"
#include "Integral/SegmentIntegral.h"
#include "Optics/IntervalTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace tetralux
{
namespace
{

// ------------------------------------------------------------------------------------------------
// The bound

/// Attenuation, and attenuation times each colour.
constexpr int NumberOfChannels = 4;
using Channels = std::array<double, NumberOfChannels>;

Channels GetChannels(const TransferFunction::Value& value)
{
  return { value.Attenuation * value.Color[0], value.Attenuation * value.Color[1],
    value.Attenuation * value.Color[2], value.Attenuation };
}

/// A transfer function between the ends of the scalar axis: intervals on which it is linear, and
/// the variation of each channel from the first scalar on, and its integral.
struct Variation
{
  std::vector<double> Scalars;  ///< ends of intervals
  std::vector<Channels> Steps;  ///< at each end, of the channels
  std::vector<Channels> Slopes; ///< of each interval: largest of the channel
  std::vector<Channels> Bends;  ///< of each interval: second derivative of the channel
  std::vector<Channels> Jumps;  ///< at each end: of the slope
  std::vector<Channels> Before; ///< variation up to each end's left side
  std::vector<Channels> Sums;   ///< integral of the variation up to each end

  Variation(const TransferFunction& function, double lo, double hi)
  {
    const auto add = [this](double s, const Channels& step)
    {
      this->Scalars.push_back(s);
      this->Steps.push_back(step);
    };
    std::vector<TransferFunction::Value> left, right; // at the ends
    const auto addEnd =
      [&](double s, const TransferFunction::Value& l, const TransferFunction::Value& r)
    {
      Channels step{};
      const Channels a = GetChannels(l), b = GetChannels(r);
      for (int c = 0; c < NumberOfChannels; ++c)
      {
        step[c] = std::abs(b[c] - a[c]);
      }
      add(s, step);
      left.push_back(l);
      right.push_back(r);
    };
    const TransferFunction::Value first = Evaluate(function, lo);
    addEnd(lo, first, first);
    for (const TransferFunction::Node& node : function.Nodes)
    {
      if (lo < node.Scalar && node.Scalar < hi)
      {
        addEnd(node.Scalar, node.Left, node.Right);
      }
    }
    // The last side from the left: nothing of the range lies beyond.
    const auto node = std::lower_bound(function.Nodes.begin(), function.Nodes.end(), hi,
      [](const TransferFunction::Node& n, double s) { return n.Scalar < s; });
    const bool isNode = node != function.Nodes.end() && node->Scalar == hi;
    const TransferFunction::Value last = isNode ? node->Left : Evaluate(function, hi);
    addEnd(hi, last, last);

    const std::size_t n = this->Scalars.size();
    std::vector<Channels> slopesAtBegin, slopesAtEnd;
    for (std::size_t k = 0; k + 1 < n; ++k)
    {
      const TransferFunction::Value& a = right[k];
      const TransferFunction::Value& b = left[k + 1];
      const double width = this->Scalars[k + 1] - this->Scalars[k];
      Channels slope{}, bend{}, begin{}, end{};
      const double da = (b.Attenuation - a.Attenuation) / width;
      slope[3] = std::abs(da);
      begin[3] = end[3] = da;
      for (int c = 0; c < 3; ++c)
      {
        const double dc = (b.Color[c] - a.Color[c]) / width;
        begin[c] = da * a.Color[c] + a.Attenuation * dc;
        end[c] = da * b.Color[c] + b.Attenuation * dc;
        slope[c] = std::abs(da) * std::max(std::abs(a.Color[c]), std::abs(b.Color[c])) +
          std::max(a.Attenuation, b.Attenuation) * std::abs(dc);
        bend[c] = 2 * std::abs(da * dc);
      }
      this->Slopes.push_back(slope);
      this->Bends.push_back(bend);
      slopesAtBegin.push_back(begin);
      slopesAtEnd.push_back(end);
    }
    this->Jumps.assign(n, Channels{});
    for (std::size_t k = 1; k + 1 < n; ++k)
    {
      for (int c = 0; c < NumberOfChannels; ++c)
      {
        this->Jumps[k][c] = std::abs(slopesAtBegin[k][c] - slopesAtEnd[k - 1][c]);
      }
    }
    this->Before.assign(n, Channels{});
    this->Sums.assign(n, Channels{});
    for (std::size_t k = 1; k < n; ++k)
    {
      const double width = this->Scalars[k] - this->Scalars[k - 1];
      for (int c = 0; c < NumberOfChannels; ++c)
      {
        const double after = this->Before[k - 1][c] + this->Steps[k - 1][c];
        this->Before[k][c] = after + this->Slopes[k - 1][c] * width;
        this->Sums[k][c] = this->Sums[k - 1][c] + 0.5 * (after + this->Before[k][c]) * width;
      }
    }
  }

  /// Of the interval that holds a scalar; one on an end belongs to the interval on its left or
  /// right.
  std::size_t Find(double s, bool onLeft) const
  {
    const auto begin = this->Scalars.begin() + 1;
    const auto end = this->Scalars.end() - 1;
    const auto found = onLeft ? std::lower_bound(begin, end, s) : std::upper_bound(begin, end, s);
    return static_cast<std::size_t>(found - begin);
  }

  double GetValue(std::size_t k, double s, int c) const
  {
    return this->Before[k][c] + this->Steps[k][c] + this->Slopes[k][c] * (s - this->Scalars[k]);
  }

  double GetSum(std::size_t k, double s, int c) const
  {
    const double d = s - this->Scalars[k];
    return this->Sums[k][c] +
      d * (this->Before[k][c] + this->Steps[k][c] + 0.5 * this->Slopes[k][c] * d);
  }
};

/// A place on the scalar axis.
struct Site
{
  double Scalar;
  std::size_t Interval;
};

/// Mean variation between two places.
double GetMean(const Variation& variation, const Site& a, const Site& b, int c)
{
  const double va = variation.GetValue(a.Interval, a.Scalar, c);
  const double vb = variation.GetValue(b.Interval, b.Scalar, c);
  const double width = b.Scalar - a.Scalar;
  if (a.Interval == b.Interval || !(width > 0))
  {
    return 0.5 * (va + vb);
  }
  const double mean =
    (variation.GetSum(b.Interval, b.Scalar, c) - variation.GetSum(a.Interval, a.Scalar, c)) / width;
  return std::clamp(mean, va, vb);
}

/// The step of each channel at the end of the axis where one texel has to be both of its sides: a
/// constant scalar there takes the upper side, and nothing else on the axis does.
Channels GetStepOnLastTexel(const TransferFunction& function, const std::vector<double>& texels)
{
  Channels step{};
  const double hi = texels.back();
  const auto node = std::find_if(function.Nodes.begin(), function.Nodes.end(),
    [hi](const TransferFunction::Node& n) { return n.Scalar == hi; });
  if (node != function.Nodes.end() && texels[texels.size() - 2] < hi)
  {
    const Channels left = GetChannels(node->Left);
    const Channels right = GetChannels(node->Right);
    for (int c = 0; c < NumberOfChannels; ++c)
    {
      step[c] = std::abs(right[c] - left[c]);
    }
  }
  return step;
}

/// What interpolation between texels does to the mean of each channel along a segment, at most:
/// Error of the mean, and Spread of the texels' means around it.
struct ScalarError
{
  Channels Error{}, Spread{};
};

ScalarError BoundScalars(const TransferFunction& function, const ScalarAxisMap& axis)
{
  const std::vector<double>& texels = axis.Texels;
  const Variation variation(function, texels.front(), texels.back());
  const Channels lastStep = GetStepOnLastTexel(function, texels);
  struct Cell
  {
    Site Begin, End;
  };
  std::vector<Cell> cells;
  for (std::size_t i = 0; i + 1 < texels.size(); ++i)
  {
    if (texels[i] < texels[i + 1])
    {
      cells.push_back({ { texels[i], variation.Find(texels[i], false) },
        { texels[i + 1], variation.Find(texels[i + 1], true) } });
    }
  }
  // Bends of many nodes are not told apart: what varies bounds the error, too.
  constexpr std::size_t MostBends = 64;
  ScalarError result;
  const int n = static_cast<int>(cells.size());
  std::vector<ScalarError> rows(cells.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (int i = 0; i < n; ++i)
  {
    ScalarError& row = rows[i];
    for (int j = i; j < n; ++j)
    {
      const Cell& a = cells[i];
      const Cell& b = cells[j];
      Channels error{};
      const std::size_t firstEnd = a.Begin.Interval;
      const std::size_t lastEnd = b.End.Interval;
      const bool exact = lastEnd - firstEnd <= MostBends;
      const double widthA = a.End.Scalar - a.Begin.Scalar;
      const double widthB = b.End.Scalar - b.Begin.Scalar;
      // Part of the segment whose windows touch scalars from lo to hi, and the widest of them.
      const auto touch = [&](double lo, double hi, double& part, double& width)
      {
        double w0 = 0, w1 = 1;
        if (i != j)
        {
          w0 = std::clamp((lo - a.End.Scalar) / (b.End.Scalar - a.End.Scalar), 0., 1.);
          w1 = std::clamp((hi - a.Begin.Scalar) / (b.Begin.Scalar - a.Begin.Scalar), 0., 1.);
        }
        part = std::max(w1 - w0, 0.);
        width = std::max((1 - w0) * widthA + w0 * widthB, (1 - w1) * widthA + w1 * widthB);
      };
      for (std::size_t k = firstEnd; exact && k <= lastEnd; ++k)
      {
        double part, width;
        const double lo = variation.Scalars[k];
        touch(lo, variation.Scalars[k + 1], part, width);
        for (int c = 0; c < 3; ++c)
        {
          error[c] += part * variation.Bends[k][c] * width * width / 8;
        }
        if (a.Begin.Scalar < lo && lo < b.End.Scalar)
        {
          touch(lo, lo, part, width);
          for (int c = 0; c < NumberOfChannels; ++c)
          {
            error[c] += part * (variation.Steps[k][c] + variation.Jumps[k][c] * width / 4);
          }
        }
      }
      for (int c = 0; c < NumberOfChannels; ++c)
      {
        // Only segments of constant scalar meet the upper side.
        const double step = i == j && j == n - 1 ? lastStep[c] : 0;
        error[c] += step;
        const double spread =
          step + GetMean(variation, a.End, b.End, c) - GetMean(variation, a.Begin, b.Begin, c);
        row.Spread[c] = std::max(row.Spread[c], spread);
        row.Error[c] = std::max(row.Error[c], exact ? std::min(error[c], spread) : spread);
      }
    }
  }
  for (const ScalarError& row : rows)
  {
    for (int c = 0; c < NumberOfChannels; ++c)
    {
      result.Error[c] = std::max(result.Error[c], row.Error[c]);
      result.Spread[c] = std::max(result.Spread[c], row.Spread[c]);
    }
  }
  return result;
}

/// Error of a segment of a length from that of its means: of the opacity
///   l Error + (l Spread)^2 / 8,
/// since exp(-x) is convex with a second derivative of 1 at most; of a colour, by the error of the
/// transmittance in front and of what is emitted.
double BoundSegment(const ScalarError& scalars, double largestColor, double length)
{
  const double e = length * scalars.Error[3];
  const double x = length * scalars.Spread[3];
  double worst = e + x * x / 8;
  const double growth = std::expm1(std::min(x, 1.)); // beyond, all is lost anyway
  for (int c = 0; c < 3; ++c)
  {
    const double color = largestColor * (e + 0.5 * x * x * (1 + growth)) +
      length * scalars.Error[c] + length * scalars.Spread[c] * growth;
    worst = std::max(worst, x <= 1 ? std::min(color, largestColor) : largestColor);
  }
  return std::min(worst, std::max(largestColor, 1.));
}

double GetFormatRounding(TexelFormat format, double largestColor)
{
  switch (format)
  {
    case TexelFormat::UNorm8:
      return 0.5 / 255;
    case TexelFormat::UNorm16:
      return 0.5 / 65535;
    case TexelFormat::Half:
      return std::max(largestColor, 1.) / 4096;
    case TexelFormat::Float:
      break;
  }
  return std::max(largestColor, 1.) / 16777216;
}

/// Of the closed form in single precision, for each piece of a segment: of its weights (relative to
/// the opacity), and of the transmittance of those in front.
constexpr double PieceRounding = 4e-7;

/// Of interpolation along the length between Chebyshev points, see LengthSamples.h, and of
/// the trilinear interpolation in single precision, coordinates included.
constexpr double InterpolationRounding = 4e-6;

} // namespace

PreIntegrationError BoundPreIntegrationError(
  const TransferFunction& function, const PreIntegrationTable& table)
{
  const LengthAxisMap& axis = table.Lengths;
  const double largestColor = GetLargestColor(function);
  const double unit = std::max(largestColor, 1.);
  const ScalarError scalars = BoundScalars(function, table.Scalars);

  const double largestAttenuation = GetLargestAttenuation(function);

  PreIntegrationError bound;
  for (int r = 0; r + 1 < axis.Size; ++r)
  {
    const double begin = axis.GetLength(r);
    const double end = axis.GetLength(r + 1);
    const double h = end - begin;
    constexpr double Bend = 1.083; // 8 / e^2
    const double m = largestAttenuation * h;
    const double relative = begin > 0 ? Bend * (h / begin) * (h / begin) : m * m;
    const double between = std::min(unit * std::min(m * m, relative) / 8, unit);
    const double atTexels = BoundSegment(scalars, largestColor, end);
    const double segment = std::min(between + atTexels, unit);
    bound.Segment = std::max(bound.Segment, segment);
    // In the first cell the error at a length l is at most l (h - l) / 2 M^2.
    const double perLength = begin > 0 ? between / begin : std::min(unit * 0.5 * m * m, unit) / end;
    bound.PerLength = std::max(bound.PerLength, perLength + atTexels / end);
  }
  bound.Rounding = GetFormatRounding(table.Settings.Format, largestColor) +
    unit *
      (SegmentWeightError + InterpolationRounding +
        PieceRounding * static_cast<double>(function.Nodes.size() + 1));
  return bound;
}

// ------------------------------------------------------------------------------------------------
// Estimates

namespace
{

/// Largest difference of a lookup from the closed form.
double GetLookupError(const SegmentRadiance& exact, const float rgba[4])
{
  double error = std::abs(exact.Opacity - rgba[3]);
  for (int c = 0; c < 3; ++c)
  {
    error = std::max(error, std::abs(exact.Color[c] - rgba[c]));
  }
  return error;
}

} // namespace

PreIntegrationError EstimatePreIntegrationError(
  const TransferFunction& function, const PreIntegrationTable& table, std::size_t samples)
{
  const std::vector<double>& texels = table.Scalars.Texels;
  const LengthAxisMap& lengths = table.Lengths;
  const int n = static_cast<int>(texels.size());
  std::mt19937_64 generator(1);
  std::uniform_int_distribution<int> anyCell(0, n - 2);
  std::uniform_int_distribution<int> anyLength(0, lengths.Size - 2);
  std::uniform_int_distribution<int> nextCell(-1, 1);
  std::uniform_real_distribution<double> anyShare(0, 1);
  PreIntegrationError estimate;
  const auto measure = [&](double front, double back, double length)
  {
    float rgba[4];
    table.Lookup(front, back, length, rgba);
    return GetLookupError(IntegrateEmissionAbsorption(function, front, back, length), rgba);
  };
  // At texels, apart from those of a step's sides, whose scalars are looked up as one.
  std::uniform_int_distribution<int> anyTexel(0, n - 1);
  for (std::size_t i = 0; i < samples / 4; ++i)
  {
    const double front = texels[anyTexel(generator)];
    const double back = texels[anyTexel(generator)];
    if (front != back)
    {
      const int row = anyLength(generator) + 1;
      estimate.Rounding = std::max(estimate.Rounding, measure(front, back, lengths.GetLength(row)));
    }
  }
  for (std::size_t i = 0; i < samples; ++i)
  {
    // Every cell of the diagonal and a neighbour in turns, then any.
    const bool diagonal = i % 2 == 0;
    const int front =
      diagonal ? static_cast<int>(i / 2 % static_cast<std::size_t>(n - 1)) : anyCell(generator);
    const int back =
      diagonal ? std::clamp(front + nextCell(generator), 0, n - 2) : anyCell(generator);
    const int row = anyLength(generator);
    // In the middle of the cell, then anywhere in it.
    const bool inMiddle = i % 4 < 2;
    const auto choose = [&](double a, double b)
    { return a + (inMiddle ? 0.5 : anyShare(generator)) * (b - a); };
    const double length = choose(lengths.GetLength(row), lengths.GetLength(row + 1));
    const double frontScalar = choose(texels[front], texels[front + 1]);
    const double backScalar = choose(texels[back], texels[back + 1]);
    const double error = measure(frontScalar, backScalar, length);
    const double interpolation = std::max(error - estimate.Rounding, 0.);
    estimate.Segment = std::max(estimate.Segment, interpolation);
    estimate.PerLength = std::max(estimate.PerLength, interpolation / length);
  }
  return estimate;
}

double GetPictureError(const PreIntegrationError& error, double pathLength, double segments)
{
  return 2 *
    (std::min(error.PerLength * pathLength, error.Segment * segments) + error.Rounding * segments);
}

} // namespace tetralux
