// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/SteinerPoint.h"

#include "Geometry/LinearProgram.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

/// A pocket over points of its own, in coordinates where it is about as long in all directions:
/// what sees what does not depend on them. The last point is the one that is looked for.
class LocalPocket
{
public:
  LocalPocket(const ExactPoints& points, const Front& front)
  {
    const std::vector<std::int32_t> ids = GetFrontPoints(front);
    for (const Triangle& triangle : front)
    {
      Triangle local;
      std::transform(triangle.begin(), triangle.end(), local.begin(),
        [&ids](std::int32_t id) {
          return static_cast<std::int32_t>(
            std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
        });
      this->Triangles.push_back(local);
    }
    for (const std::int32_t id : ids)
    {
      this->Coordinates.insert(this->Coordinates.end(), points[id], points[id] + 3);
    }
    this->NumberOfPoints = static_cast<std::int32_t>(ids.size());
    this->Coordinates.resize(this->Coordinates.size() + 3);
    this->Whiten();
  }

  /// The point that sees all triangles from the largest distance to their planes.
  bool FindKernelPoint(Vector& position) const
  {
    std::vector<HalfSpace<4>> halfSpaces;
    // In these coordinates all points of the pocket are within 1 of its middle: a box far outside.
    constexpr double reach = 100;
    for (int d = 0; d < 3; ++d)
    {
      for (const double side : { 1., -1. })
      {
        HalfSpace<4> box{ {}, reach };
        box.Normal[d] = side;
        halfSpaces.push_back(box);
      }
    }
    halfSpaces.push_back({ { 0, 0, 0, 1 }, reach });
    std::vector<Triangle> shuffled = this->Triangles;
    std::mt19937_64 random(1);
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    for (const Triangle& triangle : shuffled)
    {
      const Vector p = this->GetWhite(triangle[0]);
      const Vector q = this->GetWhite(triangle[1]);
      const Vector r = this->GetWhite(triangle[2]);
      HalfSpace<4> plane{ {}, 0 };
      double length = 0;
      for (int a = 0; a < 3; ++a)
      {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        plane.Normal[a] = (q[c] - p[c]) * (r[b] - p[b]) - (q[b] - p[b]) * (r[c] - p[c]);
        length = std::hypot(length, plane.Normal[a]);
      }
      for (int a = 0; a < 3; ++a)
      {
        plane.Normal[a] /= length;
        plane.Limit += plane.Normal[a] * p[a];
      }
      plane.Normal[3] = 1;
      if (!(length > 0))
      {
        return false;
      }
      halfSpaces.push_back(plane);
    }
    std::array<double, 4> solution;
    if (!SolveLinearProgram<4>(halfSpaces, { 0, 0, 0, 1 }, solution) || !(solution[3] > 0))
    {
      return false;
    }
    position = this->GetPosition({ solution[0], solution[1], solution[2] });
    return true;
  }

  void SetPoint(const Vector& position)
  {
    std::copy(
      position.begin(), position.end(), &this->Coordinates[3 * std::size_t(this->NumberOfPoints)]);
  }

  /// Whether the point is on the positive side of a triangle.
  bool IsInFront(std::int32_t t) const
  {
    const auto [a, b, c] = this->Triangles[t];
    return ExactPoints(this->Coordinates.data()).Orient(a, b, c, this->NumberOfPoints) > 0;
  }

  /// Whether the point sees a triangle completely.
  bool Sees(std::int32_t t) const
  {
    const ExactPoints points(this->Coordinates.data());
    const auto [a, b, c] = this->Triangles[t];
    return this->IsInFront(t) &&
      std::all_of(this->Triangles.begin(), this->Triangles.end(),
        [&, a = a, b = b, c = c](const Triangle& triangle) {
          return CellFitsTriangle(points, { a, b, c, this->NumberOfPoints }, triangle);
        });
  }

  Vector GetMiddle(std::int32_t t) const
  {
    Vector middle;
    for (int a = 0; a < 3; ++a)
    {
      middle[a] = 0;
      for (const std::int32_t point : this->Triangles[t])
      {
        middle[a] += this->Coordinates[3 * static_cast<std::size_t>(point) + a] / 3;
      }
    }
    return middle;
  }
  Vector GetPoint(std::int32_t point) const
  {
    const double* p = &this->Coordinates[3 * static_cast<std::size_t>(point)];
    return { p[0], p[1], p[2] };
  }

  std::vector<Triangle> Triangles;
  std::int32_t NumberOfPoints = 0;

private:
  /// Cholesky's factor of the points' covariance.
  void Whiten()
  {
    double covariance[3][3] = {};
    for (int a = 0; a < 3; ++a)
    {
      this->Mean[a] = 0;
      for (std::int32_t i = 0; i < this->NumberOfPoints; ++i)
      {
        this->Mean[a] += this->GetPoint(i)[a] / this->NumberOfPoints;
      }
    }
    for (std::int32_t i = 0; i < this->NumberOfPoints; ++i)
    {
      const Vector p = this->GetPoint(i);
      for (int a = 0; a < 3; ++a)
      {
        for (int b = 0; b < 3; ++b)
        {
          covariance[a][b] += (p[a] - this->Mean[a]) * (p[b] - this->Mean[b]);
        }
      }
    }
    for (int a = 0; a < 3; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        double sum = covariance[a][b];
        for (int c = 0; c < b; ++c)
        {
          sum -= this->Factor[a][c] * this->Factor[b][c];
        }
        this->Factor[a][b] =
          a == b ? std::sqrt(std::max(sum, 1e-30 * covariance[a][a])) : sum / this->Factor[b][b];
      }
    }
  }
  Vector GetWhite(std::int32_t point) const
  {
    const Vector p = this->GetPoint(point);
    Vector white;
    for (int a = 0; a < 3; ++a)
    {
      white[a] = p[a] - this->Mean[a];
      for (int b = 0; b < a; ++b)
      {
        white[a] -= this->Factor[a][b] * white[b];
      }
      white[a] /= this->Factor[a][a];
    }
    return white;
  }
  Vector GetPosition(const Vector& white) const
  {
    Vector position = this->Mean;
    for (int a = 0; a < 3; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        position[a] += this->Factor[a][b] * white[b];
      }
    }
    return position;
  }

  std::vector<double> Coordinates;
  Vector Mean;
  double Factor[3][3] = {};
};

/// How many tests of a cell against a triangle a search for a point may cost.
constexpr std::int64_t MaximumTests = 200000;

} // namespace

//----------------------------------------------------------------------------
bool FindSteinerPoint(const ExactPoints& points, const Front& front, SteinerPoint& steiner)
{
  LocalPocket pocket(points, front);
  const auto size = static_cast<std::int32_t>(front.size());
  Vector position;
  if (pocket.FindKernelPoint(position))
  {
    pocket.SetPoint(position);
    steiner.Position = position;
    steiner.VisibleTriangles.clear();
    for (std::int32_t t = 0; t < size && pocket.IsInFront(t); ++t)
    {
      steiner.VisibleTriangles.push_back(t);
    }
    if (steiner.VisibleTriangles.size() == front.size())
    {
      return true;
    }
  }

  // Points on the way from the middles of triangles to points of the front.
  steiner.VisibleTriangles.clear();
  std::int64_t testsLeft = MaximumTests;
  std::mt19937_64 random(2);
  std::vector<std::int32_t> visible;
  while (testsLeft > 0)
  {
    const auto t = static_cast<std::int32_t>(random() % size);
    const Vector target =
      pocket.GetPoint(static_cast<std::int32_t>(random() % pocket.NumberOfPoints));
    constexpr double ways[] = { 0.5, 0.25, 0.1, 0.02 };
    const double way = ways[random() % 4];
    const Vector middle = pocket.GetMiddle(t);
    for (int a = 0; a < 3; ++a)
    {
      position[a] = middle[a] + way * (target[a] - middle[a]);
    }
    pocket.SetPoint(position);
    testsLeft -= size;
    if (!pocket.Sees(t))
    {
      continue;
    }
    visible.assign(1, t);
    for (std::int32_t other = 0; other < size; ++other)
    {
      if (other != t && pocket.IsInFront(other))
      {
        testsLeft -= size;
        if (pocket.Sees(other))
        {
          visible.push_back(other);
        }
      }
    }
    if (visible.size() > steiner.VisibleTriangles.size())
    {
      steiner.Position = position;
      steiner.VisibleTriangles = visible;
    }
  }
  return !steiner.VisibleTriangles.empty();
}

} // namespace tetralux
