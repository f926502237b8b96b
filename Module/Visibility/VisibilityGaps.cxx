// SPDX-License-Identifier: BSD-3-Clause
#include "Visibility/VisibilityGaps.h"

#include "Visibility/FaceBins.h"
#include "Visibility/MeasureTriangle.h"
#include "Visibility/ViewOrientation.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

namespace tetralux
{
namespace
{

/// How far two points may be apart that were one before they were rounded to single precision, in
/// the largest coordinate: four halves of a unit in the last place along each axis.
constexpr double SingleRounding = 4.2e-7;

/// How far into each other cells may reach and still be seen to touch, in the largest coordinate:
/// what comes of six digits in a text file.
constexpr double ContactTolerance = 2e-6;

/// Part of the smaller of two faces, as they would look from in front, that they must have
/// in common to count. Rounding gives faces that meet in an edge some 1e-16, and faces
/// that are seen edge-on.
constexpr double OverlapTolerance = 1e-10;

/// How far from the plane of a face a viewer may be who counts as in it: the sine of the angle
/// between the plane and a ray, or, of a viewer who is nearer than a radius of the mesh, the
/// distance in radii. Of the cone behind such a face rounding leaves nothing that is right; what a
/// ray passes of its cell is shorter than that, but for rays nearly in the plane.
constexpr double EdgeOnTolerance = 1e-12;

/// Parts of rays that are shorter, in radii of the mesh, order nothing where faces touch: some
/// hundred roundings.
constexpr double ShortestStretch = 1e-13;

/// How many faces in bins are looked at while a box of the hierarchy is.
constexpr std::int64_t LooksOfBox = 8;

using Vector = FaceBins::Corner;

Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// Distances from it are positive on one side.
struct Plane
{
  Vector Normal;
  double Offset;

  Plane(const Vector& normal, const Vector& point)
    : Normal(normal)
  {
    const double length = std::sqrt(Dot(normal, normal));
    for (double& component : this->Normal)
    {
      component = length > 0 ? component / length : 0;
    }
    this->Offset = Dot(this->Normal, point);
  }
  double GetDistance(const Vector& point) const { return Dot(this->Normal, point) - this->Offset; }
};

/// A triangle that planes cut, at most three times. A cut adds one corner; but where rounding
/// decides the sides of corners, they may alternate, so that 4, 6, 9 corners come of it.
struct Polygon
{
  std::array<Vector, 9> Corners;
  int Size = 0;

  /// Keeps what has at least that distance.
  void Clip(const Plane& plane, double distance)
  {
    const Polygon before = *this;
    this->Size = 0;
    for (int i = 0; i < before.Size; ++i)
    {
      const Vector& a = before.Corners[i];
      const Vector& b = before.Corners[(i + 1) % before.Size];
      const double da = plane.GetDistance(a) - distance;
      const double db = plane.GetDistance(b) - distance;
      if (da >= 0)
      {
        this->Corners[this->Size++] = a;
      }
      if ((da >= 0) != (db >= 0))
      {
        const double t = da / (da - db);
        Vector& cut = this->Corners[this->Size++];
        for (int axis = 0; axis < 3; ++axis)
        {
          cut[axis] = a[axis] + t * (b[axis] - a[axis]);
        }
      }
    }
  }

  Vector GetMiddle() const
  {
    Vector middle = { 0, 0, 0 };
    for (int i = 0; i < this->Size; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        middle[axis] += this->Corners[i][axis] / this->Size;
      }
    }
    return middle;
  }

  double Measure(const VisibilityView& view) const
  {
    double size = 0;
    for (int i = 2; i < this->Size; ++i)
    {
      size += MeasureTriangle(
        { this->Corners[0].data(), this->Corners[i - 1].data(), this->Corners[i].data() }, view);
    }
    return size;
  }
};

struct Gap
{
  std::int32_t From, To;
  float Size;
  std::uint8_t Sliver;

  bool operator<(const Gap& other) const
  {
    return this->From != other.From ? this->From < other.From
      : this->To != other.To        ? this->To < other.To
                                    : this->Size < other.Size;
  }
};

/// The part of a ray inside a cell, in lengths of the ray's direction.
struct Stretch
{
  double Begin, End;
  bool OfFlatCell;
};

class GapFinder
{
public:
  GapFinder(const VisibilityGeometry& geometry, const VisibilityArrows& arrows,
    Span<const std::int32_t> twins, const VisibilityView& view)
    : Geometry(geometry)
    , Twins(twins)
    , View(view)
    , Facing(geometry.Boundary->Entries.size())
  {
    const auto& center = geometry.Center;
    const double largest = 1 +
      std::max({ std::abs(center[0]), std::abs(center[1]), std::abs(center[2]) }) / geometry.Radius;
    this->Rounding = SingleRounding * largest;
    this->Contact = ContactTolerance * largest;
    const ViewOrientation orientation(view);
    // As all coordinates here: relative to the mesh.
    for (int axis = 0; axis < 3; ++axis)
    {
      this->View.Eye[axis] = (view.Eye[axis] - geometry.Center[axis]) / geometry.Radius;
      this->View.Direction[axis] = orientation.GetDirection()[axis];
    }
    const std::int64_t numberOfFaces = static_cast<std::int64_t>(this->Facing.size());
    this->EdgeOn.resize(numberOfFaces);
    this->Triangles.resize(numberOfFaces);
    std::vector<std::uint8_t> entered(numberOfFaces);
#pragma omp parallel for schedule(static)
    for (std::int64_t face = 0; face < numberOfFaces; ++face)
    {
      const WalkEntry& entry = geometry.Boundary->Entries[face];
      this->Facing[face] = static_cast<std::int8_t>(arrows.GetBoundarySide(entry) *
        orientation.GetTurn(geometry.GetPoint(entry.Points[0]), geometry.GetPoint(entry.Points[1]),
          geometry.GetPoint(entry.Points[2])));
      for (int corner = 0; corner < 3; ++corner)
      {
        this->Triangles[face][corner] = this->GetPoint(entry.Points[corner]);
      }
      this->EdgeOn[face] = this->IsEdgeOn(this->GetTriangle(face));
      entered[face] = this->Facing[face] < 0 && !this->EdgeOn[face];
    }
    this->Bins.emplace(this->View, this->Triangles, entered);
  }

  bool IsLeft(std::int64_t face) const { return this->Facing[face] > 0; }

  /// Appends what is behind a face that rays leave by. Returns how many faces were looked at.
  std::int64_t Find(std::int64_t leftFace, std::vector<Gap>& gaps) const
  {
    const WalkEntry& left = this->Geometry.Boundary->Entries[leftFace];
    Polygon exit = this->GetTriangle(leftFace);
    const std::int32_t twin = this->Twins[leftFace];
    if (twin >= 0 && this->Facing[twin] < 0)
    {
      const double size = exit.Measure(this->View);
      gaps.push_back(
        { left.Cell, this->Geometry.Boundary->Entries[twin].Cell, static_cast<float>(size), 0 });
      return 1;
    }
    if (this->EdgeOn[leftFace])
    {
      return 1;
    }
    // Counter-clockwise to the viewer.
    Vector normal = Cross(exit.Corners[1] - exit.Corners[0], exit.Corners[2] - exit.Corners[0]);
    if (Dot(normal, this->GetRay(exit.Corners[0])) > 0)
    {
      std::swap(exit.Corners[1], exit.Corners[2]);
      normal = { -normal[0], -normal[1], -normal[2] };
    }
    const Plane behind({ -normal[0], -normal[1], -normal[2] }, exit.Corners[0]);
    const auto getSide = [&](int edge)
    {
      const Vector& a = exit.Corners[edge];
      const Vector& b = exit.Corners[(edge + 1) % 3];
      return Plane(Cross(b - a, this->GetRay(a)), a);
    };
    const Cone cone = { left.Cell, { getSide(0), getSide(1), getSide(2), behind },
      this->MeasureFromFront(exit) };
    return this->Bins->IsUsable()
      ? this->Bins->ForEach(leftFace, [&](std::int32_t face) { this->AddGap(cone, face, gaps); })
      : this->FindInHierarchy(cone, gaps);
  }

private:
  /// All that is behind a face.
  struct Cone
  {
    std::int32_t Cell; ///< that rays leave by the face
    Plane Planes[4];   ///< the sides, and the face; positive inside
    double Size;       ///< how large the face would look if it were turned to the viewer
  };

  /// Looks at the faces in the boxes that meet a cone. Returns how many that
  /// is, each as LooksOfBox.
  std::int64_t FindInHierarchy(const Cone& cone, std::vector<Gap>& gaps) const
  {
    const BoundaryBvh& bvh = this->Geometry.Boundary->Bvh;
    std::array<std::int32_t, BoundaryBvh::MaximumDepth + 1> stack;
    std::int64_t looked = 0;
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0)
    {
      const std::int32_t nodeId = stack[--depth];
      const BoundaryBvh::Node& node = bvh.Nodes[nodeId];
      ++looked;
      if (!CanMeet(node, cone.Planes))
      {
        continue;
      }
      if (node.Count == 0)
      {
        stack[depth++] = node.First;
        stack[depth++] = nodeId + 1;
        continue;
      }
      looked += node.Count;
      for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
      {
        const std::int32_t face = bvh.Triangles[i];
        if (this->Facing[face] < 0 && !this->EdgeOn[face])
        {
          this->AddGap(cone, face, gaps);
        }
      }
    }
    return LooksOfBox * looked;
  }

  /// Appends the arrow from a face that rays leave by to one that they enter by, if there is any.
  void AddGap(const Cone& cone, std::int32_t face, std::vector<Gap>& gaps) const
  {
    const WalkEntry& entered = this->Geometry.Boundary->Entries[face];
    const Plane& behind = cone.Planes[3];
    const FaceBins::Face& corners = this->Triangles[face];
    const auto isOutside = [&](const Plane& plane, double distance)
    {
      return std::all_of(corners.begin(), corners.end(),
        [&](const Vector& corner) { return plane.GetDistance(corner) < distance; });
    };
    if (entered.Cell == cone.Cell || isOutside(behind, -this->Contact) ||
      std::any_of(
        cone.Planes, cone.Planes + 3, [&](const Plane& plane) { return isOutside(plane, 0); }))
    {
      return;
    }
    const Polygon entry = this->GetTriangle(face);
    const Polygon part = ClipByCone(entry, cone.Planes, 0);
    const double smallest = OverlapTolerance * std::min(cone.Size, this->MeasureFromFront(entry));
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double nearest = infinity, farthest = -infinity;
    for (int corner = 0; corner < part.Size; ++corner)
    {
      const double distance = behind.GetDistance(part.Corners[corner]);
      nearest = std::min(nearest, distance);
      farthest = std::max(farthest, distance);
    }
    const double common = part.Measure(this->View);
    if (farthest < -this->Contact || common <= smallest)
    {
      return;
    }
    bool sliver = ClipByCone(entry, cone.Planes, this->Rounding).Size == 0;
    if (nearest < 0 || farthest <= this->Contact)
    {
      const double length =
        this->GetLengthPassedBefore(cone.Cell, behind, entered.Cell, part.GetMiddle());
      if (length < ShortestStretch)
      {
        return;
      }
      sliver = sliver || length < this->Rounding;
    }
    gaps.push_back({ cone.Cell, entered.Cell, static_cast<float>(common), sliver });
  }

  bool IsEdgeOn(const Polygon& triangle) const
  {
    const Vector normal =
      Cross(triangle.Corners[1] - triangle.Corners[0], triangle.Corners[2] - triangle.Corners[0]);
    const Vector ray = this->GetRay(triangle.Corners[0]);
    const double length = this->View.Parallel ? 1 : std::max(1., std::sqrt(Dot(ray, ray)));
    return std::abs(Dot(normal, ray)) <= EdgeOnTolerance * std::sqrt(Dot(normal, normal)) * length;
  }

  /// How much, in radii, of each of two cells a ray passes at least, if it passes the first one
  /// before the second one; else 0. The ray enters the second one at a point; it leaves the first
  /// one by a face in the plane behind. Where faces touch they do not tell: the whole cells may be
  /// thinner than what faces are off by. One ray tells for all, as a plane separates the cells.
  /// Flat cells are where their faces are, and count as long as the other cell.
  double GetLengthPassedBefore(
    std::int32_t first, const Plane& behind, std::int32_t second, const Vector& point) const
  {
    const Vector ray = this->GetRay(point);
    const double length = std::sqrt(Dot(ray, ray));
    const double exit = -behind.GetDistance(point) / Dot(behind.Normal, ray);
    const Stretch a = this->GetStretch(first, exit, point, ray);
    const Stretch b = this->GetStretch(second, 0, point, ray);
    if (a.OfFlatCell && b.OfFlatCell)
    {
      return exit * length <= this->Rounding ? ShortestStretch : 0;
    }
    if (a.Begin + a.End >= b.Begin + b.End)
    {
      return 0;
    }
    return length *
      (a.OfFlatCell      ? b.End - b.Begin
          : b.OfFlatCell ? a.End - a.Begin
                         : std::min(a.End - a.Begin, b.End - b.Begin));
  }

  /// Where a ray through a point, at 0, is inside a cell; the viewer is at -1, or far away.
  /// placeOfFlat: where it is if the cell has no volume.
  Stretch GetStretch(
    std::int32_t cell, double placeOfFlat, const Vector& point, const Vector& ray) const
  {
    const std::int32_t* ids = this->Geometry.GetPointIds(cell);
    std::array<Vector, 4> corners;
    for (int corner = 0; corner < 4; ++corner)
    {
      corners[corner] = this->GetPoint(ids[corner]);
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Stretch stretch = { this->View.Parallel ? -infinity : -1, infinity, false };
    for (int face = 0; face < 4; ++face)
    {
      const Vector& a = corners[(face + 1) % 4];
      const Vector normal = Cross(corners[(face + 2) % 4] - a, corners[(face + 3) % 4] - a);
      const double volume = Dot(normal, corners[face] - a);
      if (std::abs(volume) <= ShortestStretch * std::sqrt(Dot(normal, normal)))
      {
        return { placeOfFlat, placeOfFlat, true };
      }
      const double side = volume < 0 ? -1 : 1;
      const double slope = side * Dot(normal, ray);
      const double height = side * Dot(normal, point - a);
      if (slope > 0)
      {
        stretch.Begin = std::max(stretch.Begin, -height / slope);
      }
      else if (slope < 0)
      {
        stretch.End = std::min(stretch.End, -height / slope);
      }
    }
    return stretch;
  }

  Vector GetPoint(std::int32_t id) const
  {
    const double* point = this->Geometry.GetPoint(id);
    Vector relative;
    for (int axis = 0; axis < 3; ++axis)
    {
      relative[axis] = (point[axis] - this->Geometry.Center[axis]) / this->Geometry.Radius;
    }
    return relative;
  }

  Polygon GetTriangle(std::int64_t face) const
  {
    Polygon triangle;
    triangle.Size = 3;
    std::copy_n(this->Triangles[face].begin(), 3, triangle.Corners.begin());
    return triangle;
  }

  /// How large a triangle would look if it were turned to the viewer.
  double MeasureFromFront(const Polygon& triangle) const
  {
    const Vector normal =
      Cross(triangle.Corners[1] - triangle.Corners[0], triangle.Corners[2] - triangle.Corners[0]);
    const Vector ray = this->GetRay(triangle.Corners[0]);
    return 0.5 * std::sqrt(Dot(normal, normal)) / (this->View.Parallel ? 1 : Dot(ray, ray));
  }

  Vector GetRay(const Vector& point) const
  {
    return this->View.Parallel ? this->View.Direction : point - this->View.Eye;
  }

  /// The part of a triangle that is at least that far inside of the first three planes.
  static Polygon ClipByCone(const Polygon& triangle, const Plane (&planes)[4], double distance)
  {
    Polygon part = triangle;
    for (int plane = 0; plane < 3 && part.Size > 0; ++plane)
    {
      part.Clip(planes[plane], distance);
    }
    return part;
  }

  /// False only where no point of a node is on the positive sides of all planes, or within the
  /// contact tolerance of them.
  bool CanMeet(const BoundaryBvh::Node& node, const Plane (&planes)[4]) const
  {
    return std::all_of(std::begin(planes), std::end(planes),
      [&](const Plane& plane)
      {
        double distance = -plane.Offset;
        for (int axis = 0; axis < 3; ++axis)
        {
          distance +=
            plane.Normal[axis] * node.Center[axis] + std::abs(plane.Normal[axis]) * node.Half[axis];
        }
        return distance >= -this->Contact;
      });
  }

  const VisibilityGeometry& Geometry;
  Span<const std::int32_t> Twins;
  VisibilityView View;
  /// For each boundary face 1 where rays leave by it, -1 where they enter, 0 where it is edge-on.
  std::vector<std::int8_t> Facing;
  std::vector<std::uint8_t> EdgeOn;      ///< to rounding, see EdgeOnTolerance
  std::vector<FaceBins::Face> Triangles; ///< of the boundary
  std::optional<FaceBins> Bins;          ///< those that rays enter by
  double Rounding = 0;                   ///< SingleRounding in radii
  double Contact = 0;                    ///< ContactTolerance in radii
};

} // namespace

//----------------------------------------------------------------------------
bool FindGaps(const VisibilityGeometry& geometry, const VisibilityArrows& arrows,
  Span<const std::int32_t> twins, const VisibilityView& view, VisibilityGaps& gaps)
{
  gaps = {};
  const GapFinder finder(geometry, arrows, twins, view);
  const std::int64_t numberOfFaces = static_cast<std::int64_t>(geometry.Boundary->Entries.size());
  const std::int64_t limit = LargestNumberOfGaps * numberOfFaces;
  std::atomic<std::int64_t> count{ 0 };
  std::int64_t looked = 0;
  std::vector<Gap> all;
#pragma omp parallel reduction(+ : looked)
  {
    std::vector<Gap> found;
#pragma omp for schedule(dynamic, 64)
    for (std::int64_t face = 0; face < numberOfFaces; ++face)
    {
      if (finder.IsLeft(face) && count <= limit)
      {
        const std::size_t before = found.size();
        looked += finder.Find(face, found);
        count += static_cast<std::int64_t>(found.size() - before);
      }
    }
#pragma omp critical
    all.insert(all.end(), found.begin(), found.end());
  }
  gaps.Looked = looked;
  if (count > limit)
  {
    return false;
  }
  std::sort(all.begin(), all.end());

  gaps.Begins.assign(geometry.GetNumberOfCells() + 1, 0);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (i > 0 && all[i].From == all[i - 1].From && all[i].To == all[i - 1].To)
    {
      gaps.Sizes.back() += all[i].Size;
      gaps.Slivers.back() &= all[i].Sliver;
      continue;
    }
    gaps.Cells.push_back(all[i].To);
    gaps.Sizes.push_back(all[i].Size);
    gaps.Slivers.push_back(all[i].Sliver);
    ++gaps.Begins[all[i].From + 1];
  }
  for (std::size_t cell = 1; cell < gaps.Begins.size(); ++cell)
  {
    gaps.Begins[cell] += gaps.Begins[cell - 1];
  }
  return true;
}

} // namespace tetralux
