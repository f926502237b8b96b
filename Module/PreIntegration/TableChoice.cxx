// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/TableChoice.h"

#include "Integral/RayIntegral.h"
#include "PreIntegration/PreIntegrationBuilder.h"
#include "PreIntegration/TableRays.h"
#include "PreIntegration/TexelFormats.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace tetralux
{
namespace
{

/// What measuring a table costs, and is found by: pieces that are integrated in about a second of
/// one thread.
constexpr double MostPieces = 2e7;

/// Rays that rule most tables out; each of their lookups integrates eight texels.
constexpr std::size_t FewRays = 32;
constexpr std::size_t TexelsOfLookup = 8;

/// Rays that rule out tables which are right nowhere, before few rays are integrated.
constexpr std::size_t VeryFewRays = 4;

/// Pieces of all segments of the rays: ends between their two scalars, plus one each. rank(scalar):
/// how many ends are not above it.
template <class Rank>
double CountPieces(const RaySample& sample, const Rank& rank)
{
  double pieces = 0;
  for (const std::vector<RaySegment>& ray : sample.Rays)
  {
    for (const RaySegment& segment : ray)
    {
      pieces += 1 + static_cast<double>(std::abs(rank(segment.Front) - rank(segment.Back)));
    }
  }
  return pieces;
}

/// The first rays of a sample, which are as random as all of them.
RaySample TakeFirst(const RaySample& sample, std::size_t count)
{
  RaySample few;
  few.Rays.assign(sample.Rays.begin(),
    sample.Rays.begin() + static_cast<std::ptrdiff_t>(std::min(count, sample.Rays.size())));
  return few;
}

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

constexpr const char* NoTable = "closed form: no table within the limits is right enough";

/// Whether a few rays say that a table may be right.
bool MayBeRight(const TableRays& rays, const VirtualTable& table, double allowed)
{
  return rays.MayBeRight(allowed,
    [&table](double front, double back, double length, float rgba[4])
    { table.LookUp(front, back, length, rgba); });
}

/// Whether any of the largest tables may be right, as a few rays tell.
bool IsWorthTrying(const TransferFunction& function, const TableGoal& goal,
  const std::vector<PreIntegrationSettings>& candidates)
{
  // The last steps of the ladder, some of each scale.
  constexpr std::size_t MostTried = 12;
  const TableRays veryFew(function, TakeFirst(*goal.Rays, VeryFewRays));
  std::optional<TableRays> few;
  std::size_t tried = 0;
  for (std::size_t k = candidates.size(); k-- > 0 && tried < MostTried;)
  {
    if (!Fits(candidates[k], goal.AnyFormat ? TexelFormat::UNorm8 : goal.Format, goal))
    {
      continue;
    }
    ++tried;
    const VirtualTable table(function, candidates[k]);
    if (!MayBeRight(veryFew, table, goal.MaximumError))
    {
      continue;
    }
    if (!few)
    {
      few.emplace(function, TakeFirst(*goal.Rays, FewRays));
    }
    if (MayBeRight(*few, table, goal.MaximumError))
    {
      return true;
    }
  }
  return false;
}

} // namespace

double CountPiecesPerSegment(const IntervalTable& table, const RaySample& sample)
{
  const std::vector<IntervalTable::Interval>& intervals = table.Intervals;
  const auto rank = [&](double s)
  {
    const auto x = static_cast<float>((s - table.Offset) / table.Scale);
    return std::upper_bound(intervals.begin(), intervals.end(), x,
             [](float scalar, const IntervalTable::Interval& interval)
             { return scalar < interval.Lo; }) -
      intervals.begin();
  };
  double segments = 0;
  for (const std::vector<RaySegment>& ray : sample.Rays)
  {
    segments += static_cast<double>(ray.size());
  }
  return segments > 0 ? CountPieces(sample, rank) / segments : 1;
}

std::size_t CountTableRays(const TransferFunction& function, const RaySample& sample)
{
  const auto rank = [&](double s)
  {
    return std::upper_bound(function.Nodes.begin(), function.Nodes.end(), s,
             [](double scalar, const TransferFunction::Node& node)
             { return scalar < node.Scalar; }) -
      function.Nodes.begin();
  };
  const auto rays = static_cast<double>(sample.Rays.size());
  const double affordable = MostPieces * rays / std::max(CountPieces(sample, rank), 1.);
  return static_cast<std::size_t>(std::min(affordable, rays));
}

TableChoice ChoosePreIntegrationTable(const TransferFunction& function, const TableGoal& goal)
{
  TableChoice choice;
  const double pieces = goal.PiecesPerSegment > 0
    ? goal.PiecesPerSegment
    : CountPiecesPerSegment(MakeIntervalTable(function), *goal.Rays);
  if (pieces <= goal.LookupCost && !goal.AlwaysTable)
  {
    choice.Reason = "closed form: a segment has few pieces, a lookup takes longer";
    return choice;
  }
  const std::size_t affordable = CountTableRays(function, *goal.Rays);
  if (affordable < std::min(TexelsOfLookup * FewRays, goal.Rays->Rays.size()) && !goal.AlwaysTable)
  {
    choice.Reason = "closed form: a segment has too many pieces to find a table that is right";
    return choice;
  }

  std::vector<PreIntegrationSettings> candidates = GetCandidates(goal);
  if (!goal.AlwaysTable && !IsWorthTrying(function, goal, candidates))
  {
    choice.Reason = NoTable;
    return choice;
  }
  const TableRays rays(function, TakeFirst(*goal.Rays, std::max(affordable, FewRays)));
  const bool integersHold = HasColorsUpToOne(function);
  // A few rays tell most tables that are not right, for much less than it takes to fill them.
  const auto mayBeRight = [&](const PreIntegrationSettings& settings, double allowed)
  { return MayBeRight(rays, VirtualTable(function, settings), allowed); };
  // Makes a table the choice where its error is at most what is allowed.
  const auto choose = [&](const PreIntegrationSettings& settings, double allowed)
  {
    if (!mayBeRight(settings, allowed))
    {
      return false;
    }
    auto table = std::make_shared<PreIntegrationTable>();
    BuildPreIntegrationTable(function, settings, *table);
    const double error = rays.Estimate(*table, allowed);
    if (error > allowed)
    {
      return false;
    }
    choice.Table = std::move(table);
    choice.PictureError = error;
    return true;
  };
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
      if (isFree && fits(format) && choose(settings, goal.MaximumError))
      {
        choice.Reason = "table: the smallest that is right enough";
        return choice;
      }
    }
  }
  choice.Reason = NoTable;
  if (!goal.AlwaysTable)
  {
    return choice;
  }
  double least = std::numeric_limits<double>::infinity();
  for (PreIntegrationSettings& settings : candidates)
  {
    settings.Format = goal.AnyFormat ? TexelFormat::Float : goal.Format;
    if (Fits(settings, settings.Format, goal) && choose(settings, least))
    {
      least = choice.PictureError;
      choice.Reason = "table: asked for; none is right enough, this is the most exact one";
    }
  }
  return choice;
}

PreIntegrationSettings GetCoarseSettings(const PreIntegrationSettings& settings, std::size_t bytes)
{
  constexpr int SmallestScalarSize = 16;
  constexpr int SmallestLengthSize = 8;
  PreIntegrationSettings coarse = settings;
  const auto getBytes = [&coarse]() {
    return GetTexelSize(coarse.Format) * coarse.ScalarSize * coarse.ScalarSize * coarse.LengthSize;
  };
  while (getBytes() > bytes)
  {
    // Lengths of a linear scale cost most and give least. A logarithmic one has few already, and
    // without doublings it would begin at longer ones.
    const bool fewerLengths =
      coarse.Scale == LengthScale::Linear && coarse.LengthSize / 2 >= SmallestLengthSize;
    const bool fewerScalars = coarse.ScalarSize / 2 >= SmallestScalarSize;
    if (!fewerLengths && !fewerScalars)
    {
      break;
    }
    if (fewerLengths && (!fewerScalars || coarse.LengthSize > coarse.ScalarSize / 2))
    {
      coarse.LengthSize /= 2;
    }
    else
    {
      coarse.ScalarSize /= 2;
    }
  }
  return coarse;
}

} // namespace tetralux
