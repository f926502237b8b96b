// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/ConvexFaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace tetralux
{

namespace
{

using Vector = std::array<double, 3>;

/// How far a point may be from a plane and count as part of it, as a fraction of the cell's width
/// across the plane. The first is above the rounding of coordinates in single precision. A face
/// that is bent by about a tolerance may count as planar from some of its corners and as bent from
/// others; then the faces do not close, and the next tolerance is tried.
constexpr double CoplanarTolerances[] = { 1e-6, 1e-8, 1e-10, 1e-12 };

/// How far a point may be from the line of its neighbours and count as part of it, as a fraction
/// of the face's area over the line's length: as the first tolerance above.
constexpr double CollinearTolerance = 1e-6;

/// Sine of the angle below which three points span no plane: far above the rounding of a cross
/// product, far below the angles of a cell in a boundary layer.
constexpr double SmallestSine = 1e-12;

/// Width across a plane, as a fraction of the cell's extent, below which a cell is flat: rounding.
constexpr double SmallestWidth = 1e-12;

Vector Subtract(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double Length(const Vector& a) { return std::sqrt(Dot(a, a)); }

struct PlanePoint
{
  double X;
  double Y;
  std::size_t Index;

  bool operator<(const PlanePoint& other) const
  {
    return std::pair(this->X, this->Y) < std::pair(other.X, other.Y);
  }
};

double CrossAt(const PlanePoint& origin, const PlanePoint& a, const PlanePoint& b)
{
  return (a.X - origin.X) * (b.Y - origin.Y) - (a.Y - origin.Y) * (b.X - origin.X);
}

/// Corners of the hull of points in a plane, counter-clockwise.
std::vector<std::size_t> FindCorners(std::vector<PlanePoint> points)
{
  std::sort(points.begin(), points.end());
  double largest = 0;
  for (const PlanePoint& a : points)
  {
    for (const PlanePoint& b : points)
    {
      largest = std::max(largest, CrossAt(points[0], a, b));
    }
  }
  // From left to right below, and from right to left above.
  std::vector<std::size_t> corners;
  for (int half = 0; half < 2; ++half)
  {
    std::vector<PlanePoint> chain;
    for (const PlanePoint& point : points)
    {
      while (chain.size() > 1 &&
        CrossAt(chain[chain.size() - 2], chain.back(), point) <= CollinearTolerance * largest)
      {
        chain.pop_back();
      }
      chain.push_back(point);
    }
    std::transform(chain.begin(), std::prev(chain.end()), std::back_inserter(corners),
      [](const PlanePoint& point) { return point.Index; });
    std::reverse(points.begin(), points.end());
  }
  return corners;
}

class FaceFinder
{
public:
  FaceFinder(const std::vector<std::int64_t>& ids, const double* points)
  {
    std::vector<std::int64_t> ascending = ids;
    std::sort(ascending.begin(), ascending.end());
    std::set<Vector> seen;
    for (std::int64_t id : ascending)
    {
      const Vector x = { points[3 * id], points[3 * id + 1], points[3 * id + 2] };
      if (seen.insert(x).second)
      {
        this->Ids.push_back(id);
        this->Positions.push_back(x);
      }
    }
    // Relative to one of them and to their extent, so that products are of ordinary size.
    const Vector origin = this->Positions[0];
    double extent = 0;
    for (Vector& x : this->Positions)
    {
      x = Subtract(x, origin);
      extent = std::max({ extent, std::abs(x[0]), std::abs(x[1]), std::abs(x[2]) });
    }
    for (Vector& x : this->Positions)
    {
      x = { x[0] / extent, x[1] / extent, x[2] / extent };
    }
  }

  bool Find(double tolerance)
  {
    this->Polygons.clear();
    this->Members.clear();
    const std::size_t count = this->Ids.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t j = i + 1; j < count; ++j)
      {
        for (std::size_t k = j + 1; k < count; ++k)
        {
          this->AddFaceThrough({ i, j, k }, tolerance);
        }
      }
    }
    return this->IsClosed();
  }

  void Write(ConvexFaces& faces) const
  {
    std::vector<bool> isCorner(this->Ids.size(), false);
    faces.Polygons.clear();
    for (const std::vector<std::size_t>& polygon : this->Polygons)
    {
      faces.Polygons.emplace_back();
      for (std::size_t corner : polygon)
      {
        faces.Polygons.back().push_back(this->Ids[corner]);
        isCorner[corner] = true;
      }
    }
    faces.Others.clear();
    for (std::size_t i = 0; i < this->Ids.size(); ++i)
    {
      if (!isCorner[i])
      {
        faces.Others.push_back(this->Ids[i]);
      }
    }
  }

private:
  using Triple = std::array<std::size_t, 3>;

  bool IsInFace(const Triple& triple) const
  {
    return std::any_of(this->Members.begin(), this->Members.end(),
      [&triple](const std::vector<bool>& members)
      { return members[triple[0]] && members[triple[1]] && members[triple[2]]; });
  }

  /// Adds the face in the plane of three points if all others are on one side of it. Most triples
  /// have points on both sides soon, so that this is asked before the faces that are there.
  void AddFaceThrough(const Triple& triple, double tolerance)
  {
    const Vector& origin = this->Positions[triple[0]];
    const Vector u = Subtract(this->Positions[triple[1]], origin);
    const Vector v = Subtract(this->Positions[triple[2]], origin);
    Vector normal = Cross(u, v);
    const double length = Length(normal);
    if (!(length > SmallestSine * Length(u) * Length(v))) // also where one is not a number
    {
      return;
    }
    const double largestDistance = 4 * length; // of points in a box of edges up to 2
    double low = 0;
    double high = 0;
    for (const Vector& x : this->Positions)
    {
      const double distance = Dot(normal, Subtract(x, origin));
      low = std::min(low, distance);
      high = std::max(high, distance);
      if (low < -tolerance * largestDistance && high > tolerance * largestDistance)
      {
        return;
      }
    }
    const double width = high - low;
    if (width <= SmallestWidth * length || std::min(-low, high) > tolerance * width ||
      this->IsInFace(triple))
    {
      return;
    }
    if (-low < high)
    {
      normal = { -normal[0], -normal[1], -normal[2] };
    }

    const Vector across = Cross(normal, u);
    std::vector<bool> members(this->Ids.size(), false);
    std::vector<PlanePoint> inPlane;
    for (std::size_t i = 0; i < this->Ids.size(); ++i)
    {
      const Vector x = Subtract(this->Positions[i], origin);
      if (std::abs(Dot(normal, x)) <= tolerance * width)
      {
        members[i] = true;
        inPlane.push_back({ Dot(u, x) / Length(u), Dot(across, x) / Length(across), i });
      }
    }
    std::vector<std::size_t> corners = FindCorners(std::move(inPlane));
    if (corners.size() > 2)
    {
      this->Polygons.push_back(std::move(corners));
      this->Members.push_back(std::move(members));
    }
  }

  /// Whether each edge is passed once in each direction.
  bool IsClosed() const
  {
    std::set<std::pair<std::size_t, std::size_t>> edges;
    std::size_t count = 0;
    for (const std::vector<std::size_t>& polygon : this->Polygons)
    {
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        edges.emplace(polygon[i], polygon[(i + 1) % polygon.size()]);
        ++count;
      }
    }
    return count > 0 && edges.size() == count &&
      std::all_of(edges.begin(), edges.end(),
        [&edges](const auto& edge) {
          return edges.count({ edge.second, edge.first }) > 0;
        });
  }

  std::vector<std::int64_t> Ids; ///< ascending
  std::vector<Vector> Positions;
  std::vector<std::vector<std::size_t>> Polygons;
  std::vector<std::vector<bool>> Members; ///< of each polygon: which points are in its plane
};

} // namespace

bool FindConvexFaces(const std::vector<std::int64_t>& ids, const double* points, ConvexFaces& faces)
{
  FaceFinder finder(ids, points);
  for (double tolerance : CoplanarTolerances)
  {
    if (finder.Find(tolerance))
    {
      finder.Write(faces);
      return true;
    }
  }
  return false;
}

} // namespace tetralux
