// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRenderer.h"

#include "ReferenceIntegral.h"
#include "ReferenceRays.h"
#include "ReferenceRuns.h"
#include "ReferenceShading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tetralux
{

using namespace reference;

namespace
{

constexpr Real Infinity = std::numeric_limits<Real>::infinity();

/// The ray of one pixel.
struct Ray : ReferenceRay
{
  /// Mesh coordinates are sheared so that the ray becomes an axis: (u, v) are the first two of
  /// Axes, minus Shear times the third, which is where the direction is largest (as Woop et al.,
  /// Watertight Ray/Triangle Intersection, 2013).
  std::array<int, 3> Axes;
  std::array<Real, 2> Shear;

  bool Valid = false;
};

Ray MakeRay(const RayGrid& grid, int i, int j)
{
  Ray ray;
  static_cast<ReferenceRay&>(ray) = MakeReferenceRay(grid, i, j);

  int largest = 0;
  for (int axis = 1; axis < 3; ++axis)
  {
    if (std::abs(ray.Direction[axis]) > std::abs(ray.Direction[largest]))
    {
      largest = axis;
    }
  }
  ray.Axes = { (largest + 1) % 3, (largest + 2) % 3, largest };
  const Real main = ray.Direction[largest];
  ray.Shear = { ray.Direction[ray.Axes[0]] / main, ray.Direction[ray.Axes[1]] / main };
  ray.Valid = std::isfinite(ray.Shear[0]) && std::isfinite(ray.Shear[1]) &&
    std::isfinite(Dot(ray.Origin, ray.Origin));
  return ray;
}

/// A point as a ray sees it. U and V are rounded to double, so that the product of two is known
/// exactly; every cell at the point rounds alike.
struct SeenPoint
{
  double U;
  double V;
  Real T; ///< distance along the ray, in the sheared frame
};

SeenPoint See(const Ray& ray, const double* point)
{
  const Real depth = point[ray.Axes[2]] - ray.Origin[ray.Axes[2]];
  SeenPoint seen;
  seen.U = static_cast<double>(point[ray.Axes[0]] - ray.Origin[ray.Axes[0]] - ray.Shear[0] * depth);
  seen.V = static_cast<double>(point[ray.Axes[1]] - ray.Origin[ray.Axes[1]] - ray.Shear[1] * depth);
  seen.T = depth / ray.Direction[ray.Axes[2]];
  return seen;
}

/// On which side of the line from a to b the ray passes: the exact sign of U_a V_b - U_b V_a. Where
/// that is zero, the sign for a ray displaced by (e, e^2) for infinitesimal e > 0; still zero only
/// where both points are seen as one.
int EdgeSide(const SeenPoint& a, const SeenPoint& b)
{
  const double p = a.U * b.V;
  const double q = b.U * a.V;
  if (p != q)
  {
    return p > q ? 1 : -1; // rounding is monotonic
  }
  const double pRest = std::fma(a.U, b.V, -p);
  const double qRest = std::fma(b.U, a.V, -q);
  if (pRest != qRest)
  {
    return pRest > qRest ? 1 : -1;
  }
  if (a.V != b.V)
  {
    return a.V > b.V ? 1 : -1;
  }
  if (a.U != b.U)
  {
    return b.U > a.U ? 1 : -1;
  }
  return 0;
}

/// Twice the area between the ray and the edge from a to b, without the sign.
double EdgeArea(const SeenPoint& a, const SeenPoint& b)
{
  const double p = a.U * b.V;
  const double q = b.U * a.V;
  return std::abs((p - q) + (std::fma(a.U, b.V, -p) - std::fma(b.U, a.V, -q)));
}

/// Part of a ray in one cell; it has no length where the cell is flat.
struct Segment
{
  Real Begin; ///< world distance along the ray
  double Length;
  double BeginScalar;
  double EndScalar;
  CellPassage Passage;
  std::int32_t Pixel; ///< in the band
  std::int32_t Cell;
};

/// A cell as the renderer reads it. Its points ascend, so that both cells at a face see the very
/// same numbers there and no surface slips through between them.
struct Cell
{
  std::int32_t Points[4];
  const double* Coordinates[4];
  double Scalars[4];
};

/// Clips the ray by a cell; false if the ray misses it. Of the four faces a ray passes none or two.
bool ClipByCell(const Ray& ray, const Cell& cell, Segment& segment)
{
  const double* const* points = cell.Coordinates;
  const double* scalars = cell.Scalars;
  SeenPoint seen[4];
  for (int i = 0; i < 4; ++i)
  {
    seen[i] = See(ray, points[i]);
  }
  const auto allBeside = [&seen](double SeenPoint::*coordinate)
  {
    const double a = seen[0].*coordinate;
    const double b = seen[1].*coordinate;
    const double c = seen[2].*coordinate;
    const double d = seen[3].*coordinate;
    return (a > 0 && b > 0 && c > 0 && d > 0) || (a < 0 && b < 0 && c < 0 && d < 0);
  };
  if (allBeside(&SeenPoint::U) || allBeside(&SeenPoint::V))
  {
    return false;
  }

  static constexpr int Faces[4][3] = { { 1, 2, 3 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 2 } };
  int side[4][4];
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      side[i][j] = EdgeSide(seen[i], seen[j]);
      side[j][i] = -side[i][j];
    }
  }
  Real t[2];
  double s[2];
  CellPassage::Face passed[2];
  int found = 0;
  for (const auto& face : Faces)
  {
    const int first = side[face[0]][face[1]];
    if (first == 0 || first != side[face[1]][face[2]] || first != side[face[2]][face[0]])
    {
      continue;
    }
    const double area[3] = { EdgeArea(seen[face[1]], seen[face[2]]),
      EdgeArea(seen[face[2]], seen[face[0]]), EdgeArea(seen[face[0]], seen[face[1]]) };
    const double sum = area[0] + area[1] + area[2];
    if (found == 2 || !(sum > 0))
    {
      return false; // only where products underflow
    }
    t[found] = 0;
    s[found] = scalars[face[0]]; // by differences, so that a constant stays exactly what it is
    for (int i = 0; i < 3; ++i)
    {
      t[found] += area[i] * seen[face[i]].T;
      s[found] += area[i] / sum * (scalars[face[i]] - scalars[face[0]]);
    }
    t[found] /= sum;
    passed[found] = { cell.Points[face[0]], cell.Points[face[1]], cell.Points[face[2]] };
    ++found;
  }
  if (found != 2)
  {
    return false;
  }
  const int begin = t[0] < t[1] ? 0 : 1;
  segment.Begin = t[begin];
  segment.Length = static_cast<double>(t[1 - begin] - t[begin]);
  segment.BeginScalar = s[begin];
  segment.EndScalar = s[1 - begin];
  segment.Passage = { { passed[begin], passed[1 - begin] }, { t[begin], t[1 - begin] } };
  return true;
}

/// Pixels or rows of pixels, both ends included; empty where First > Last.
struct Range
{
  int First = 0;
  int Last = -1;
};

/// Where points lie in the image: at pixel (X / W, Y / W), behind the camera if W is negative.
struct ImagePoint
{
  double X;
  double Y;
  double W;
};

/// Finds the pixels that may see a cell, a few too many rather than one too few. Knows parallel and
/// perspective cameras; of any other grid, every pixel has to try every cell.
class ImageProjection
{
public:
  explicit ImageProjection(const RayGrid& grid)
    : Width(grid.Width)
    , Height(grid.Height)
  {
    const auto direction = [&grid](const double v[3])
    { return TransformDirection(grid.MeshFromWorld, ToVector(v)); };
    const auto isZero = [](const double v[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
    this->Perspective = isZero(grid.OriginStepX) && isZero(grid.OriginStepY);
    const bool parallel = isZero(grid.DirectionStepX) && isZero(grid.DirectionStepY);
    this->Origin = TransformPoint(grid.MeshFromWorld, ToVector(grid.Origin));

    // A point P is seen at pixel (i, j) where P - Origin = i x + j y + w Direction in a parallel
    // image, w (i x + j y + Direction) in a perspective one.
    const Vector x = direction(this->Perspective ? grid.DirectionStepX : grid.OriginStepX);
    const Vector y = direction(this->Perspective ? grid.DirectionStepY : grid.OriginStepY);
    const Vector w = direction(grid.Direction);
    const Real determinant = Dot(Cross(x, y), w);
    const Real scale = std::sqrt(Dot(x, x) * Dot(y, y) * Dot(w, w));
    this->Usable =
      this->Perspective != parallel && std::abs(determinant) > SmallestDeterminant * scale;
    this->Inverse = { Cross(y, w), Cross(w, x), Cross(x, y) };
    for (Vector& row : this->Inverse)
    {
      for (Real& component : row)
      {
        component /= determinant;
      }
    }
  }

  ImagePoint Project(const double* point) const
  {
    const Vector offset{ point[0] - this->Origin[0], point[1] - this->Origin[1],
      point[2] - this->Origin[2] };
    const auto coordinate = [&](int row)
    { return static_cast<double>(Dot(this->Inverse[row], offset)); };
    return { coordinate(0), coordinate(1), this->Perspective ? coordinate(2) : 1 };
  }

  /// Rows that may see a cell.
  Range FindRows(const ImagePoint* const corners[4]) const
  {
    if (!this->Usable)
    {
      return { 0, this->Height - 1 };
    }
    double y[4];
    double w[4];
    for (int i = 0; i < 4; ++i)
    {
      y[i] = corners[i]->Y;
      w[i] = corners[i]->W;
    }
    return Cover(y, w, 4, this->Height);
  }

  /// Pixels of a row that may see a cell.
  Range FindPixels(const ImagePoint* const corners[4], int row) const
  {
    if (!this->Usable)
    {
      return { 0, this->Width - 1 };
    }
    // Corners of the polygon in which the plane of the row cuts the cell. Those within the margin
    // of the plane count as well, so that rounding can not lose the polygon.
    double x[10];
    double w[10];
    int count = 0;
    double distance[4];
    for (int i = 0; i < 4; ++i)
    {
      const ImagePoint& corner = *corners[i];
      distance[i] = corner.Y - row * corner.W;
      if (!(std::abs(distance[i]) > Margin * std::abs(corner.W) + Rounding * std::abs(corner.Y)))
      {
        x[count] = corner.X;
        w[count] = corner.W;
        ++count;
      }
    }
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        if ((distance[i] < 0) != (distance[j] < 0))
        {
          const double share = distance[i] / (distance[i] - distance[j]);
          x[count] = (1 - share) * corners[i]->X + share * corners[j]->X;
          w[count] = (1 - share) * corners[i]->W + share * corners[j]->W;
          ++count;
        }
      }
    }
    return count == 0 ? Range() : Cover(x, w, count, this->Width);
  }

private:
  /// Pixels; the projection is accurate to 1e-6 of a pixel in any sane image.
  static constexpr double Margin = 0.01;
  /// Relative rounding error of a coordinate of an ImagePoint, and some more.
  static constexpr double Rounding = 1e-12;
  /// Share of the product of the lengths; below it the steps of the grid do not span an image.
  static constexpr Real SmallestDeterminant = 1e-9L;

  /// The pixels of 0..size - 1 between the smallest and the largest value / w; all of them where
  /// values lie on both sides of the camera or too close to it to tell.
  static Range Cover(const double* values, const double* w, int count, int size)
  {
    const Range all{ 0, size - 1 };
    double minimum = std::numeric_limits<double>::infinity();
    double maximum = -minimum;
    for (int i = 0; i < count; ++i)
    {
      const double position = values[i] / w[i];
      if ((w[i] < 0) != (w[0] < 0) || !(std::abs(position) < Margin / Rounding))
      {
        return all;
      }
      minimum = std::min(minimum, position);
      maximum = std::max(maximum, position);
    }
    // Clamped before the conversion to int; a range beside the image becomes empty.
    const auto clamp = [size](double value) { return std::clamp<double>(value, -1, size); };
    return { static_cast<int>(std::max(0.0, clamp(std::ceil(minimum - Margin)))),
      static_cast<int>(std::min(size - 1.0, clamp(std::floor(maximum + Margin)))) };
  }

  int Width;
  int Height;
  bool Perspective;
  bool Usable;
  Vector Origin;
  std::array<Vector, 3> Inverse; ///< from mesh coordinates to those of an ImagePoint
};

/// The part of a segment that the limits keep.
struct SegmentPart
{
  Real Begin; ///< world distance along the ray
  double Length;
  double BeginScalar;
  double EndScalar;
  std::int32_t Cell;
};

/// The part of the segment in begin..end; false if there is none.
bool CutSegment(const Segment& segment, Real begin, Real end, SegmentPart& part)
{
  const Real segmentEnd = segment.Begin + segment.Length;
  if (begin >= segmentEnd || end <= segment.Begin || !(segment.Length > 0))
  {
    return false;
  }
  part = { segment.Begin, segment.Length, segment.BeginScalar, segment.EndScalar, segment.Cell };
  if (begin > segment.Begin || end < segmentEnd)
  {
    part.Begin = std::max(begin, segment.Begin);
    part.Length = static_cast<double>(std::min(end, segmentEnd) - part.Begin);
    const double from = static_cast<double>(part.Begin - segment.Begin) / segment.Length;
    const double to = from + part.Length / segment.Length;
    const double change = segment.EndScalar - segment.BeginScalar;
    part.BeginScalar = segment.BeginScalar + change * from;
    part.EndScalar = segment.BeginScalar + change * to;
  }
  return true;
}

/// What a ray gathers over its parts.
struct RayResult
{
  double Rgba[4] = { 0, 0, 0, 0 };
  double Depth = -1;
};

/// Emission and absorption, or one of them, front to back. integrate: a part.
template <class IntegrateT>
RayResult Integrate(
  const ReferenceOptics& optics, const std::vector<SegmentPart>& parts, const IntegrateT& integrate)
{
  const bool absorbs = optics.Model != OpticalModel::EmissionOnly;
  RayResult result;
  Real nearest = Infinity;
  double opticalDepth = 0;
  for (const SegmentPart& part : parts)
  {
    const ReferenceSegment segment = integrate(part);
    if (segment.OpticalDepth > 0)
    {
      nearest = std::min(nearest, part.Begin + segment.FirstContribution * part.Length);
      result.Depth = static_cast<double>(nearest);
    }
    const double transmittance = absorbs ? std::exp(-opticalDepth) : 1;
    for (int channel = 0; channel < 3; ++channel)
    {
      result.Rgba[channel] += transmittance * segment.Color[channel];
    }
    opticalDepth += segment.OpticalDepth;
    result.Rgba[3] = absorbs ? -std::expm1(-opticalDepth) : 0;
  }
  return result;
}

/// The largest scalar, classified.
RayResult FindMaximum(const ReferenceOptics& optics, const std::vector<SegmentPart>& parts)
{
  double largest = -std::numeric_limits<double>::infinity();
  Real depth = -1;
  const auto consider = [&](double scalar, Real t)
  {
    if (scalar > largest)
    {
      largest = scalar;
      depth = t;
    }
  };
  for (const SegmentPart& part : parts)
  {
    consider(part.BeginScalar, part.Begin);
    consider(part.EndScalar, part.Begin + part.Length);
  }
  RayResult result;
  if (!parts.empty())
  {
    const TransferFunction::Value value = EvaluateReference(optics.Function, largest);
    result.Rgba[3] = std::min(1.0, value.Attenuation);
    for (int channel = 0; channel < 3; ++channel)
    {
      result.Rgba[channel] = result.Rgba[3] * value.Color[channel];
    }
    result.Depth = result.Rgba[3] > 0 ? static_cast<double>(depth) : -1;
  }
  return result;
}

void Check(const ReferenceMesh& mesh, const ReferenceOptics& optics, const RayGrid& rays,
  Span<const std::uint8_t> pixels)
{
  const auto require = [](bool condition, const char* message)
  {
    if (!condition)
    {
      throw std::invalid_argument(message);
    }
  };
  require(mesh.Points.size() % 3 == 0, "RenderReference: Points must hold three for each point");
  require(mesh.Cells.size() % 4 == 0, "RenderReference: Cells must hold four ids for each cell");
  require(
    mesh.Scalars.size() == (mesh.CellScalars ? mesh.Cells.size() / 4 : mesh.Points.size() / 3),
    "RenderReference: Scalars must hold one value for each point, or cell with CellScalars");
  if (optics.Model == OpticalModel::Isosurfaces)
  {
    const auto& surfaces = optics.Isosurfaces;
    for (std::size_t i = 0; i + 1 < surfaces.size(); ++i)
    {
      require(surfaces[i].Value < surfaces[i + 1].Value,
        "RenderReference: the values of Isosurfaces must ascend");
    }
    require(!mesh.CellScalars, "RenderReference: Isosurfaces need one scalar for each point");
  }
  else
  {
    require(!optics.Function.Nodes.empty(), "RenderReference: the transfer function has no nodes");
  }
  require(rays.Width > 0 && rays.Height > 0, "RenderReference: the image has no pixels");
  require(pixels.empty() || pixels.size() == static_cast<std::size_t>(rays.Width) * rays.Height,
    "RenderReference: pixels must hold one value for each pixel");
}

/// False if the cell is unusable.
bool GetCell(const ReferenceMesh& mesh, std::size_t id, Cell& cell)
{
  const std::int64_t numberOfPoints = static_cast<std::int64_t>(mesh.Points.size() / 3);
  std::copy_n(mesh.Cells.data() + 4 * id, 4, cell.Points);
  std::sort(cell.Points, cell.Points + 4);
  for (int i = 0; i < 4; ++i)
  {
    const std::int32_t point = cell.Points[i];
    if (point < 0 || point >= numberOfPoints)
    {
      return false;
    }
    const double* x = mesh.Points.data() + 3 * static_cast<std::size_t>(point);
    const double scalar = mesh.Scalars[mesh.CellScalars ? id : static_cast<std::size_t>(point)];
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]) ||
      !std::isfinite(scalar))
    {
      return false;
    }
    cell.Coordinates[i] = x;
    cell.Scalars[i] = scalar;
  }
  return true;
}

/// Renders bands of rows, independently of each other.
class BandRenderer
{
public:
  BandRenderer(const ReferenceMesh& mesh, const ReferenceOptics& optics, const RayGrid& grid,
    const RayLimits& limits, Span<const std::uint8_t> pixels)
    : Mesh(mesh)
    , Optics(optics)
    , Grid(grid)
    , Limits(limits)
    , Pixels(pixels)
    , Projection(grid)
    , ImagePoints(mesh.Points.size() / 3)
    , Rows(mesh.Cells.size() / 4)
  {
    const std::int64_t numberOfPoints = static_cast<std::int64_t>(this->ImagePoints.size());
    for (std::int64_t point = 0; point < numberOfPoints; ++point)
    {
      this->ImagePoints[point] = this->Projection.Project(mesh.Points.data() + 3 * point);
    }
    for (std::size_t id = 0; id < this->Rows.size(); ++id)
    {
      Cell cell;
      if (GetCell(mesh, id, cell))
      {
        this->Rows[id] = this->Projection.FindRows(this->GetCorners(cell).data());
      }
    }
    if (optics.Shaded && optics.SmoothShading && !mesh.CellScalars)
    {
      this->PointGradients = this->FindPointGradients();
    }
  }

  /// Fills the image's rows; returns the number of segments.
  std::int64_t Render(const Range& rows, ReferenceImage& image) const
  {
    const std::vector<Ray> rays = this->MakeRays(rows);
    std::vector<Segment> segments = this->CollectSegments(rows, rays);
    std::stable_sort(segments.begin(), segments.end(),
      [](const Segment& a, const Segment& b) { return a.Pixel < b.Pixel; });
    const std::size_t firstPixel = static_cast<std::size_t>(rows.First) * this->Grid.Width;
    for (auto first = segments.begin(), last = first; first != segments.end(); first = last)
    {
      last = std::find_if(first, segments.end(),
        [&](const Segment& segment) { return segment.Pixel != first->Pixel; });
      const Span<const Segment> ofPixel(&*first, last - first);
      this->Composite(ofPixel, rays[first->Pixel], firstPixel + first->Pixel, image);
    }
    return std::count_if(
      segments.begin(), segments.end(), [](const Segment& segment) { return segment.Length > 0; });
  }

private:
  std::array<const ImagePoint*, 4> GetCorners(const Cell& cell) const
  {
    const auto corner = [&](int i) { return &this->ImagePoints[cell.Points[i]]; };
    return { corner(0), corner(1), corner(2), corner(3) };
  }

  /// Rays of the pixels that are wanted; the others are not valid.
  std::vector<Ray> MakeRays(const Range& rows) const
  {
    std::vector<Ray> rays;
    for (int j = rows.First; j <= rows.Last; ++j)
    {
      for (int i = 0; i < this->Grid.Width; ++i)
      {
        const std::size_t pixel = static_cast<std::size_t>(j) * this->Grid.Width + i;
        const bool wanted = this->Pixels.empty() || this->Pixels[pixel];
        rays.push_back(wanted ? MakeRay(this->Grid, i, j) : Ray());
      }
    }
    return rays;
  }

  std::vector<Segment> CollectSegments(const Range& rows, const std::vector<Ray>& rays) const
  {
    std::vector<Segment> segments;
    for (std::size_t id = 0; id < this->Rows.size(); ++id)
    {
      const Range common{ std::max(this->Rows[id].First, rows.First),
        std::min(this->Rows[id].Last, rows.Last) };
      Cell cell;
      if (common.First > common.Last || !GetCell(this->Mesh, id, cell))
      {
        continue;
      }
      const auto corners = this->GetCorners(cell);
      for (int j = common.First; j <= common.Last; ++j)
      {
        const Range pixels = this->Projection.FindPixels(corners.data(), j);
        for (int i = pixels.First; i <= pixels.Last; ++i)
        {
          Segment segment;
          segment.Pixel = (j - rows.First) * this->Grid.Width + i;
          segment.Cell = static_cast<std::int32_t>(id);
          const Ray& ray = rays[segment.Pixel];
          if (ray.Valid && ClipByCell(ray, cell, segment))
          {
            segments.push_back(segment);
          }
        }
      }
    }
    return segments;
  }

  /// segments: those of the pixel, in any order.
  void Composite(
    Span<const Segment> segments, const Ray& ray, std::size_t pixel, ReferenceImage& image) const
  {
    Real begin = Infinity;
    Real end = -Infinity;
    std::vector<CellPassage> passages;
    for (const Segment& segment : segments)
    {
      begin = std::min(begin, segment.Begin);
      end = std::max(end, segment.Begin + segment.Length);
      passages.push_back(segment.Passage);
    }
    const std::vector<std::size_t> order = OrderPassages(passages);
    std::vector<SegmentPart> parts;
    for (const auto& interval : ApplyReferenceLimits(this->Limits, ray, pixel, begin, end))
    {
      for (const std::size_t k : order)
      {
        SegmentPart part;
        if (CutSegment(segments[k], interval[0], interval[1], part))
        {
          parts.push_back(part);
          image.Length[pixel] += part.Length;
        }
      }
    }
    const auto integrate = [&](const SegmentPart& part) { return this->IntegratePart(ray, part); };
    const RayResult result = this->Optics.Model == OpticalModel::Isosurfaces
      ? this->CompositeSurfaces(ray, parts)
      : this->Optics.Model == OpticalModel::MaximumIntensity
      ? FindMaximum(this->Optics, parts)
      : Integrate(this->Optics, parts, integrate);
    std::copy(result.Rgba, result.Rgba + 4, image.Rgba.begin() + 4 * pixel);
    image.Depth[pixel] = result.Depth;
  }

  /// The surfaces that the ray meets.
  RayResult CompositeSurfaces(const Ray& ray, const std::vector<SegmentPart>& parts) const
  {
    struct Crossing
    {
      Real T;
      std::int32_t Cell;
      const Isosurface* Surface;
    };
    std::vector<Crossing> crossings;
    for (const SegmentPart& part : parts)
    {
      const double s0 = part.BeginScalar;
      const double s1 = part.EndScalar;
      const auto first = crossings.size();
      for (const Isosurface& surface : this->Optics.Isosurfaces)
      {
        if ((s0 < surface.Value) != (s1 < surface.Value))
        {
          const Real share = (static_cast<Real>(surface.Value) - s0) / (static_cast<Real>(s1) - s0);
          crossings.push_back({ part.Begin + share * part.Length, part.Cell, &surface });
        }
      }
      if (s1 < s0)
      {
        std::reverse(crossings.begin() + first, crossings.end());
      }
    }
    RayResult result;
    Real nearest = Infinity;
    for (const Crossing& crossing : crossings)
    {
      const double opacity = crossing.Surface->Opacity;
      if (opacity > 0)
      {
        nearest = std::min(nearest, crossing.T);
        result.Depth = static_cast<double>(nearest);
      }
      const std::array<double, 3> color =
        this->GetColor(ray, crossing.T, crossing.Cell, *crossing.Surface);
      const double share = (1 - result.Rgba[3]) * opacity;
      for (int channel = 0; channel < 3; ++channel)
      {
        result.Rgba[channel] += share * color[channel];
      }
      result.Rgba[3] += share;
    }
    return result;
  }

  /// The colour in which the ray sees the surface at distance t.
  std::array<double, 3> GetColor(
    const Ray& ray, Real t, std::int32_t cell, const Isosurface& surface) const
  {
    if (!this->Optics.Shaded)
    {
      return { surface.Color[0], surface.Color[1], surface.Color[2] };
    }
    const Place place = this->GetPlace(ray, t, cell);
    return ShadeReference(surface.Color, this->Optics.Surface, this->Optics.Lights, place.Point,
      place.Normal, place.View);
  }

  ReferenceSegment IntegratePart(const Ray& ray, const SegmentPart& part) const
  {
    const TransferFunction& function = this->Optics.Function;
    if (!this->Optics.Shaded || this->Optics.Model != OpticalModel::EmissionAbsorption ||
      this->Mesh.CellScalars)
    {
      return IntegrateReference(
        function, part.BeginScalar, part.EndScalar, part.Length, this->Optics.Model);
    }
    const auto light = [&](double share)
    {
      const Place place = this->GetPlace(ray, part.Begin + share * part.Length, part.Cell);
      return FindReferenceLight(
        this->Optics.Surface, this->Optics.Lights, place.Point, place.Normal, place.View);
    };
    // Where the gradient is shortest it may turn around within very little.
    const auto front = this->GetPlace(ray, part.Begin, part.Cell).Normal;
    const auto back = this->GetPlace(ray, part.Begin + part.Length, part.Cell).Normal;
    double along = 0;
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      along += front[axis] * (front[axis] - back[axis]);
      squared += (back[axis] - front[axis]) * (back[axis] - front[axis]);
    }
    return IntegrateLitReference(function, part.BeginScalar, part.EndScalar, part.Length, light,
      squared > 0 ? along / squared : 0);
  }

  /// Where light falls, in the world.
  struct Place
  {
    std::array<double, 3> Point;
    std::array<double, 3> Normal; ///< along the gradient, of any length
    std::array<double, 3> View;   ///< to the viewer, of length 1
  };

  Place GetPlace(const Ray& ray, Real t, std::int32_t cell) const
  {
    const Vector gradient = this->Optics.SmoothShading ? this->InterpolateGradient(ray, t, cell)
                                                       : this->GetGradient(cell);
    Place place;
    auto& [point, normal, view] = place;
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = static_cast<double>(ray.WorldOrigin[axis] + t * ray.WorldDirection[axis]);
      view[axis] = static_cast<double>(-ray.WorldDirection[axis]);
      normal[axis] = 0;
      for (int row = 0; row < 3; ++row)
      {
        // A gradient is carried to the world by the transpose of what carries points from there.
        normal[axis] += static_cast<double>(this->Grid.MeshFromWorld[row][axis] * gradient[row]);
      }
    }
    return place;
  }

  /// Along the gradient of the scalar in a cell, in mesh coordinates, of any length.
  Vector GetGradient(std::int32_t id) const
  {
    Cell cell;
    GetCell(this->Mesh, static_cast<std::size_t>(id), cell);
    Vector edges[3];
    for (int i = 0; i < 3; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        edges[i][axis] =
          static_cast<Real>(cell.Coordinates[i + 1][axis]) - cell.Coordinates[0][axis];
      }
    }
    // Cramer's rule for gradient * edge = difference of scalars, for each of three edges.
    const Real determinant = Dot(Cross(edges[0], edges[1]), edges[2]);
    Vector gradient{ 0, 0, 0 };
    for (int i = 0; i < 3; ++i)
    {
      const Vector normal = Cross(edges[(i + 1) % 3], edges[(i + 2) % 3]);
      const Real difference = static_cast<Real>(cell.Scalars[i + 1]) - cell.Scalars[0];
      for (int axis = 0; axis < 3; ++axis)
      {
        gradient[axis] += difference / determinant * normal[axis];
      }
    }
    return gradient;
  }

  /// The mean gradient of the cells at each point, weighted by their volumes.
  std::vector<Vector> FindPointGradients() const
  {
    std::vector<Vector> gradients(this->Mesh.Points.size() / 3, Vector{ 0, 0, 0 });
    std::vector<Real> volumes(gradients.size(), 0);
    const std::size_t numberOfCells = this->Mesh.Cells.size() / 4;
    for (std::size_t id = 0; id < numberOfCells; ++id)
    {
      Cell cell;
      const bool usable = GetCell(this->Mesh, id, cell);
      const Real volume = usable ? std::abs(GetSixfoldVolume(cell, nullptr, 0)) : 0;
      if (volume == 0)
      {
        continue;
      }
      const Vector gradient = this->GetGradient(static_cast<std::int32_t>(id));
      for (const std::int32_t point : cell.Points)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          gradients[point][axis] += volume * gradient[axis];
        }
        volumes[point] += volume;
      }
    }
    for (std::size_t point = 0; point < gradients.size(); ++point)
    {
      for (Real& component : gradients[point])
      {
        component /= volumes[point] > 0 ? volumes[point] : 1;
      }
    }
    return gradients;
  }

  /// The volume of a cell, signed; with one corner replaced by a point, where it is not nullptr.
  static Real GetSixfoldVolume(const Cell& cell, const Vector* point, int corner)
  {
    Vector corners[4];
    for (int i = 0; i < 4; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        corners[i][axis] =
          point && i == corner ? (*point)[axis] : static_cast<Real>(cell.Coordinates[i][axis]);
      }
    }
    for (int i = 1; i < 4; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        corners[i][axis] -= corners[0][axis];
      }
    }
    return Dot(Cross(corners[1], corners[2]), corners[3]);
  }

  /// Between the gradients of a cell's points, where the ray is at distance t.
  Vector InterpolateGradient(const Ray& ray, Real t, std::int32_t id) const
  {
    Cell cell;
    GetCell(this->Mesh, static_cast<std::size_t>(id), cell);
    Vector position;
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = ray.Origin[axis] + t * ray.Direction[axis];
    }
    const Real whole = GetSixfoldVolume(cell, nullptr, 0);
    Vector gradient{ 0, 0, 0 };
    for (int corner = 0; corner < 4; ++corner)
    {
      const Real share = GetSixfoldVolume(cell, &position, corner) / whole;
      const Vector ofPoint = this->PointGradients[cell.Points[corner]];
      for (int axis = 0; axis < 3; ++axis)
      {
        gradient[axis] += share * ofPoint[axis];
      }
    }
    return gradient;
  }

  const ReferenceMesh& Mesh;
  const ReferenceOptics& Optics;
  const RayGrid& Grid;
  const RayLimits& Limits;
  Span<const std::uint8_t> Pixels;
  ImageProjection Projection;
  std::vector<ImagePoint> ImagePoints;
  std::vector<Range> Rows;            ///< that may see a cell
  std::vector<Vector> PointGradients; ///< where lighting is smooth
};

/// Rows are rendered in bands of about this many pixels, one at a time for each thread: bounds the
/// memory for segments to some 128 bytes times the depth complexity times this.
constexpr int PixelsPerBand = 4096;

} // namespace

ReferenceImage RenderReference(const ReferenceMesh& mesh, const ReferenceOptics& optics,
  const RayGrid& rays, const RayLimits& limits, Span<const std::uint8_t> pixels)
{
  Check(mesh, optics, rays, pixels);
  const std::size_t numberOfPixels = static_cast<std::size_t>(rays.Width) * rays.Height;
  ReferenceImage image;
  image.Rgba.assign(4 * numberOfPixels, 0.0);
  image.Depth.assign(numberOfPixels, -1.0);
  image.Length.assign(numberOfPixels, 0.0);

  const BandRenderer renderer(mesh, optics, rays, limits, pixels);
  const int rowsPerBand = std::max(1, PixelsPerBand / rays.Width);
  const int numberOfBands = (rays.Height + rowsPerBand - 1) / rowsPerBand;
  std::int64_t numberOfSegments = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : numberOfSegments) if (numberOfBands > 1)
  for (int band = 0; band < numberOfBands; ++band)
  {
    const int firstRow = band * rowsPerBand;
    const int lastRow = std::min(rays.Height, firstRow + rowsPerBand) - 1;
    numberOfSegments += renderer.Render({ firstRow, lastRow }, image);
  }
  image.NumberOfSegments = numberOfSegments;
  return image;
}

std::vector<double> MeasureGrazing(const ReferenceMesh& mesh, const ReferenceOptics& optics,
  const RayGrid& rays, const RayLimits& limits, const ReferenceImage& image,
  Span<const std::uint8_t> pixels, double displacement)
{
  const std::size_t numberOfPixels = static_cast<std::size_t>(rays.Width) * rays.Height;
  if (image.Rgba.size() != 4 * numberOfPixels)
  {
    throw std::invalid_argument("MeasureGrazing: the image is not that of the rays");
  }
  const auto renderDisplaced = [&](double i, double j)
  {
    RayGrid displaced = rays;
    for (int axis = 0; axis < 3; ++axis)
    {
      displaced.Origin[axis] += i * rays.OriginStepX[axis] + j * rays.OriginStepY[axis];
      displaced.Direction[axis] += i * rays.DirectionStepX[axis] + j * rays.DirectionStepY[axis];
    }
    return RenderReference(mesh, optics, displaced, limits, pixels);
  };
  std::vector<double> grazing(numberOfPixels, 0.0);
  for (int direction = 0; direction < 2; ++direction)
  {
    const double i = direction == 0 ? displacement : 0;
    const double j = direction == 1 ? displacement : 0;
    const ReferenceImage left = renderDisplaced(-i, -j);
    const ReferenceImage right = renderDisplaced(i, j);
    for (std::size_t pixel = 0; pixel < numberOfPixels; ++pixel)
    {
      if (!pixels.empty() && !pixels[pixel])
      {
        continue;
      }
      for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
      {
        const double bend = std::abs(left.Rgba[k] - 2 * image.Rgba[k] + right.Rgba[k]);
        const double steepness = std::abs(right.Rgba[k] - left.Rgba[k]) / 2 - displacement;
        grazing[pixel] = std::max({ grazing[pixel], bend, steepness });
      }
    }
  }
  return grazing;
}

} // namespace tetralux
