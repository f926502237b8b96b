// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/MinMaxTree.h"
#include "Hierarchy/MinMaxTreeBuilder.h"
#include "Hierarchy/MinMaxTreeUpward.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

namespace tetralux
{
namespace
{

/// The middle of a cell's box.
struct CellMiddle
{
  float Middle[3];
  std::int32_t Cell;

  void Set(const float* lower, const float* upper)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Middle[a] = 0.5f * lower[a] + 0.5f * upper[a];
    }
  }
  float GetMiddle(int a) const { return this->Middle[a]; }
};

/// A cell's box.
struct CellBox
{
  float Lower[3];
  float Upper[3];
  std::int32_t Cell;

  void Set(const float* lower, const float* upper)
  {
    std::copy_n(lower, 3, this->Lower);
    std::copy_n(upper, 3, this->Upper);
  }
  float GetMiddle(int a) const { return 0.5f * this->Lower[a] + 0.5f * this->Upper[a]; }
};

struct SplitAtSpatialMedian
{
  CellMiddle* operator()(CellMiddle* begin, CellMiddle* end, const MiddleBox& box) const
  {
    const int axis = box.GetLongestAxis();
    const float plane = 0.5f * box.Lower[axis] + 0.5f * box.Upper[axis];
    return PartitionItems(
      begin, end, [axis, plane](const CellMiddle& cell) { return cell.Middle[axis] < plane; });
  }
};

struct SplitBySurfaceArea
{
  static constexpr int NumberOfBins = 16;

  struct Bin
  {
    std::array<float, 3> Lower;
    std::array<float, 3> Upper;
    std::int32_t Count = 0;

    Bin()
    {
      this->Lower.fill(std::numeric_limits<float>::max());
      this->Upper.fill(std::numeric_limits<float>::lowest());
    }
    template <class Box>
    void Add(const Box& box, std::int32_t count)
    {
      for (int a = 0; a < 3; ++a)
      {
        this->Lower[a] = std::min(this->Lower[a], box.Lower[a]);
        this->Upper[a] = std::max(this->Upper[a], box.Upper[a]);
      }
      this->Count += count;
    }
    /// Area of the box times number of cells. In double precision, where no area overflows.
    double GetCost() const
    {
      const double x = double{ this->Upper[0] } - this->Lower[0];
      const double y = double{ this->Upper[1] } - this->Lower[1];
      const double z = double{ this->Upper[2] } - this->Lower[2];
      return (x * y + y * z + z * x) * this->Count;
    }
  };

  /// Equal bins from the lower to the upper end of a box.
  struct Axis
  {
    int Number;
    double Lower;
    double BinsPerLength;

    Axis(const MiddleBox& box, int number)
      : Number(number)
      , Lower(box.Lower[number])
      , BinsPerLength(NumberOfBins / (box.Upper[number] - this->Lower))
    {
    }
    int FindBin(const CellBox& cell) const
    {
      const double x = cell.GetMiddle(this->Number) - this->Lower;
      return std::min(NumberOfBins - 1, static_cast<int>(x * this->BinsPerLength));
    }
  };

  CellBox* operator()(CellBox* begin, CellBox* end, const MiddleBox& box) const
  {
    int bestAxis = -1;
    int bestBin = 0;
    double bestCost = std::numeric_limits<double>::max();
    for (int a = 0; a < 3; ++a)
    {
      if (!(box.Lower[a] < box.Upper[a]))
      {
        continue;
      }
      const Axis axis(box, a);
      std::array<Bin, NumberOfBins> bins;
      for (const CellBox* cell = begin; cell < end; ++cell)
      {
        bins[axis.FindBin(*cell)].Add(*cell, 1);
      }
      std::array<double, NumberOfBins> right{};
      Bin sweep;
      for (int k = NumberOfBins - 1; k > 0; --k)
      {
        sweep.Add(bins[k], bins[k].Count);
        right[k] = sweep.Count > 0 ? sweep.GetCost() : -1;
      }
      sweep = Bin();
      for (int k = 1; k < NumberOfBins; ++k)
      {
        sweep.Add(bins[k - 1], bins[k - 1].Count);
        if (sweep.Count == 0 || right[k] < 0)
        {
          continue;
        }
        const double cost = sweep.GetCost() + right[k];
        if (cost < bestCost)
        {
          bestCost = cost;
          bestAxis = a;
          bestBin = k;
        }
      }
    }
    if (bestAxis < 0)
    {
      return begin;
    }
    const Axis axis(box, bestAxis);
    return PartitionItems(
      begin, end, [&axis, bestBin](const CellBox& cell) { return axis.FindBin(cell) < bestBin; });
  }
};

/// In single precision, cut to finite numbers.
float ToFloat(double x)
{
  constexpr double Largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -Largest, Largest));
}

/// An item for each cell; boxes are rounded to nearest, they only guide the build.
template <class Item>
std::unique_ptr<Item[]> MakeItems(
  const TetrahedralMesh& mesh, const double center[3], double radius, int numberOfThreads)
{
  const auto numberOfPoints = static_cast<std::int64_t>(mesh.GetNumberOfPoints());
  const auto numberOfCells = static_cast<std::int64_t>(mesh.GetNumberOfCells());
  const auto points = NewArray<std::array<float, 4>>(numberOfPoints);
  auto items = NewArray<Item>(numberOfCells);
#pragma omp parallel num_threads(numberOfThreads)
  {
#pragma omp for schedule(static)
    for (std::int64_t p = 0; p < numberOfPoints; ++p)
    {
      for (int a = 0; a < 3; ++a)
      {
        points[p][a] = ToFloat((mesh.Points[3 * p + a] - center[a]) / radius);
      }
      points[p][3] = 0;
    }
#pragma omp for schedule(static)
    for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
    {
      const std::int32_t* ids = &mesh.Cells[4 * cell];
      std::array<float, 4> lower = points[ids[0]];
      std::array<float, 4> upper = lower;
      for (int corner = 1; corner < 4; ++corner)
      {
        for (int a = 0; a < 4; ++a)
        {
          lower[a] = std::min(lower[a], points[ids[corner]][a]);
          upper[a] = std::max(upper[a], points[ids[corner]][a]);
        }
      }
      items[cell].Set(lower.data(), upper.data());
      items[cell].Cell = static_cast<std::int32_t>(cell);
    }
  }
  return items;
}

} // namespace

MinMaxTree BuildMinMaxTree(const TetrahedralMesh& mesh, const double center[3], double radius,
  const MinMaxTreeOptions& options)
{
  const int threads = options.NumberOfThreads > 0 ? options.NumberOfThreads : omp_get_max_threads();
  const auto build = [&](auto items, const auto& split)
  {
    MinMaxTreeBuilder builder(std::move(items), static_cast<std::int64_t>(mesh.GetNumberOfCells()),
      split, options.LeafSize);
    return builder.Build(threads);
  };
  MinMaxTree tree = options.Build == TreeBuild::SpatialMedian
    ? build(MakeItems<CellMiddle>(mesh, center, radius, threads), SplitAtSpatialMedian())
    : build(MakeItems<CellBox>(mesh, center, radius, threads), SplitBySurfaceArea());
  RefitMinMaxTree(tree, mesh, center, radius, threads);
  return tree;
}

} // namespace tetralux
