// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/LinearProgram.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{

using tetralux::HalfSpace;

template <int Dimension>
using Vector = std::array<double, Dimension>;

/// The largest error of a value or a violation, for normals of unit length and x up to Reach:
/// vertices of nearly parallel planes are left out, so rounding grows by less than 1e5 from 1e-15.
constexpr double Tolerance = 1e-9;
constexpr double Reach = 10;

template <int Dimension>
double Dot(const Vector<Dimension>& a, const Vector<Dimension>& b)
{
  double sum = 0;
  for (int d = 0; d < Dimension; ++d)
  {
    sum += a[d] * b[d];
  }
  return sum;
}

/// Solves Dimension equations; false where the planes are nearly parallel.
template <int Dimension>
bool FindVertex(std::array<HalfSpace<Dimension>, Dimension> planes, Vector<Dimension>& x)
{
  for (int column = 0; column < Dimension; ++column)
  {
    int pivot = column;
    for (int row = column; row < Dimension; ++row)
    {
      pivot =
        std::abs(planes[row].Normal[column]) > std::abs(planes[pivot].Normal[column]) ? row : pivot;
    }
    std::swap(planes[column], planes[pivot]);
    constexpr double smallestPivot = 1e-5;
    if (std::abs(planes[column].Normal[column]) < smallestPivot)
    {
      return false;
    }
    for (int row = 0; row < Dimension; ++row)
    {
      if (row != column)
      {
        const double factor = planes[row].Normal[column] / planes[column].Normal[column];
        for (int d = 0; d < Dimension; ++d)
        {
          planes[row].Normal[d] -= factor * planes[column].Normal[d];
        }
        planes[row].Limit -= factor * planes[column].Limit;
      }
    }
  }
  for (int d = 0; d < Dimension; ++d)
  {
    x[d] = planes[d].Limit / planes[d].Normal[d];
  }
  return true;
}

/// The largest objective of all vertices that all half spaces have; -infinity where there is none.
template <int Dimension>
double SolveByVertices(
  const std::vector<HalfSpace<Dimension>>& halfSpaces, const Vector<Dimension>& objective)
{
  double best = -std::numeric_limits<double>::infinity();
  std::array<std::size_t, Dimension> chosen{};
  const std::size_t size = halfSpaces.size();
  const auto isChosenAscending = [&chosen]
  {
    for (int d = 1; d < Dimension; ++d)
    {
      if (chosen[d] <= chosen[d - 1])
      {
        return false;
      }
    }
    return true;
  };
  for (bool isLast = false; !isLast;)
  {
    if (isChosenAscending())
    {
      std::array<HalfSpace<Dimension>, Dimension> planes;
      for (int d = 0; d < Dimension; ++d)
      {
        planes[d] = halfSpaces[chosen[d]];
      }
      Vector<Dimension> x;
      if (FindVertex<Dimension>(planes, x))
      {
        bool isInside = true;
        for (const auto& halfSpace : halfSpaces)
        {
          isInside = isInside && Dot<Dimension>(halfSpace.Normal, x) <= halfSpace.Limit + Tolerance;
        }
        best = isInside ? std::max(best, Dot<Dimension>(objective, x)) : best;
      }
    }
    int d = 0;
    while (d < Dimension && ++chosen[d] == size)
    {
      chosen[d++] = 0;
    }
    isLast = d == Dimension;
  }
  return best;
}

template <int Dimension>
Vector<Dimension> DrawDirection(std::mt19937_64& random)
{
  std::normal_distribution<double> normal;
  Vector<Dimension> direction;
  double length = 0;
  for (double& value : direction)
  {
    value = normal(random);
    length += value * value;
  }
  for (double& value : direction)
  {
    value /= std::sqrt(length);
  }
  return direction;
}

template <int Dimension>
std::vector<HalfSpace<Dimension>> MakeBox()
{
  std::vector<HalfSpace<Dimension>> box;
  for (int d = 0; d < Dimension; ++d)
  {
    for (const double side : { 1., -1. })
    {
      HalfSpace<Dimension> halfSpace{ {}, Reach };
      halfSpace.Normal[d] = side;
      box.push_back(halfSpace);
    }
  }
  return box;
}

template <int Dimension>
void CompareWithVertices(int numberOfPrograms, int numberOfHalfSpaces)
{
  SCOPED_TRACE(testing::Message() << Dimension << " dimensions");
  std::mt19937_64 random(Dimension);
  std::uniform_real_distribution<double> limit(-2, 4);
  int feasible = 0;
  for (int i = 0; i < numberOfPrograms; ++i)
  {
    auto halfSpaces = MakeBox<Dimension>();
    for (int k = 0; k < numberOfHalfSpaces; ++k)
    {
      halfSpaces.push_back({ DrawDirection<Dimension>(random), limit(random) });
    }
    if (i % 5 == 0) // the same plane twice, and one that only touches
    {
      halfSpaces.push_back(halfSpaces.back());
    }
    const auto objective = DrawDirection<Dimension>(random);
    const double expected = SolveByVertices<Dimension>(halfSpaces, objective);
    Vector<Dimension> x;
    const bool isSolved = tetralux::SolveLinearProgram<Dimension>(halfSpaces, objective, x);
    ASSERT_EQ(isSolved, std::isfinite(expected)) << "program " << i;
    if (isSolved)
    {
      ++feasible;
      EXPECT_NEAR(Dot<Dimension>(objective, x), expected, Tolerance) << "program " << i;
      for (const auto& halfSpace : halfSpaces)
      {
        EXPECT_LE(Dot<Dimension>(halfSpace.Normal, x), halfSpace.Limit + Tolerance);
      }
    }
  }
  EXPECT_GT(feasible, numberOfPrograms / 10);
  EXPECT_LT(feasible, numberOfPrograms);
}

} // namespace

TEST(LinearProgram, AsTheBestVertex)
{
  CompareWithVertices<1>(300, 2);
  CompareWithVertices<2>(300, 5);
  CompareWithVertices<3>(200, 8);
  CompareWithVertices<4>(60, 8);
}

TEST(LinearProgram, KnownSolutions)
{
  // The corner of a triangle.
  std::vector<HalfSpace<2>> triangle = MakeBox<2>();
  triangle.push_back({ { 1, 1 }, 1 });
  triangle.push_back({ { -1, 0 }, 0 });
  triangle.push_back({ { 0, -1 }, 0 });
  Vector<2> x;
  ASSERT_TRUE(tetralux::SolveLinearProgram<2>(triangle, { 2, 1 }, x));
  EXPECT_NEAR(x[0], 1, Tolerance);
  EXPECT_NEAR(x[1], 0, Tolerance);

  // Nothing is on both sides of a gap.
  triangle.push_back({ { -1, -1 }, -1.5 });
  EXPECT_FALSE(tetralux::SolveLinearProgram<2>(triangle, { 2, 1 }, x));
}
