// SPDX-License-Identifier: BSD-3-Clause
#include "Generate/SchoenhardtNotch.h"

#include "Generate/LatticeMesh.h"
#include "Mesh/CellSplit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

// Every ray from the polyhedron's middle leaves the polyhedron once, and then the box: the solid is
// made of the stretches between. Where the faces of the polyhedron are cut by the planes through
// the middle and the edges of the box, each piece faces one side of the box, and the stretches over
// a triangle of that piece form a wedge with plane sides.

namespace tetralux
{
namespace
{

using Point = std::array<double, 3>;
using Polygon = std::vector<Point>;

constexpr double Circumradius = 0.6;

/// z of the polyhedron's middle, and the sides of the box relative to it: -x, x, -y, y, -z, z.
constexpr double Middle = 0.5;
constexpr double BoxSides[6] = { -1, 1, -1, 1, -1, 0.5 };

/// Points closer than this, in units of the box, are the same: far above rounding, far below the
/// smallest piece that a sensible twist leaves.
constexpr double Coincidence = 1e-9;

double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point Cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// How far out a ray's point reaches towards a side of the box: 1 where it is on the side's plane.
double GetReach(const Point& point, int side) { return point[side / 2] / BoxSides[side]; }

/// The part of the polygon from which rays go to the given side of the box.
Polygon ClipToSide(Polygon polygon, int side)
{
  for (int other = 0; other < 6; ++other)
  {
    if (other / 2 == side / 2)
    {
      continue;
    }
    Polygon clipped;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Point& a = polygon[i];
      const Point& b = polygon[(i + 1) % polygon.size()];
      const double insideA = GetReach(a, side) - GetReach(a, other);
      const double insideB = GetReach(b, side) - GetReach(b, other);
      if (insideA >= 0)
      {
        clipped.push_back(a);
      }
      if ((insideA > 0 && insideB < 0) || (insideA < 0 && insideB > 0))
      {
        const double f = insideA / (insideA - insideB);
        clipped.push_back(
          { a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]) });
      }
    }
    polygon = clipped;
  }
  return polygon;
}

/// The faces of the polyhedron but its top, counterclockwise from outside.
std::vector<Polygon> MakePolyhedron(double twist)
{
  Point bottom[3];
  Point top[3];
  for (int i = 0; i < 3; ++i)
  {
    const double angle = i * 2 * std::acos(-1) / 3;
    bottom[i] = { Circumradius * std::cos(angle), Circumradius * std::sin(angle), -Middle };
    top[i] = { Circumradius * std::cos(angle + twist), Circumradius * std::sin(angle + twist),
      BoxSides[5] };
  }
  std::vector<Polygon> faces = { { bottom[0], bottom[2], bottom[1] } };
  for (int i = 0; i < 3; ++i)
  {
    const int next = (i + 1) % 3;
    faces.push_back({ bottom[i], bottom[next], top[next] });
    faces.push_back({ bottom[i], top[next], top[i] });
  }
  return faces;
}

/// The surface of the polyhedron in triangles, each of which faces one side of the box.
struct Surface
{
  std::vector<Point> Points;
  std::vector<double> Reaches; ///< for each point: 1 where the polyhedron touches the box
  std::vector<std::array<int, 3>> Triangles;

  explicit Surface(double twist)
  {
    for (const Polygon& face : MakePolyhedron(twist))
    {
      for (int side = 0; side < 6; ++side)
      {
        std::vector<int> ids;
        for (const Point& point : ClipToSide(face, side))
        {
          const int id = this->GetId(point, side);
          if (std::find(ids.begin(), ids.end(), id) == ids.end())
          {
            ids.push_back(id);
          }
        }
        for (std::size_t i = 2; i < ids.size(); ++i)
        {
          this->AddTriangle(ids[0], ids[i - 1], ids[i]);
        }
      }
    }
  }

private:
  int GetId(const Point& point, int side)
  {
    for (std::size_t id = 0; id < this->Points.size(); ++id)
    {
      const Point& other = this->Points[id];
      if (std::abs(point[0] - other[0]) + std::abs(point[1] - other[1]) +
          std::abs(point[2] - other[2]) <
        Coincidence)
      {
        return static_cast<int>(id);
      }
    }
    this->Points.push_back(point);
    const double reach = GetReach(point, side);
    this->Reaches.push_back(reach > 1 - Coincidence ? 1 : reach);
    return static_cast<int>(this->Points.size()) - 1;
  }

  void AddTriangle(int a, int b, int c)
  {
    // Three points of a straight edge bound no area.
    if (Dot(this->Points[a], Cross(this->Points[b], this->Points[c])) > Coincidence)
    {
      this->Triangles.push_back({ a, b, c });
    }
  }
};

/// Cuts the surface's triangles and the stretches over them into small wedges, and these into
/// tetrahedra.
class Mesher
{
public:
  Mesher(const Surface& surface, int subdivisions, TetrahedralMesh& mesh)
    : Base(surface)
    , Subdivisions(subdivisions)
    , Mesh(mesh)
  {
  }

  void AddWedges(const std::array<int, 3>& triangle)
  {
    const int n = this->Subdivisions;
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; i + j < n; ++j)
      {
        this->AddColumn(triangle, { { { i, j }, { i + 1, j }, { i, j + 1 } } });
        if (i + j + 1 < n)
        {
          this->AddColumn(triangle, { { { i + 1, j }, { i + 1, j + 1 }, { i, j + 1 } } });
        }
      }
    }
  }

private:
  /// The points of the stretch over a point of a triangle, from the polyhedron to the box; the
  /// point has the weights n - i - j, i, j (over n) of the triangle's corners.
  const std::vector<std::int64_t>& GetStretch(
    const std::array<int, 3>& triangle, const std::array<int, 2>& position)
  {
    const int n = this->Subdivisions;
    const int weights[3] = { n - position[0] - position[1], position[0], position[1] };
    std::set<std::pair<int, int>> key;
    Point start = { 0, 0, 0 };
    double reach =
      0; // the share of the ray that is inside the polyhedron: linear over the triangle
    for (int corner = 0; corner < 3; ++corner)
    {
      if (weights[corner] != 0)
      {
        key.insert({ triangle[corner], weights[corner] });
        const double weight = static_cast<double>(weights[corner]) / n;
        for (int axis = 0; axis < 3; ++axis)
        {
          start[axis] += weight * this->Base.Points[triangle[corner]][axis];
        }
        reach += weight * this->Base.Reaches[triangle[corner]];
      }
    }
    std::vector<std::int64_t>& stretch = this->Stretches[key];
    if (stretch.empty())
    {
      const bool touchesBox = std::all_of(key.begin(), key.end(),
        [this](const auto& corner) { return this->Base.Reaches[corner.first] == 1; });
      for (int layer = 0; layer <= n; ++layer)
      {
        if (layer > 0 && touchesBox)
        {
          stretch.push_back(stretch.front());
          continue;
        }
        const double factor = 1 + (1 / reach - 1) * layer / n;
        stretch.push_back(static_cast<std::int64_t>(this->Mesh.GetNumberOfPoints()));
        this->Mesh.Points.insert(this->Mesh.Points.end(),
          { factor * start[0], factor * start[1], factor * start[2] + Middle });
      }
    }
    return stretch;
  }

  void AddColumn(
    const std::array<int, 3>& triangle, const std::array<std::array<int, 2>, 3>& positions)
  {
    const auto& stretch0 = this->GetStretch(triangle, positions[0]);
    const auto& stretch1 = this->GetStretch(triangle, positions[1]);
    const auto& stretch2 = this->GetStretch(triangle, positions[2]);
    for (int layer = 0; layer < this->Subdivisions; ++layer)
    {
      const std::int64_t wedge[6] = { stretch0[layer + 1], stretch1[layer + 1], stretch2[layer + 1],
        stretch0[layer], stretch1[layer], stretch2[layer] };
      std::int64_t tets[3 * 4];
      const int count = SplitWedge(wedge, tets);
      for (int tet = 0; tet < count; ++tet)
      {
        const std::int64_t* ids = tets + 4 * tet;
        // Where the polyhedron touches the box, the wedge has less than six different points.
        if (std::set<std::int64_t>(ids, ids + 4).size() == 4)
        {
          this->Mesh.Cells.insert(this->Mesh.Cells.end(), ids, ids + 4);
        }
      }
    }
  }

  const Surface& Base;
  const int Subdivisions;
  TetrahedralMesh& Mesh;
  std::map<std::set<std::pair<int, int>>, std::vector<std::int64_t>> Stretches;
};

} // namespace

//----------------------------------------------------------------------------
void AddSchoenhardtNotch(double twist, int subdivisions, TetrahedralMesh& mesh)
{
  const Surface surface(twist);
  CheckNumberOfTetrahedra(static_cast<double>(mesh.GetNumberOfCells()) +
    3.0 * static_cast<double>(surface.Triangles.size()) * std::pow(subdivisions, 3));
  Mesher mesher(surface, subdivisions, mesh);
  for (const std::array<int, 3>& triangle : surface.Triangles)
  {
    mesher.AddWedges(triangle);
  }
}

} // namespace tetralux
