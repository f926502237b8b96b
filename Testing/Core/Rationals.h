// SPDX-License-Identifier: BSD-3-Clause
#ifndef Rationals_h
#define Rationals_h

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

/// Geometry in rational numbers, which knows no rounding: what exact and fast code is
/// compared with.
namespace rationals
{

using Number = boost::multiprecision::cpp_rational;
using Point = std::array<Number, 3>;

/// Exact for any finite value.
inline Number MakeNumber(double value)
{
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  Number number(static_cast<std::int64_t>(std::ldexp(fraction, 53)));
  exponent -= 53;
  const Number power(boost::multiprecision::cpp_int(1) << std::abs(exponent));
  return exponent < 0 ? Number(number / power) : Number(number * power);
}

inline Point MakePoint(const double* x)
{
  return { MakeNumber(x[0]), MakeNumber(x[1]), MakeNumber(x[2]) };
}

inline Point Subtract(const Point& p, const Point& q)
{
  return { p[0] - q[0], p[1] - q[1], p[2] - q[2] };
}

inline Number GetDeterminant(const Point& a, const Point& b, const Point& c)
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The sign of a tetrahedron's volume in VTK's order of points.
inline int GetOrientation(const double* a, const double* b, const double* c, const double* d)
{
  const Point origin = MakePoint(a);
  return GetDeterminant(
    Subtract(MakePoint(b), origin), Subtract(MakePoint(c), origin), Subtract(MakePoint(d), origin))
    .sign();
}

/// 1 if e is strictly inside of the sphere through a, b, c, d, whose volume is
/// positive; 0 if on it.
inline int GetSphereSide(
  const double* a, const double* b, const double* c, const double* d, const double* e)
{
  const Point center = MakePoint(e);
  Point rows[4];
  Number squares[4];
  const double* const corners[4] = { a, b, c, d };
  for (int i = 0; i < 4; ++i)
  {
    rows[i] = Subtract(MakePoint(corners[i]), center);
    squares[i] = rows[i][0] * rows[i][0] + rows[i][1] * rows[i][1] + rows[i][2] * rows[i][2];
  }
  // Laplace along the squares.
  const Number determinant = -squares[0] * GetDeterminant(rows[1], rows[2], rows[3]) +
    squares[1] * GetDeterminant(rows[0], rows[2], rows[3]) -
    squares[2] * GetDeterminant(rows[0], rows[1], rows[3]) +
    squares[3] * GetDeterminant(rows[0], rows[1], rows[2]);
  return -determinant.sign();
}

/// Solves a system of equations, each a row of coefficients and the right side. False if it has no
/// solution, or more than one.
inline bool Solve(std::vector<std::vector<Number>> rows, std::vector<Number>& solution)
{
  const std::size_t unknowns = rows[0].size() - 1;
  for (std::size_t column = 0; column < unknowns; ++column)
  {
    std::size_t pivot = column;
    while (pivot < rows.size() && rows[pivot][column].is_zero())
    {
      ++pivot;
    }
    if (pivot == rows.size())
    {
      return false;
    }
    std::swap(rows[column], rows[pivot]);
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
      if (row == column || rows[row][column].is_zero())
      {
        continue;
      }
      const Number factor = rows[row][column] / rows[column][column];
      for (std::size_t i = column; i <= unknowns; ++i)
      {
        rows[row][i] -= factor * rows[column][i];
      }
    }
  }
  for (std::size_t row = unknowns; row < rows.size(); ++row)
  {
    if (!rows[row][unknowns].is_zero())
    {
      return false;
    }
  }
  solution.resize(unknowns);
  for (std::size_t i = 0; i < unknowns; ++i)
  {
    solution[i] = rows[i][unknowns] / rows[i][i];
  }
  return true;
}

/// Whether no coordinate keeps two point sets apart.
inline bool DoBoxesMeet(const std::vector<Point>& points0, const std::vector<Point>& points1)
{
  for (int a = 0; a < 3; ++a)
  {
    const auto isLower = [a](const Point& p, const Point& q) { return p[a] < q[a]; };
    const auto [low0, high0] = std::minmax_element(points0.begin(), points0.end(), isLower);
    const auto [low1, high1] = std::minmax_element(points1.begin(), points1.end(), isLower);
    if (isLower(*high0, *low1) || isLower(*high1, *low0))
    {
      return false;
    }
  }
  return true;
}

/// The points of a simplex that a mask has bits for.
inline std::vector<Point> GetFace(const std::vector<Point>& simplex, unsigned mask)
{
  std::vector<Point> face;
  for (std::size_t i = 0; i < simplex.size(); ++i)
  {
    if ((mask >> i & 1) != 0)
    {
      face.push_back(simplex[i]);
    }
  }
  return face;
}

/// The corners of the intersection of two simplices, in any order and possibly repeated:
/// the points in which a face of the one, of any dimension, and a face of the other have
/// nothing else in common.
inline std::vector<Point> IntersectSimplices(
  const std::vector<Point>& simplex0, const std::vector<Point>& simplex1)
{
  std::vector<Point> corners;
  for (unsigned mask0 = 1; mask0 < 1U << simplex0.size(); ++mask0)
  {
    for (unsigned mask1 = 1; mask1 < 1U << simplex1.size(); ++mask1)
    {
      const std::vector<Point> face0 = GetFace(simplex0, mask0);
      const std::vector<Point> face1 = GetFace(simplex1, mask1);
      // Two planes that meet in one point have together no more than three dimensions.
      if (face0.size() + face1.size() > 5 || !DoBoxesMeet(face0, face1))
      {
        continue;
      }
      // Weights of the corners of the two faces, each adding up to 1, for the same point.
      std::vector<std::vector<Number>> rows(5);
      for (const Point& point : face0)
      {
        for (int a = 0; a < 3; ++a)
        {
          rows[a].push_back(point[a]);
        }
        rows[3].push_back(1);
        rows[4].push_back(0);
      }
      for (const Point& point : face1)
      {
        for (int a = 0; a < 3; ++a)
        {
          rows[a].push_back(-point[a]);
        }
        rows[3].push_back(0);
        rows[4].push_back(1);
      }
      for (int row = 0; row < 5; ++row)
      {
        rows[row].push_back(row < 3 ? 0 : 1);
      }
      std::vector<Number> weights;
      if (!Solve(std::move(rows), weights))
      {
        continue;
      }
      bool isInside = true;
      for (const Number& weight : weights)
      {
        isInside = isInside && weight >= 0;
      }
      if (isInside)
      {
        Point corner = { 0, 0, 0 };
        for (std::size_t i = 0; i < face0.size(); ++i)
        {
          for (int a = 0; a < 3; ++a)
          {
            corner[a] += weights[i] * face0[i][a];
          }
        }
        corners.push_back(corner);
      }
    }
  }
  return corners;
}

} // namespace rationals

#endif
