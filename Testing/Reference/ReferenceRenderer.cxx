// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRenderer.h"

#include "ReferenceClipping.h"
#include "ReferenceGradients.h"
#include "ReferenceIntegral.h"
#include "ReferenceProjection.h"
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
      this->PointGradients = FindPointGradients(mesh);
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

  /// Where a ray is at a distance, in mesh coordinates.
  static Vector GoAlong(const Ray& ray, Real t)
  {
    Vector position;
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = ray.Origin[axis] + t * ray.Direction[axis];
    }
    return position;
  }

  Place GetPlace(const Ray& ray, Real t, std::int32_t cell) const
  {
    Cell corners;
    GetCell(this->Mesh, static_cast<std::size_t>(cell), corners);
    const Vector gradient = this->Optics.SmoothShading
      ? InterpolateGradient(corners, this->PointGradients, GoAlong(ray, t))
      : FindGradient(corners);
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

} // namespace tetralux
