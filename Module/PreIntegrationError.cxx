// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegrationError.h"

#include "IntervalTable.h"
#include "PreIntegrationBuilder.h"
#include "RayIntegral.h"
#include "SegmentIntegral.h"
#include "TexelFormats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
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

/// A transfer function between the ends of the scalar axis: intervals on which it is linear, and the
/// variation of each channel from the first scalar on, and its integral.
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

  /// Of the interval that holds a scalar; one on an end belongs to the interval on its left or right.
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

double GetLargestColor(const TransferFunction& function)
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

/// Of interpolation along the length between Chebyshev points, see PreIntegrationBuilder.cxx, and of
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

  double largestAttenuation = 0;
  for (const TransferFunction::Node& node : function.Nodes)
  {
    largestAttenuation =
      std::max({ largestAttenuation, node.Left.Attenuation, node.Right.Attenuation });
  }

  PreIntegrationError bound;
  double sum = 0; // over all splits
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
    sum += atTexels;
    bound.Segment = std::max(bound.Segment, segment);
    // In the first cell the error at a length l is at most l (h - l) / 2 M^2.
    const double perLength = begin > 0 ? between / begin : std::min(unit * 0.5 * m * m, unit) / end;
    bound.PerLength = std::max(bound.PerLength, perLength + atTexels / end);
  }
  if (table.Settings.Method == PreIntegrationMethod::Incremental)
  {
    bound.Segment = std::min(bound.Segment + 2 * sum, unit);
    bound.PerLength += 2 * sum / axis.GetLength(1);
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

namespace
{

/// What a camera anywhere on a ray sees of it, by table: back to front, so that each segment may be
/// the first one.
struct SeenByTable
{
  double Color[3] = { 0, 0, 0 };
  double Transmittance = 1;

  void AddInFront(const float rgba[4])
  {
    const double transmittance = 1 - static_cast<double>(rgba[3]);
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] = static_cast<double>(rgba[c]) + transmittance * this->Color[c];
    }
    this->Transmittance *= transmittance;
  }

  double GetError(const SegmentRadiance& exact) const
  {
    double error = std::abs(exact.Transmittance - this->Transmittance);
    for (int c = 0; c < 3; ++c)
    {
      error = std::max(error, std::abs(exact.Color[c] - this->Color[c]));
    }
    return error;
  }
};

/// Nodes within the scalars of a sample; a part of them, evenly, where they are many.
std::vector<double> FindNodes(
  const TransferFunction& function, const double range[2], std::size_t most)
{
  std::vector<double> nodes;
  for (const TransferFunction::Node& node : function.Nodes)
  {
    if (range[0] < node.Scalar && node.Scalar < range[1])
    {
      nodes.push_back(node.Scalar);
    }
  }
  const std::size_t step = nodes.size() / std::max<std::size_t>(most, 1) + 1;
  for (std::size_t k = 0; k * step < nodes.size(); ++k)
  {
    nodes[k] = nodes[k * step];
  }
  nodes.resize((nodes.size() + step - 1) / step);
  return nodes;
}

/// Those rays of a sample that come nearest to running along a node of the function, moved onto it:
/// the middle of a segment gets the scalar of the node. Tables are most wrong next to bends and steps,
/// along which the worst rays of a picture run, and none of a sample by chance.
std::vector<std::vector<RaySegment>> MoveOntoNodes(
  const TransferFunction& function, const RaySample& sample)
{
  double range[2] = { std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  for (const std::vector<RaySegment>& ray : sample.Rays)
  {
    for (const RaySegment& segment : ray)
    {
      range[0] = std::min({ range[0], segment.Front, segment.Back });
      range[1] = std::max({ range[1], segment.Front, segment.Back });
    }
  }
  // A quarter of the sample, as many rays for each node.
  const std::size_t most = sample.Rays.size() / 4;
  const std::vector<double> nodes = FindNodes(function, range, most);
  const std::size_t count = nodes.empty() ? 0 : std::max<std::size_t>(most / nodes.size(), 1);
  std::vector<std::vector<RaySegment>> moved(count * nodes.size());
  // All rays are searched for each of a few nodes, a part of them for each of many.
  constexpr std::size_t FewNodes = 32;
  const std::size_t step = nodes.size() / FewNodes + 1;
  struct Near
  {
    double Distance; ///< of the farther end from the node, scalars for each unit of length
    std::size_t Ray, Segment;
  };
  const auto n = static_cast<std::ptrdiff_t>(nodes.size());
#pragma omp parallel for schedule(dynamic)
  for (std::ptrdiff_t k = 0; k < n; ++k)
  {
    // The nearest segment of each ray, and of those the nearest.
    std::vector<Near> nearest;
    for (std::size_t i = static_cast<std::size_t>(k) % step; i < sample.Rays.size(); i += step)
    {
      Near near{ std::numeric_limits<double>::infinity(), i, 0 };
      for (std::size_t j = 0; j < sample.Rays[i].size(); ++j)
      {
        const RaySegment& segment = sample.Rays[i][j];
        const double distance =
          std::max(std::abs(segment.Front - nodes[k]), std::abs(segment.Back - nodes[k])) /
          segment.Length;
        near = distance < near.Distance ? Near{ distance, i, j } : near;
      }
      if (!sample.Rays[i].empty())
      {
        nearest.push_back(near);
      }
    }
    const std::size_t found = std::min(count, nearest.size());
    std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(found),
      nearest.end(), [](const Near& a, const Near& b) { return a.Distance < b.Distance; });
    for (std::size_t i = 0; i < found; ++i)
    {
      // The nearest ones of all nodes first: the worst should come early.
      std::vector<RaySegment>& ray = moved[i * nodes.size() + static_cast<std::size_t>(k)];
      ray = sample.Rays[nearest[i].Ray];
      const RaySegment& segment = ray[nearest[i].Segment];
      const double shift = nodes[k] - 0.5 * (segment.Front + segment.Back);
      for (RaySegment& s : ray)
      {
        s.Front = std::clamp(s.Front + shift, range[0], range[1]);
        s.Back = std::clamp(s.Back + shift, range[0], range[1]);
      }
    }
  }
  return moved;
}

/// A sample's rays, and what a camera at the front of each of their segments sees.
class ExactRays
{
public:
  ExactRays(const TransferFunction& function, const RaySample& sample)
    : Rays(MoveOntoNodes(function, sample))
  {
    this->Rays.insert(this->Rays.end(), sample.Rays.begin(), sample.Rays.end());
    this->Seen.resize(this->Rays.size());
    const auto n = static_cast<std::ptrdiff_t>(this->Rays.size());
#pragma omp parallel for schedule(dynamic, 8)
    for (std::ptrdiff_t i = 0; i < n; ++i)
    {
      const std::vector<RaySegment>& ray = this->Rays[i];
      this->Seen[i].resize(ray.size());
      SegmentRadiance behind;
      for (std::size_t k = ray.size(); k-- > 0;)
      {
        SegmentRadiance seen =
          IntegrateEmissionAbsorption(function, ray[k].Front, ray[k].Back, ray[k].Length);
        seen.AddBehind(behind);
        this->Seen[i][k] = behind = seen;
      }
    }
  }

  std::size_t GetSize() const { return this->Rays.size(); }

  /// Largest error of a channel that any camera on the first rays sees, or infinity where it is more
  /// than is allowed; lookUp(front, back, length, rgba).
  template <class LookUp>
  double Measure(std::size_t count, double allowed, const LookUp& lookUp) const
  {
    double largest = 0;
    bool tooLarge = false;
    const auto n = static_cast<std::ptrdiff_t>(std::min(count, this->Rays.size()));
#pragma omp parallel for schedule(dynamic, 4) reduction(max : largest) shared(tooLarge)
    for (std::ptrdiff_t i = 0; i < n; ++i)
    {
      bool isDecided;
#pragma omp atomic read
      isDecided = tooLarge;
      if (isDecided)
      {
        continue;
      }
      largest = std::max(largest, this->MeasureRay(i, lookUp));
      if (largest > allowed)
      {
#pragma omp atomic write
        tooLarge = true;
      }
    }
    return tooLarge ? std::numeric_limits<double>::infinity() : largest;
  }

private:
  template <class LookUp>
  double MeasureRay(std::size_t i, const LookUp& lookUp) const
  {
    double largest = 0;
    SeenByTable seen;
    for (std::size_t k = this->Rays[i].size(); k-- > 0;)
    {
      const RaySegment& segment = this->Rays[i][k];
      float rgba[4];
      lookUp(segment.Front, segment.Back, segment.Length, rgba);
      seen.AddInFront(rgba);
      largest = std::max(largest, seen.GetError(this->Seen[i][k]));
    }
    return largest;
  }

  std::vector<std::vector<RaySegment>> Rays;      ///< those on nodes first
  std::vector<std::vector<SegmentRadiance>> Seen; ///< from the front of each segment
};

/// How much worse the worst of the rays of a picture is than the worst of a sample, at most in nearly
/// all scenes (Module/Notes.md).
constexpr double WorseInPictures = 3;

/// Infinity where it is more than is allowed.
double EstimateOnRays(const ExactRays& rays, const TransferFunction& function,
  const PreIntegrationTable& table, double allowed)
{
  const double worst = rays.Measure(rays.GetSize(), allowed / WorseInPictures,
    [&table](double front, double back, double length, float rgba[4])
    { table.Lookup(front, back, length, rgba); });
  const double estimate = WorseInPictures * worst;
  // More than all of a channel no picture is wrong by.
  return estimate <= allowed ? std::min(estimate, std::max(GetLargestColor(function), 1.))
                             : std::numeric_limits<double>::infinity();
}

/// Nodes between two scalars, on average over all segments of the rays, plus one.
double CountPieces(const TransferFunction& function, const RaySample& sample)
{
  const auto rank = [&function](double s)
  {
    return std::upper_bound(function.Nodes.begin(), function.Nodes.end(), s,
             [](double scalar, const TransferFunction::Node& node)
             { return scalar < node.Scalar; }) -
      function.Nodes.begin();
  };
  double pieces = 0;
  double segments = 0;
  for (const std::vector<RaySegment>& ray : sample.Rays)
  {
    for (const RaySegment& segment : ray)
    {
      pieces += 1 + static_cast<double>(std::abs(rank(segment.Front) - rank(segment.Back)));
    }
    segments += static_cast<double>(ray.size());
  }
  return segments > 0 ? pieces / segments : 1;
}

} // namespace

double EstimatePictureError(
  const TransferFunction& function, const PreIntegrationTable& table, const RaySample& rays)
{
  constexpr double Any = std::numeric_limits<double>::infinity();
  return EstimateOnRays(ExactRays(function, rays), function, table, Any);
}

// ------------------------------------------------------------------------------------------------
// Choosing

namespace
{

/// Sizes and scales in the order of their costs: scalars, lengths, steps for each doubling (0:
/// linear). 256 x 256 x 16 with one step, and 128 x 128 x 256, are those of the papers.
struct Sizes
{
  int Scalars, Lengths, Steps;
};

constexpr Sizes Ladder[] = { { 32, 16, 0 }, { 32, 25, 2 }, { 64, 32, 0 }, { 64, 49, 4 },
  { 128, 32, 0 }, { 128, 49, 4 }, { 256, 16, 1 }, { 256, 32, 0 }, { 256, 49, 4 }, { 128, 193, 16 },
  { 128, 256, 0 }, { 256, 97, 8 }, { 512, 32, 0 }, { 512, 49, 4 }, { 256, 256, 0 },
  { 512, 193, 16 } };

/// All tables that a goal leaves free to choose, in single precision, in the order of their costs.
std::vector<PreIntegrationSettings> GetCandidates(const TableGoal& goal)
{
  std::vector<PreIntegrationSettings> candidates;
  for (const Sizes& sizes : Ladder)
  {
    for (const ScalarAxis axis : { ScalarAxis::Nodes, ScalarAxis::Uniform })
    {
      PreIntegrationSettings settings;
      settings.ScalarSize = goal.ScalarSize > 0 ? goal.ScalarSize : sizes.Scalars;
      settings.LengthSize = goal.LengthSize > 0 ? goal.LengthSize : sizes.Lengths;
      settings.Scale = sizes.Steps > 0 ? LengthScale::Logarithmic : LengthScale::Linear;
      settings.StepsPerDoubling = std::max(sizes.Steps, 1);
      settings.Axis = axis;
      std::copy_n(goal.ScalarRange, 2, settings.ScalarRange);
      settings.LongestSegment = goal.LongestSegment;
      // Sizes that are given make some steps of the ladder the same.
      const bool again = std::any_of(candidates.begin(), candidates.end(),
        [&](const PreIntegrationSettings& other)
        {
          return other.ScalarSize == settings.ScalarSize &&
            other.LengthSize == settings.LengthSize && other.Scale == settings.Scale &&
            other.StepsPerDoubling == settings.StepsPerDoubling && other.Axis == settings.Axis;
        });
      if ((goal.AnyScale || settings.Scale == goal.Scale) &&
        (goal.AnyAxis || settings.Axis == goal.Axis) &&
        settings.StepsPerDoubling < settings.LengthSize && !again)
      {
        candidates.push_back(settings);
      }
    }
  }
  return candidates;
}

/// A table whose texels are computed when they are looked up: for a few thousand lookups, much less
/// work than to fill it.
class VirtualTable
{
public:
  VirtualTable(const TransferFunction& function, const PreIntegrationSettings& settings)
    : Function(function)
    , Format(settings.Format)
  {
    this->Axes.Scalars = MakeScalarAxis(function, settings);
    this->Axes.Lengths = MakeLengthAxis(settings);
  }

  void LookUp(double front, double back, double length, float rgba[4]) const
  {
    this->Axes.Interpolate(front, back, length, rgba,
      [this](int f, int b, int r, float texel[4]) { this->GetTexel(f, b, r, texel); });
  }

private:
  void GetTexel(int f, int b, int r, float texel[4]) const
  {
    const SegmentRadiance exact = IntegrateEmissionAbsorption(
      this->Function, this->GetScalar(f), this->GetScalar(b), this->Axes.Lengths.GetLength(r));
    for (int c = 0; c < 4; ++c)
    {
      texel[c] = this->Round(static_cast<float>(c < 3 ? exact.Color[c] : exact.Opacity));
    }
  }

  /// The two texels of a step are just beside it.
  double GetScalar(int texel) const
  {
    const std::vector<double>& texels = this->Axes.Scalars.Texels;
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    const double s = texels[texel];
    if (texel + 1 < this->Axes.Scalars.GetSize() && texels[texel + 1] == s)
    {
      return std::nextafter(s, -Infinity);
    }
    return texel > 0 && texels[texel - 1] == s ? std::nextafter(s, Infinity) : s;
  }

  float Round(float value) const
  {
    switch (this->Format)
    {
      case TexelFormat::UNorm8:
        return UNorm8Channel::Decode(UNorm8Channel::Encode(value));
      case TexelFormat::UNorm16:
        return UNorm16Channel::Decode(UNorm16Channel::Encode(value));
      case TexelFormat::Half:
        return HalfChannel::Decode(HalfChannel::Encode(value));
      case TexelFormat::Float:
        break;
    }
    return value;
  }

  const TransferFunction& Function;
  TexelFormat Format;
  PreIntegrationTable Axes; ///< without texels
};

/// Whether a table is within the limit of bytes.
bool Fits(const PreIntegrationSettings& settings, TexelFormat format, const TableGoal& goal)
{
  return GetTexelSize(format) * settings.ScalarSize * settings.ScalarSize * settings.LengthSize <=
    goal.MaximumBytes;
}

bool IsInteger(TexelFormat format)
{
  return format == TexelFormat::UNorm8 || format == TexelFormat::UNorm16;
}

/// Whether all colours are in 0..1.
bool HasColorsUpToOne(const TransferFunction& function)
{
  const auto isInside = [](double c) { return 0 <= c && c <= 1; };
  return std::all_of(function.Nodes.begin(), function.Nodes.end(),
    [&](const TransferFunction::Node& node)
    {
      return std::all_of(node.Left.Color, node.Left.Color + 3, isInside) &&
        std::all_of(node.Right.Color, node.Right.Color + 3, isInside);
    });
}

} // namespace

TableChoice ChoosePreIntegrationTable(const TransferFunction& function, const TableGoal& goal)
{
  TableChoice choice;
  choice.PiecesPerSegment = CountPieces(function, *goal.Rays);
  if (choice.PiecesPerSegment <= goal.LookupCost && !goal.AlwaysTable)
  {
    choice.Reason = "closed form: a segment has few pieces, a lookup takes longer";
    return choice;
  }

  const ExactRays rays(function, *goal.Rays);
  const bool integersHold = HasColorsUpToOne(function);
  // A few rays tell most tables that are not right, for much less than it takes to fill them.
  const auto mayBeRight = [&](const PreIntegrationSettings& settings, double allowed)
  {
    constexpr std::size_t FewRays = 32;
    const VirtualTable table(function, settings);
    return rays.Measure(FewRays, allowed / WorseInPictures,
             [&table](double front, double back, double length, float rgba[4])
             { table.LookUp(front, back, length, rgba); }) <= allowed;
  };
  PreIntegrationTable table;
  const auto isRight = [&](const PreIntegrationSettings& settings, double allowed)
  {
    if (!mayBeRight(settings, allowed))
    {
      return false;
    }
    BuildPreIntegrationTable(function, settings, table);
    choice.PictureError = EstimateOnRays(rays, function, table, allowed);
    return choice.PictureError <= allowed;
  };
  std::vector<PreIntegrationSettings> candidates = GetCandidates(goal);
  for (PreIntegrationSettings& settings : candidates)
  {
    const auto fits = [&](TexelFormat format) { return Fits(settings, format, goal); };
    // In single precision first: what that can't do, no other format can.
    if (!fits(goal.AnyFormat ? TexelFormat::UNorm8 : goal.Format) ||
      !mayBeRight(settings, goal.MaximumError))
    {
      continue;
    }
    for (const TexelFormat format :
      { TexelFormat::UNorm8, TexelFormat::UNorm16, TexelFormat::Half, TexelFormat::Float })
    {
      settings.Format = format;
      const bool isFree =
        goal.AnyFormat ? !IsInteger(format) || integersHold : format == goal.Format;
      if (isFree && fits(format) && isRight(settings, goal.MaximumError))
      {
        choice.ClosedForm = false;
        choice.Settings = settings;
        choice.Reason = "table: the smallest that is right enough";
        return choice;
      }
    }
  }
  choice.PictureError = 0;
  choice.Reason = "closed form: no table within the limits is right enough";
  if (!goal.AlwaysTable)
  {
    return choice;
  }
  double least = std::numeric_limits<double>::infinity();
  for (PreIntegrationSettings& settings : candidates)
  {
    settings.Format = goal.AnyFormat ? TexelFormat::Float : goal.Format;
    if (Fits(settings, settings.Format, goal) && isRight(settings, least))
    {
      least = choice.PictureError;
      choice.ClosedForm = false;
      choice.Settings = settings;
      choice.Reason = "table: asked for; none is right enough, this is the most exact one";
    }
  }
  choice.PictureError = choice.ClosedForm ? 0 : least;
  return choice;
}

} // namespace tetralux
