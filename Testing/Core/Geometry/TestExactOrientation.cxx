// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/ExactOrientation.h"

#include "Rationals.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace
{

using Vector = std::array<double, 3>;
using Corners = std::array<Vector, 4>;

/// At the smallest ones volumes are denormal numbers, or none; at the largest one they are
/// infinite.
constexpr double Scales[] = { 1e-120, 1e-104, 1e-102, 1e-30, 1e-7, 1, 1e7, 1e30, 1e105 };

/// Draws four points that are nearly in one plane, or in it: the last one is a combination of the
/// others, rounded, then moved by up to two roundings in each coordinate.
class NearlyFlat
{
public:
  NearlyFlat(double scale, double offset)
    : Scale(scale)
    , Offset(offset)
  {
  }

  Corners Draw()
  {
    Corners corners;
    for (int i = 0; i < 3; ++i)
    {
      for (double& value : corners[i])
      {
        value = this->Offset + this->Scale * this->Uniform(this->Random);
      }
    }
    const double s = this->Uniform(this->Random);
    const double t = this->Uniform(this->Random);
    for (int a = 0; a < 3; ++a)
    {
      const double origin = corners[0][a];
      double value = origin + s * (corners[1][a] - origin) + t * (corners[2][a] - origin);
      for (int steps = static_cast<int>(this->Random() % 5) - 2; steps != 0;
           steps += steps < 0 ? 1 : -1)
      {
        value = std::nextafter(value, steps < 0 ? -this->Infinity : this->Infinity);
      }
      corners[3][a] = value;
    }
    return corners;
  }

  /// Coordinates of few bits, of which many are exactly flat.
  Corners DrawFromGrid()
  {
    Corners corners;
    for (Vector& corner : corners)
    {
      for (double& value : corner)
      {
        value = this->Offset + this->Scale * static_cast<double>(this->Random() % 4);
      }
    }
    return corners;
  }

private:
  static constexpr double Infinity = std::numeric_limits<double>::infinity();
  double Scale;
  double Offset;
  std::mt19937_64 Random{ 1 };
  std::uniform_real_distribution<double> Uniform{ -1, 1 };
};

/// Calls check for points of all scales and of offsets that leave few digits.
void ForEachFlat(const std::function<void(const Corners&)>& check)
{
  const auto draw = [&check](double scale, double offset)
  {
    SCOPED_TRACE(testing::Message() << "scale " << scale << ", offset " << offset);
    NearlyFlat points(scale, offset);
    for (int i = 0; i < 300; ++i)
    {
      check(points.Draw());
      check(points.DrawFromGrid());
    }
  };
  for (const double scale : Scales)
  {
    draw(scale, 0);
  }
  for (const double scale : { 1e-3, 1., 1e3 })
  {
    draw(scale, 1e7);
  }
}

rationals::Number Cross(const Vector& p, const Vector& q, const Vector& r, int x, int y)
{
  using rationals::MakeNumber;
  return (MakeNumber(q[x]) - MakeNumber(p[x])) * (MakeNumber(r[y]) - MakeNumber(p[y])) -
    (MakeNumber(q[y]) - MakeNumber(p[y])) * (MakeNumber(r[x]) - MakeNumber(p[x]));
}

} // namespace

TEST(ExactOrientation, UnitTetrahedronIsPositive)
{
  const Vector o = { 0, 0, 0 }, x = { 1, 0, 0 }, y = { 0, 1, 0 }, z = { 0, 0, 1 };
  EXPECT_EQ(tetralux::GetOrientation(o.data(), x.data(), y.data(), z.data()), 1);
  EXPECT_EQ(tetralux::GetOrientation(x.data(), o.data(), y.data(), z.data()), -1);
  EXPECT_EQ(tetralux::GetOrientation(o.data(), x.data(), y.data(), y.data()), 0);
}

TEST(ExactOrientation, SignsOfVolumesAreThoseOfRationals)
{
  int counts[3] = { 0, 0, 0 };
  ForEachFlat(
    [&counts](const Corners& p)
    {
      const int sign =
        rationals::GetOrientation(p[0].data(), p[1].data(), p[2].data(), p[3].data());
      ++counts[sign + 1];
      EXPECT_EQ(tetralux::GetOrientation(p[0].data(), p[1].data(), p[2].data(), p[3].data()), sign);
      EXPECT_EQ(
        tetralux::GetExactOrientation(p[0].data(), p[1].data(), p[2].data(), p[3].data()), sign);
      EXPECT_EQ(
        tetralux::GetOrientation(p[1].data(), p[0].data(), p[2].data(), p[3].data()), -sign);
    });
  for (const int count : counts)
  {
    EXPECT_GT(count, 300); // each sign was met
  }
}

TEST(ExactOrientation, TurnsAlongDirectionsAreThoseOfRationals)
{
  int counts[3] = { 0, 0, 0 };
  ForEachFlat(
    [&counts](const Corners& p)
    {
      // The direction is in the plane of the three, to rounding.
      Vector direction;
      for (int a = 0; a < 3; ++a)
      {
        direction[a] = p[3][a] - p[0][a];
      }
      const rationals::Point origin = rationals::MakePoint(p[0].data());
      const int sign =
        -rationals::GetDeterminant(rationals::Subtract(rationals::MakePoint(p[1].data()), origin),
          rationals::Subtract(rationals::MakePoint(p[2].data()), origin),
          rationals::MakePoint(direction.data()))
           .sign();
      ++counts[sign + 1];
      EXPECT_EQ(
        tetralux::GetDirectionTurn(p[0].data(), p[1].data(), p[2].data(), direction.data()), sign);
      EXPECT_EQ(
        tetralux::GetExactDirectionTurn(p[0].data(), p[1].data(), p[2].data(), direction.data()),
        sign);
    });
  for (const int count : counts)
  {
    EXPECT_GT(count, 300);
  }
}

TEST(ExactOrientation, DirectionTurnIsThatOfAFarViewer)
{
  // Counter-clockwise for a viewer above the plane z = 0 who looks down.
  const Vector o = { 0, 0, 0 }, x = { 1, 0, 0 }, y = { 0, 1, 0 };
  const Vector down = { 0.1, 0.2, -1 }, along = { 1, 2, 0 };
  EXPECT_EQ(tetralux::GetDirectionTurn(o.data(), x.data(), y.data(), down.data()), 1);
  EXPECT_EQ(tetralux::GetDirectionTurn(o.data(), y.data(), x.data(), down.data()), -1);
  EXPECT_EQ(tetralux::GetDirectionTurn(o.data(), x.data(), y.data(), along.data()), 0);
}

TEST(ExactOrientation, ProjectedTurnsAreThoseOfRationals)
{
  int counts[3] = { 0, 0, 0 };
  NearlyFlat draws[] = { { 1, 0 }, { 1e-30, 0 }, { 1e30, 0 }, { 1, 1e7 }, { 1e-160, 0 },
    { 1e-155, 0 }, { 1e155, 0 } };
  std::mt19937_64 random(2);
  for (NearlyFlat& draw : draws)
  {
    for (int i = 0; i < 300; ++i)
    {
      Corners p = i % 2 == 0 ? draw.Draw() : draw.DrawFromGrid();
      if (i % 4 == 0) // nearly collinear
      {
        const double s = std::ldexp(static_cast<double>(random() >> 11), -53);
        for (int a = 0; a < 3; ++a)
        {
          p[2][a] = p[0][a] + s * (p[1][a] - p[0][a]);
        }
      }
      const tetralux::ExactPoints points(p[0].data());
      for (int axis = 0; axis < 3; ++axis)
      {
        const int sign = Cross(p[0], p[1], p[2], axis == 0 ? 1 : 0, axis == 2 ? 1 : 2).sign();
        ++counts[sign + 1];
        EXPECT_EQ(points.OrientProjected(0, 1, 2, axis), sign);
      }
      const int axis = points.FindProjection(0, 1, 2);
      const bool hasArea = Cross(p[0], p[1], p[2], 0, 1).sign() != 0 ||
        Cross(p[0], p[1], p[2], 0, 2).sign() != 0 || Cross(p[0], p[1], p[2], 1, 2).sign() != 0;
      EXPECT_EQ(axis >= 0, hasArea);
      EXPECT_TRUE(axis < 0 || points.OrientProjected(0, 1, 2, axis) != 0);
    }
  }
  for (const int count : counts)
  {
    EXPECT_GT(count, 200);
  }
}

TEST(ExactOrientation, RepeatedIdsHaveNoVolume)
{
  const std::vector<double> coordinates = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  const tetralux::ExactPoints points(coordinates.data());
  EXPECT_EQ(points.Orient(0, 1, 2, 3), 1);
  EXPECT_EQ(points.Orient(0, 1, 2, 1), 0);
  EXPECT_EQ(points.OrientProjected(0, 1, 0, 2), 0);
  EXPECT_EQ(points.OrientProjected(0, 1, 2, 2), 1);
  EXPECT_EQ(points.FindProjection(0, 1, 2), 2);
}

TEST(ExactOrientation, TinyTrianglesHaveAProjection)
{
  // All components of the normal underflow, so that only exact signs tell which one is not 0.
  const std::vector<double> coordinates = { 0, 0, 0, 1e-200, 0, 0, 0, 1e-200, 0, 2e-200, 0, 0 };
  const tetralux::ExactPoints points(coordinates.data());
  EXPECT_EQ(points.FindProjection(0, 1, 2), 2);
  EXPECT_EQ(points.FindProjection(0, 1, 3), -1);
}
