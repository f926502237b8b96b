// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/CellDivision.h"

#include "Base/ParallelTiles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <omp.h>

namespace tetralux
{
namespace
{

using Interval = IntervalTable::Interval;
using Part = CellDivision::Part;

/// Scalars beyond this are not in intervals as shaders compare them.
constexpr float LargestScalar = 1e30f;

/// More are not counted in 32 bits.
constexpr std::int64_t MostSlicesOfAll = std::numeric_limits<std::uint32_t>::max();

/// Points or cells that a thread takes at once: some tenths of a millisecond, so that an abort is
/// heard soon.
constexpr std::int64_t BlockSize = 8192;

/// Of the whole work, what is done when points have their intervals, and when cells have parts.
constexpr double PlacedShare = 0.1;
constexpr double DividedShare = 0.9;

/// The scalar of a point, and the interval that it is in. At a node that is the one above it.
struct Place
{
  float Scalar; ///< not-a-number: not finite
  std::uint32_t Interval;
};

/// The parts of a block of cells.
struct DividedBlock
{
  std::vector<Part> Parts;
  std::int64_t Cells = 0; ///< that have any
  std::int64_t Slices = 0;
};

float Evaluate(const Interval& interval, float scalar)
{
  return interval.Attenuation + interval.AttenuationSlope * (scalar - interval.Reference);
}

double FindLongestEdge(Span<const double> coordinates, const std::int32_t* cell)
{
  double largest = 0;
  for (int i = 0; i < 4; ++i)
  {
    for (int k = 0; k < i; ++k)
    {
      const double* p = &coordinates[3 * static_cast<std::size_t>(cell[i])];
      const double* q = &coordinates[3 * static_cast<std::size_t>(cell[k])];
      const double x = p[0] - q[0];
      const double y = p[1] - q[1];
      const double z = p[2] - q[2];
      largest = std::max(largest, x * x + y * y + z * z);
    }
  }
  return std::sqrt(largest);
}

/// Appends the parts of a cell; false where there is no dividing it.
bool Divide(const DivisionSource& source, const RawVector<Place>& places, std::int64_t cell,
  DividedBlock& result)
{
  const std::int32_t* p = &source.Cells[4 * cell];
  const Place first = places[p[0]];
  float lowest = first.Scalar;
  float highest = first.Scalar;
  std::uint32_t begin = first.Interval;
  std::uint32_t last = first.Interval;
  bool finite = !std::isnan(first.Scalar);
  for (int i = 1; i < 4; ++i)
  {
    const Place place = places[p[i]];
    finite = finite && !std::isnan(place.Scalar);
    lowest = std::min(lowest, place.Scalar);
    highest = std::max(highest, place.Scalar);
    begin = std::min(begin, place.Interval);
    last = std::max(last, place.Interval);
  }
  if (!finite)
  {
    return true; // it is not drawn
  }
  if (lowest < -LargestScalar || highest > LargestScalar)
  {
    return false;
  }
  const double depthOfLength = source.LengthScale / source.LargestDepth;
  double edge = -1;
  bool any = false;
  for (std::uint32_t k = begin; k <= last; ++k)
  {
    const Interval& interval = source.Intervals[k];
    const double attenuation =
      std::max(Evaluate(interval, std::clamp(lowest, interval.Lo, interval.Hi)),
        Evaluate(interval, std::clamp(highest, interval.Lo, interval.Hi)));
    if (!(attenuation > 0))
    {
      continue;
    }
    Part part = {};
    part.Interval = k;
    part.Slices = 1;
    part.OpenBelow = k == begin;
    part.OpenAbove = k == last;
    if (attenuation * source.LongestEdge * depthOfLength > 1)
    {
      edge = edge < 0 ? FindLongestEdge(source.Coordinates, p) : edge;
      const double slices = std::ceil(attenuation * edge * depthOfLength);
      if (!(slices <= CellDivision::MostSlices))
      {
        return false;
      }
      part.Slices = static_cast<std::uint32_t>(std::max(slices, 1.));
    }
    result.Parts.push_back(part);
    result.Slices += part.Slices;
    any = true;
  }
  result.Cells += any;
  return true;
}

/// Calls work(begin, end, block) for each block of 0..size - 1, on all threads. progress: as of
/// ForEachTile. False after an abort.
template <class Work>
bool ForEachBlock(std::int64_t size, const std::function<bool(double)>& progress, const Work& work)
{
  const auto count = static_cast<int>((size + BlockSize - 1) / BlockSize);
  return ForEachTile({ count, 1, 1 }, omp_get_max_threads(), progress,
    [&](const Tile& block, int)
    {
      const std::int64_t begin = block.X0 * BlockSize;
      work(begin, std::min(begin + BlockSize, size), block.X0);
    });
}

} // namespace

void CellDivision::Clear() { *this = CellDivision(); }

CellDivision::Outcome CellDivision::Make(
  const DivisionSource& source, const std::function<bool(double)>& progress)
{
  this->Clear();
  if (source.Intervals.size() > MostIntervals)
  {
    return Outcome::Refused;
  }
  bool aborted = false;
  const auto makePart = [&](double from, double to) -> std::function<bool(double)>
  {
    if (!progress)
    {
      return {};
    }
    return [&, from, to](double share)
    {
      aborted = aborted || !progress(from + share * (to - from));
      return !aborted;
    };
  };

  std::vector<float> ends(source.Intervals.size());
  std::transform(source.Intervals.begin(), source.Intervals.end(), ends.begin(),
    [](const Interval& interval) { return interval.Hi; });
  RawVector<Place> places(source.Points.size());
  ForEachBlock(static_cast<std::int64_t>(places.size()), makePart(0, PlacedShare),
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const double scalar = source.Points[i].Scalar;
        const auto rounded = static_cast<float>(scalar);
        const auto found = std::upper_bound(ends.begin(), ends.end() - 1, rounded);
        places[i] = { std::isfinite(scalar) ? rounded : std::numeric_limits<float>::quiet_NaN(),
          static_cast<std::uint32_t>(found - ends.begin()) };
      }
    });
  if (aborted)
  {
    return Outcome::Aborted;
  }

  const auto n = static_cast<std::int64_t>(source.Cells.size() / 4);
  std::vector<DividedBlock> blocks((n + BlockSize - 1) / BlockSize);
  RawVector<std::uint32_t> begins(n + 1); // in the block, at first
  std::atomic<bool> possible{ true };
  std::atomic<std::int64_t> slices{ 0 };
  ForEachBlock(n, makePart(PlacedShare, DividedShare),
    [&](std::int64_t begin, std::int64_t end, int block)
    {
      DividedBlock& divided = blocks[block];
      divided.Parts.reserve(BlockSize);
      for (std::int64_t cell = begin; cell < end && possible; ++cell)
      {
        begins[cell] = static_cast<std::uint32_t>(divided.Parts.size());
        if (!Divide(source, places, cell, divided))
        {
          possible = false;
        }
      }
      divided.Parts.shrink_to_fit();
      slices += divided.Slices;
      // Too many already, if all cells had some.
      if (static_cast<double>(slices) > source.MostSlices * static_cast<double>(n))
      {
        possible = false;
      }
    });
  if (aborted)
  {
    return Outcome::Aborted;
  }
  std::int64_t cells = 0;
  std::vector<std::int64_t> firsts(blocks.size() + 1, 0);
  for (std::size_t block = 0; block < blocks.size(); ++block)
  {
    cells += blocks[block].Cells;
    firsts[block + 1] = firsts[block] + static_cast<std::int64_t>(blocks[block].Parts.size());
  }
  const double perCell = cells > 0 ? static_cast<double>(slices) / static_cast<double>(cells) : 1;
  if (!possible || perCell > source.MostSlices || slices > MostSlicesOfAll)
  {
    return Outcome::Refused;
  }

  RawVector<Part> parts(firsts.back());
  begins[n] = static_cast<std::uint32_t>(firsts.back());
  ForEachBlock(n, makePart(DividedShare, 1),
    [&](std::int64_t begin, std::int64_t end, int block)
    {
      const std::vector<Part>& divided = blocks[block].Parts;
      std::copy(divided.begin(), divided.end(), parts.begin() + firsts[block]);
      for (std::int64_t cell = begin; cell < end; ++cell)
      {
        begins[cell] += static_cast<std::uint32_t>(firsts[block]);
      }
    });
  if (aborted)
  {
    return Outcome::Aborted;
  }
  this->Sliced = slices > firsts.back();
  this->Parts = std::move(parts);
  this->Begins = std::move(begins);
  this->Ends = std::move(ends);
  return Outcome::Made;
}

std::int64_t CellDivision::GetNumberOfSlices(std::int32_t cell) const
{
  std::int64_t sum = 0;
  for (const Part& part : this->GetParts(cell))
  {
    sum += part.Slices;
  }
  return sum;
}

void CellDivision::FindOrder(
  std::int32_t cell, double eyeScalar, bool frontToBack, std::vector<Slice>& result) const
{
  result.clear();
  const Span<const Part> parts = this->GetParts(cell);
  const auto add = [&](const Part& part)
  {
    for (int k = 0; k < static_cast<int>(part.Slices); ++k)
    {
      result.push_back({ part, k });
    }
  };
  // Rays from the eye go up through what is above it, and down through what is below.
  std::size_t above = 0;
  while (above < parts.size() && this->Ends[parts[above].Interval] <= eyeScalar)
  {
    ++above;
  }
  for (std::size_t k = above; k < parts.size(); ++k)
  {
    add(parts[k]);
  }
  for (std::size_t k = above; k-- > 0;)
  {
    add(parts[k]);
  }
  if (!frontToBack)
  {
    std::reverse(result.begin(), result.end());
  }
}

} // namespace tetralux
