// SPDX-License-Identifier: BSD-3-Clause
#include "Optics/FunctionRuns.h"

#include "Optics/BulgeShareError.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tetralux
{
namespace
{

using Node = TransferFunction::Node;
using Value = TransferFunction::Value;

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Shares of an error that attenuation takes, and of the rest that the weights of bulges take.
constexpr double ShareOfAttenuation = 1. / 8;
constexpr double ShareOfBulges = 1. / 8;

/// Intervals that a thread looks through at once; runs end with them, whatever the threads. Few
/// functions have more.
constexpr std::size_t PartSize = 1 << 15;

/// What is rounded in double precision is no step and no bend.
constexpr double Rounding = 1e-14;

bool IsStep(const Node& node)
{
  return node.Left.Attenuation != node.Right.Attenuation ||
    !std::equal(node.Left.Color, node.Left.Color + 3, node.Right.Color);
}

/// Bounds of a channel's bulge.
struct BulgeRange
{
  double Least, Most;

  bool IsEmpty() const { return !(this->Least <= this->Most); }

  /// A straight line where that will do.
  double Choose() const
  {
    return this->Least <= 0 && 0 <= this->Most ? 0 : 0.5 * (this->Least + this->Most);
  }
};

class RunFinder
{
public:
  RunFinder(const TransferFunction& function, const RunTolerance& tolerance)
    : Nodes(function.Nodes)
    , ColorError((1 - ShareOfBulges) * tolerance.Color)
    , LargestBulge(ShareOfBulges * tolerance.Color / BulgeShareError)
    , AttenuationShare(std::max(tolerance.AttenuationShare, Rounding))
  {
  }

  /// From a node to another one.
  FunctionRuns Find(std::size_t first, std::size_t last)
  {
    while (first < last)
    {
      const FunctionRun run = this->FindFrom(first, last);
      this->Length = run.Last - run.First;
      this->Result.Runs.push_back(run);
      first = run.Last;
    }
    return std::move(this->Result);
  }

private:
  /// What a run's intervals are taken with, each at its end and in its middle.
  struct Place
  {
    double Share;         ///< of the run, up to the end
    double HalfStep;      ///< half of the interval's share
    double Inverse;       ///< of 4 w (1 - w) at the end
    double MiddleInverse; ///< and in the middle
  };

  /// Runs mostly are about as long as the one before: tries that length, then ever longer or
  /// shorter ones, and halves what is left in between.
  FunctionRun FindFrom(std::size_t first, std::size_t last)
  {
    FunctionRun run{ first, first + 1, { 0, 0, 0 } };
    // The end of what no run from here can pass.
    std::size_t end = last;
    std::size_t step = std::max<std::size_t>(this->Length / 8, 1);
    std::size_t next = std::min(first + std::max<std::size_t>(this->Length, 2), last);
    bool fitted = false;
    bool failed = false;
    while (run.Last < end)
    {
      FunctionRun longer{ first, next, { 0, 0, 0 } };
      if (this->Fit(longer))
      {
        run = longer;
        fitted = true;
      }
      else
      {
        end = next - 1;
        failed = true;
      }
      if (fitted && failed)
      {
        next = run.Last + (end - run.Last + 1) / 2;
      }
      else
      {
        next = fitted ? std::min(run.Last + step, end)
                      : std::max(end - std::min(step - 1, end), run.Last + 1);
        step *= 2;
      }
    }
    return run;
  }

  /// Whether the intervals of a run can be taken as one; fills in the bulges.
  bool Fit(FunctionRun& run)
  {
    const Value& begin = this->Nodes[run.First].Right;
    const Value& end = this->Nodes[run.Last].Left;
    if (!this->IsAttenuationLinear(run, begin, end))
    {
      return false;
    }
    // No colour is seen where nothing attenuates.
    if ((begin.Attenuation == 0 && end.Attenuation == 0) || this->ColorError == Infinity)
    {
      return true;
    }
    if (!this->FindPlaces(run))
    {
      return false;
    }
    for (int c = 0; c < 3; ++c)
    {
      if (!this->FitChannel(run, c))
      {
        return false;
      }
    }
    return true;
  }

  /// Divides once for all channels. False where ends are nearer than doubles tell.
  bool FindPlaces(const FunctionRun& run)
  {
    this->Places.clear();
    double previous = 0;
    for (std::size_t k = run.First + 1; k <= run.Last; ++k)
    {
      ++this->Result.Visits;
      const double w = k == run.Last ? 1 : this->GetShare(run, k);
      const double middle = 0.5 * (previous + w);
      const double shape = 4 * w * (1 - w);
      const double middleShape = 4 * middle * (1 - middle);
      if (!(middleShape > 0) || !(k == run.Last || shape > 0))
      {
        return false;
      }
      this->Places.push_back(
        { w, 0.5 * (w - previous), k == run.Last ? 0 : 1 / shape, 1 / middleShape });
      previous = w;
    }
    return true;
  }

  double GetShare(const FunctionRun& run, std::size_t node) const
  {
    const double begin = this->Nodes[run.First].Scalar;
    const double end = this->Nodes[run.Last].Scalar;
    // Halved, so that nothing overflows.
    return (0.5 * this->Nodes[node].Scalar - 0.5 * begin) / (0.5 * end - 0.5 * begin);
  }

  bool IsAttenuationLinear(const FunctionRun& run, const Value& begin, const Value& end)
  {
    for (std::size_t k = run.First + 1; k < run.Last; ++k)
    {
      ++this->Result.Visits;
      if (IsStep(this->Nodes[k]))
      {
        return false;
      }
      const double w = this->GetShare(run, k);
      const double line = (1 - w) * begin.Attenuation + w * end.Attenuation;
      const double exact = this->Nodes[k].Left.Attenuation;
      if (!(std::abs(line - exact) <= this->AttenuationShare * exact))
      {
        return false;
      }
    }
    return true;
  }

  /// Finds the bulge that keeps nodes, and the middles between them, as near as they have to be.
  bool FitChannel(FunctionRun& run, int c)
  {
    const double begin = this->Nodes[run.First].Right.Color[c];
    const double end = this->Nodes[run.Last].Left.Color[c];
    BulgeRange range{ -this->LargestBulge, this->LargestBulge };
    double leastPositive = -Infinity;
    bool isNegative = begin < 0 || end < 0;
    double previousShare = 0;
    double previousColor = begin;
    const auto bound = [&](double w, double inverse, double color, double halfStep)
    {
      const double line = (1 - w) * begin + w * end;
      range.Least = std::max(range.Least, (color - line - this->ColorError) * inverse);
      range.Most = std::min(range.Most, (color - line + this->ColorError) * inverse);
      // A parabola that is convex comes no lower than this below what it has at such points.
      const double dip = this->LargestBulge * halfStep * halfStep;
      leastPositive = std::max(leastPositive, (dip - line) * inverse);
      return !range.IsEmpty();
    };
    for (std::size_t k = run.First + 1; k <= run.Last; ++k)
    {
      ++this->Result.Visits;
      const Place& place = this->Places[k - run.First - 1];
      const double color = this->Nodes[k].Left.Color[c];
      isNegative = isNegative || color < 0;
      if (!bound(0.5 * (previousShare + place.Share), place.MiddleInverse,
            0.5 * (previousColor + color), place.HalfStep) ||
        (k < run.Last && !bound(place.Share, place.Inverse, color, place.HalfStep)))
      {
        return false;
      }
      previousShare = place.Share;
      previousColor = color;
    }
    run.Bulge[c] = range.Choose();
    if (!isNegative && run.Bulge[c] < 0)
    {
      run.Bulge[c] = std::max(run.Bulge[c], std::min(0., leastPositive));
      if (!(run.Bulge[c] <= range.Most))
      {
        return false;
      }
    }
    return this->IsNear(run, c);
  }

  /// Whether a channel is as near as it has to be everywhere. Between two nodes its error is linear
  /// from that at one to that at the other, plus a bulge.
  bool IsNear(const FunctionRun& run, int c)
  {
    const double begin = this->Nodes[run.First].Right.Color[c];
    const double end = this->Nodes[run.Last].Left.Color[c];
    double share = 0;
    double error = 0;
    for (std::size_t k = run.First + 1; k <= run.Last; ++k)
    {
      ++this->Result.Visits;
      const double w = this->Places[k - run.First - 1].Share;
      const double color = (1 - w) * begin + w * end + run.Bulge[c] * 4 * w * (1 - w);
      const double next = k == run.Last ? 0 : color - this->Nodes[k].Left.Color[c];
      const double bulge = run.Bulge[c] * (w - share) * (w - share);
      double largest = std::max(std::abs(error), std::abs(next));
      if (std::abs(next - error) < 4 * std::abs(bulge))
      {
        // Where the parabola has its vertex.
        largest = std::max(largest,
          std::abs(0.5 * (error + next) + bulge + (next - error) * (next - error) / (16 * bulge)));
      }
      if (!(largest <= this->ColorError))
      {
        return false;
      }
      share = w;
      error = next;
    }
    return true;
  }

  const std::vector<Node>& Nodes;
  double ColorError;
  double LargestBulge;
  double AttenuationShare;
  std::size_t Length = 1;    ///< of the run before
  std::vector<Place> Places; ///< of the intervals of the run that is fitted
  FunctionRuns Result;
};

} // namespace

RunTolerance MakeRunTolerance(
  OpticalModel model, const TransferFunction& function, double error, double longestPath)
{
  const double ofColor = (1 - ShareOfAttenuation) * error;
  const double ofAttenuation = ShareOfAttenuation * error;
  const double largestColor = std::max(1., GetLargestColor(function));
  switch (model)
  {
    case OpticalModel::EmissionAbsorption:
      return { ofColor, ofAttenuation / (2 * largestColor), error };
    case OpticalModel::EmissionOnly:
    {
      const double depth = std::max(1., GetLargestAttenuation(function) * longestPath);
      return { ofColor / depth, ofAttenuation / (largestColor * depth), error };
    }
    case OpticalModel::AbsorptionOnly:
      return { Infinity, error, error };
    case OpticalModel::MaximumIntensity:
    case OpticalModel::Isosurfaces:
      break;
  }
  return {};
}

FunctionRuns FindFunctionRuns(const TransferFunction& function, const RunTolerance& tolerance)
{
  const std::size_t last = function.Nodes.size() - 1;
  const auto count = static_cast<std::ptrdiff_t>((last + PartSize - 1) / PartSize);
  std::vector<FunctionRuns> parts(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(dynamic) if (count > 1)
  for (std::ptrdiff_t k = 0; k < count; ++k)
  {
    const std::size_t first = static_cast<std::size_t>(k) * PartSize;
    parts[k] = RunFinder(function, tolerance).Find(first, std::min(first + PartSize, last));
  }
  FunctionRuns runs;
  for (const FunctionRuns& part : parts)
  {
    runs.Runs.insert(runs.Runs.end(), part.Runs.begin(), part.Runs.end());
    runs.Visits += part.Visits;
  }
  return runs;
}

} // namespace tetralux
