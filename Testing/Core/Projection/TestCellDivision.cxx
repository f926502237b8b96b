// SPDX-License-Identifier: BSD-3-Clause
// Parts of cells against what rays meet, point by point.
#include "Projection/CellDivision.h"

#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{

using tetralux::CellDivision;
using Outcome = tetralux::CellDivision::Outcome;
using tetralux::DivisionSource;
using tetralux::IntervalTable;
using tetralux::ScreenPoint;

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Attenuation rises and falls between the nodes, and is zero between the second and the third.
IntervalTable MakeTable(double attenuation)
{
  tetralux::TransferFunction function;
  const auto add = [&](double scalar, double value)
  {
    const tetralux::TransferFunction::Value at{ { 1, 0, 0 }, attenuation * value };
    function.Nodes.push_back({ scalar, at, at });
  };
  add(-1, 1);
  add(-0.5, 0);
  add(-0.25, 0);
  add(0, 1);
  add(0.5, 0.25);
  add(1, 0.5);
  return tetralux::MakeIntervalTable(function);
}

/// Random tetrahedra with linear fields; some have nodes of the function for scalars.
class CellDivisionTest : public testing::Test
{
public:
  static constexpr int NumberOfCells = 400;

  CellDivisionTest()
  {
    const auto scalar = [this]
    {
      constexpr float Nodes[] = { -1, -0.5, -0.25, 0, 0.5, 1 };
      return this->Random() % 3 == 0 ? Nodes[this->Random() % 6] : 2.4 * this->Unit() - 1.2;
    };
    for (int cell = 0; cell < NumberOfCells; ++cell)
    {
      const double constant = scalar();
      for (int k = 0; k < 4; ++k)
      {
        for (int a = 0; a < 3; ++a)
        {
          this->Coordinates.push_back(this->Unit());
        }
        ScreenPoint point = {};
        point.Scalar = static_cast<float>(cell % 10 == 0 ? constant : scalar());
        this->Points.push_back(point);
        this->Cells.push_back(static_cast<int>(this->Cells.size()));
      }
    }
  }

  double Unit() { return static_cast<double>(this->Random() >> 8) / (1 << 24); }

  DivisionSource MakeSource(const IntervalTable& table, double largestDepth) const
  {
    DivisionSource source;
    source.Intervals = table.Intervals;
    source.Points = this->Points;
    source.Coordinates = this->Coordinates;
    source.Cells = this->Cells;
    source.LargestDepth = largestDepth;
    source.MostSlices = Infinity;
    return source;
  }

  /// A point of a cell by its shares of the corners.
  std::array<double, 3> GetPlace(int cell, const double shares[4]) const
  {
    std::array<double, 3> place = { 0, 0, 0 };
    for (int k = 0; k < 4; ++k)
    {
      for (int a = 0; a < 3; ++a)
      {
        place[a] += shares[k] * this->Coordinates[3 * (4 * cell + k) + a];
      }
    }
    return place;
  }
  double GetScalar(int cell, const double shares[4]) const
  {
    double scalar = 0;
    for (int k = 0; k < 4; ++k)
    {
      scalar += shares[k] * this->Points[4 * cell + k].Scalar;
    }
    return scalar;
  }

  /// So many times as many cells, of the same points.
  void RepeatCells(int times)
  {
    const std::vector<std::int32_t> once = this->Cells;
    for (int k = 1; k < times; ++k)
    {
      this->Cells.insert(this->Cells.end(), once.begin(), once.end());
    }
  }

  std::mt19937 Random{ 5 };
  std::vector<ScreenPoint> Points;
  std::vector<double> Coordinates;
  std::vector<std::int32_t> Cells;
};

TEST_F(CellDivisionTest, EachScalarOfACellIsInOnePartWhereItAttenuates)
{
  const IntervalTable table = MakeTable(1);
  CellDivision division;
  ASSERT_EQ(division.Make(this->MakeSource(table, Infinity)), Outcome::Made);
  EXPECT_FALSE(division.HasSlices());
  for (int cell = 0; cell < NumberOfCells; ++cell)
  {
    float lo = this->Points[4 * cell].Scalar;
    float hi = lo;
    for (int k = 1; k < 4; ++k)
    {
      lo = std::min(lo, static_cast<float>(this->Points[4 * cell + k].Scalar));
      hi = std::max(hi, static_cast<float>(this->Points[4 * cell + k].Scalar));
    }
    for (int step = 0; step <= 40; ++step)
    {
      const auto scalar = static_cast<float>(lo + (hi - lo) * (step / 40.));
      int parts = 0;
      for (const CellDivision::Part& part : division.GetParts(cell))
      {
        const IntervalTable::Interval& interval = table.Intervals[part.Interval];
        parts +=
          (part.OpenBelow || interval.Lo <= scalar) && (part.OpenAbove || scalar < interval.Hi);
      }
      double attenuation = 0;
      for (const IntervalTable::Interval& interval : table.Intervals)
      {
        const bool inside = interval.Lo <= scalar && scalar < interval.Hi;
        attenuation += inside
          ? interval.Attenuation + interval.AttenuationSlope * (scalar - interval.Reference)
          : 0;
      }
      EXPECT_LE(parts, 1);
      EXPECT_TRUE(parts == 1 || attenuation == 0) << cell << ", scalar " << scalar;
    }
  }
}

TEST_F(CellDivisionTest, RaysGoThroughPartsInTheirOrder)
{
  const IntervalTable table = MakeTable(1);
  CellDivision division;
  ASSERT_EQ(division.Make(this->MakeSource(table, Infinity)), Outcome::Made);
  std::vector<CellDivision::Slice> order;
  int inside = 0;
  for (int cell = 0; cell < NumberOfCells; ++cell)
  {
    for (int ray = 0; ray < 20; ++ray)
    {
      // The eye anywhere, by its shares of the corners, which add up to 1.
      double eye[4] = { 6 * this->Unit() - 3, 6 * this->Unit() - 3, 6 * this->Unit() - 3, 0 };
      eye[3] = 1 - eye[0] - eye[1] - eye[2];
      double aim[4] = { this->Unit(), this->Unit(), this->Unit(), this->Unit() };
      const double sum = aim[0] + aim[1] + aim[2] + aim[3];
      std::transform(aim, aim + 4, aim, [sum](double share) { return share / sum; });
      const double eyeScalar = this->GetScalar(cell, eye);
      division.FindOrder(cell, eyeScalar, true, order);
      std::vector<CellDivision::Slice> reverse;
      division.FindOrder(cell, eyeScalar, false, reverse);
      std::size_t place = 0;
      for (int step = 0; step <= 400; ++step)
      {
        const double t = step / 200.;
        double shares[4];
        for (int k = 0; k < 4; ++k)
        {
          shares[k] = eye[k] + t * (aim[k] - eye[k]);
        }
        if (*std::min_element(shares, shares + 4) < 0)
        {
          continue;
        }
        const double scalar = this->GetScalar(cell, shares);
        const auto holds = [&](const CellDivision::Slice& slice)
        {
          const IntervalTable::Interval& interval = table.Intervals[slice.Of.Interval];
          return interval.Lo <= scalar && scalar < interval.Hi;
        };
        const auto found = std::find_if(order.begin(), order.end(), holds);
        if (found != order.end())
        {
          const auto next = static_cast<std::size_t>(found - order.begin());
          EXPECT_GE(next, place) << "cell " << cell << ", ray " << ray;
          place = next;
          inside += order.size() > 1;
          const auto last = std::find_if(reverse.begin(), reverse.end(), holds);
          EXPECT_EQ(reverse.end() - last, found - order.begin() + 1);
        }
      }
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST_F(CellDivisionTest, NoSliceIsThick)
{
  const IntervalTable table = MakeTable(3);
  constexpr double LargestDepth = 0.5;
  CellDivision division;
  DivisionSource source = this->MakeSource(table, LargestDepth);
  source.LengthScale = 2;
  ASSERT_EQ(division.Make(source), Outcome::Made);
  EXPECT_TRUE(division.HasSlices());
  std::vector<CellDivision::Slice> order;
  for (int cell = 0; cell < NumberOfCells; ++cell)
  {
    for (const CellDivision::Part& part : division.GetParts(cell))
    {
      const IntervalTable::Interval& interval = table.Intervals[part.Interval];
      for (int pair = 0; pair < 16; ++pair)
      {
        double ends[2][4] = {};
        ends[0][pair % 4] = 1;
        ends[1][pair / 4] = 1;
        const auto p = this->GetPlace(cell, ends[0]);
        const auto q = this->GetPlace(cell, ends[1]);
        const double length = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        const double scalar =
          std::clamp<double>(this->GetScalar(cell, ends[0]), interval.Lo, interval.Hi);
        const double attenuation =
          interval.Attenuation + interval.AttenuationSlope * (scalar - interval.Reference);
        constexpr double Rounding = 1e-6; // of attenuations in single precision
        EXPECT_LE(
          source.LengthScale * length * attenuation / part.Slices, LargestDepth * (1 + Rounding));
      }
    }
    division.FindOrder(cell, 0, true, order);
    EXPECT_EQ(static_cast<std::int64_t>(order.size()), division.GetNumberOfSlices(cell));
    for (std::size_t k = 1; k < order.size(); ++k)
    {
      const bool same = order[k].Of.Interval == order[k - 1].Of.Interval;
      EXPECT_EQ(order[k].Index, same ? order[k - 1].Index + 1 : 0);
    }
  }
}

TEST_F(CellDivisionTest, IsNotMadeOfTooManyParts)
{
  const IntervalTable table = MakeTable(1);
  CellDivision division;
  DivisionSource source = this->MakeSource(table, Infinity);
  ASSERT_EQ(division.Make(source), Outcome::Made);
  std::int64_t parts = 0;
  int cells = 0;
  for (int cell = 0; cell < NumberOfCells; ++cell)
  {
    parts += division.GetNumberOfSlices(cell);
    cells += division.GetParts(cell).empty() ? 0 : 1;
  }
  const double perCell = static_cast<double>(parts) / cells;
  EXPECT_GT(perCell, 1);
  source.MostSlices = 1.01 * perCell;
  EXPECT_EQ(division.Make(source), Outcome::Made);
  source.MostSlices = 0.99 * perCell;
  EXPECT_EQ(division.Make(source), Outcome::Refused);
  EXPECT_TRUE(division.IsEmpty());

  // A cell that is too thick, or whose scalars shaders can't hold.
  source.MostSlices = Infinity;
  source.LargestDepth = 1e-3;
  EXPECT_EQ(division.Make(source), Outcome::Refused);
  source.LargestDepth = Infinity;
  this->Points[0].Scalar = 1e35;
  EXPECT_EQ(division.Make(source), Outcome::Refused);
  this->Points[0].Scalar = std::nan("");
  ASSERT_EQ(division.Make(source), Outcome::Made);
  EXPECT_TRUE(division.GetParts(0).empty());
}

/// All parts, cell by cell.
std::vector<std::array<std::uint32_t, 5>> ListParts(const CellDivision& division, std::size_t cells)
{
  std::vector<std::array<std::uint32_t, 5>> list;
  for (std::uint32_t cell = 0; cell < cells; ++cell)
  {
    for (const CellDivision::Part& part : division.GetParts(static_cast<std::int32_t>(cell)))
    {
      list.push_back({ cell, part.Interval, part.Slices, part.OpenBelow, part.OpenAbove });
    }
  }
  return list;
}

TEST_F(CellDivisionTest, AnAbortLeavesNothingAndTheNextOneIsComplete)
{
  this->RepeatCells(100);
  const std::size_t cells = this->Cells.size() / 4;
  const IntervalTable table = MakeTable(3);
  const DivisionSource source = this->MakeSource(table, 0.5);
  CellDivision expected;
  ASSERT_EQ(expected.Make(source), Outcome::Made);
  const auto parts = ListParts(expected, cells);
  // Of each of three passes over many blocks the end is told at least.
  constexpr int Passes = 3;
  ForEachThreadCount(
    [&]
    {
      std::vector<double> told;
      CellDivision division;
      ASSERT_EQ(division.Make(source,
                  [&](double share)
                  {
                    told.push_back(share);
                    return true;
                  }),
        Outcome::Made);
      EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
      ASSERT_GE(told.size(), static_cast<std::size_t>(Passes));
      EXPECT_GE(told.front(), 0);
      EXPECT_EQ(told.back(), 1);
      EXPECT_EQ(ListParts(division, cells), parts);
      for (int last = 1; last <= Passes; ++last)
      {
        int calls = 0;
        EXPECT_EQ(division.Make(source, [&](double) { return ++calls < last; }), Outcome::Aborted);
        EXPECT_EQ(calls, last);
        EXPECT_TRUE(division.IsEmpty());
        EXPECT_FALSE(division.HasSlices());
        EXPECT_EQ(division.GetNumberOfBytes(), 0u);
      }
      ASSERT_EQ(division.Make(source), Outcome::Made);
      EXPECT_EQ(ListParts(division, cells), parts);
    });
}

TEST_F(CellDivisionTest, EdgesThatAreKnownToBeShortNeedNotBeMeasured)
{
  const IntervalTable table = MakeTable(3);
  DivisionSource source = this->MakeSource(table, 0.5);
  CellDivision measured;
  ASSERT_EQ(measured.Make(source), Outcome::Made);
  source.LongestEdge = std::sqrt(3.); // of the unit cube
  CellDivision known;
  ASSERT_EQ(known.Make(source), Outcome::Made);
  EXPECT_EQ(ListParts(known, NumberOfCells), ListParts(measured, NumberOfCells));
}

} // namespace
