// SPDX-License-Identifier: BSD-3-Clause
#include "IsosurfaceOracle.h"

#include "ReferenceShading.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// What is nearer than this to a lit point does not block its light, radii of the mesh, with the
/// factor by which the offset is varied to tell the points where it decides.
constexpr double ShadowOffset = 1e-6;
constexpr double ShadowOffsetRange = 4;

/// Hits of a surface that are nearer than this to each other are one, as a share of the radius and
/// of the distance: above the rounding of extended precision, and what IsosurfaceKernel.inl takes.
constexpr long double SameDistance = 1e-12L;

template <class Vector>
auto Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Vector>
Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

template <class Vector>
Vector Subtract(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

template <class Vector>
auto Length(const Vector& a)
{
  return std::sqrt(Dot(a, a));
}

} // namespace

IsosurfaceOracle::IsosurfaceOracle(const RayScene& scene, bool shadows)
  : Scene(scene)
  , Shadows(shadows)
{
  const TetrahedralMesh& mesh = scene.Mesh;
  double lower[3], upper[3];
  std::fill_n(lower, 3, std::numeric_limits<double>::infinity());
  std::fill_n(upper, 3, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    lower[i % 3] = std::min(lower[i % 3], mesh.Points[i]);
    upper[i % 3] = std::max(upper[i % 3], mesh.Points[i]);
  }
  this->Radius = 0.5 * std::hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]);
  if (scene.Shaded && scene.SmoothShading)
  {
    const auto [least, largest] = std::minmax_element(scene.Scalars.begin(), scene.Scalars.end());
    this->Gradients =
      MakePointGradients(mesh, scene.Scalars, this->Radius, 0.5 * *largest - 0.5 * *least);
  }
  for (std::size_t id = 0; id < mesh.GetNumberOfCells(); ++id)
  {
    Cell cell;
    cell.Id = static_cast<std::int32_t>(id);
    Vector corners[4];
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t point = mesh.Cells[4 * id + i];
      cell.Scalars[i] = scene.Scalars[point];
      for (int a = 0; a < 3; ++a)
      {
        corners[i][a] = mesh.Points[3 * static_cast<std::size_t>(point) + a];
      }
    }
    const Real least = *std::min_element(cell.Scalars.begin(), cell.Scalars.end());
    const Real largest = *std::max_element(cell.Scalars.begin(), cell.Scalars.end());
    const bool crossed = std::any_of(scene.Isosurfaces.begin(), scene.Isosurfaces.end(),
      [&](const Isosurface& surface) { return least < surface.Value && surface.Value <= largest; });
    const bool finite = std::all_of(
      cell.Scalars.begin(), cell.Scalars.end(), [](Real s) { return std::isfinite(s); });
    const Vector edges[3] = { Subtract(corners[1], corners[0]), Subtract(corners[2], corners[0]),
      Subtract(corners[3], corners[0]) };
    const Real volume = Dot(edges[0], Cross(edges[1], edges[2]));
    if (!crossed || !finite || volume == 0)
    {
      continue;
    }
    cell.Corner = corners[0];
    for (int e = 0; e < 3; ++e)
    {
      const Vector across = Cross(edges[(e + 1) % 3], edges[(e + 2) % 3]);
      cell.Functions[e] = { across[0] / volume, across[1] / volume, across[2] / volume };
    }
    Sphere sphere{};
    for (int a = 0; a < 3; ++a)
    {
      sphere.Middle[a] =
        static_cast<double>(corners[0][a] + (edges[0][a] + edges[1][a] + edges[2][a]) / 4);
    }
    for (const Vector& corner : corners)
    {
      double squared = 0;
      for (int a = 0; a < 3; ++a)
      {
        const double x = static_cast<double>(corner[a] - sphere.Middle[a]);
        squared += x * x;
      }
      sphere.SquaredRadius = std::max(sphere.SquaredRadius, 1.01 * squared);
    }
    this->Spheres.push_back(sphere);
    this->Cells.push_back(cell);
  }
}

IsosurfaceOracle::Ray IsosurfaceOracle::MakeRay(const Vector& origin, const Vector& direction) const
{
  Ray ray;
  ray.Origin = origin;
  const Real length = Length(direction);
  for (int a = 0; a < 3; ++a)
  {
    ray.Direction[a] = direction[a] / length;
  }
  for (int a = 0; a < 3; ++a)
  {
    const double* row = this->Scene.Grid.MeshFromWorld[a];
    ray.MeshOrigin[a] = row[0] * origin[0] + row[1] * origin[1] + row[2] * origin[2] + row[3];
    ray.MeshDirection[a] =
      row[0] * ray.Direction[0] + row[1] * ray.Direction[1] + row[2] * ray.Direction[2];
  }
  return ray;
}

void IsosurfaceOracle::AddHits(
  const Ray& ray, Real from, Real to, bool ofLight, std::vector<Hit>& hits) const
{
  double origin[3], direction[3];
  for (int a = 0; a < 3; ++a)
  {
    origin[a] = static_cast<double>(ray.MeshOrigin[a]);
    direction[a] = static_cast<double>(ray.MeshDirection[a]);
  }
  const double speed2 =
    direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
  for (std::size_t c = 0; c < this->Cells.size(); ++c)
  {
    const Sphere& sphere = this->Spheres[c];
    double along = 0;
    double away[3];
    for (int a = 0; a < 3; ++a)
    {
      away[a] = sphere.Middle[a] - origin[a];
      along += away[a] * direction[a];
    }
    double beside2 = 0;
    for (int a = 0; a < 3; ++a)
    {
      const double x = away[a] - along / speed2 * direction[a];
      beside2 += x * x;
    }
    if (beside2 > sphere.SquaredRadius)
    {
      continue;
    }
    const Cell& cell = this->Cells[c];
    const Vector start = Subtract(ray.MeshOrigin, cell.Corner);
    std::array<Real, 4> base = { 1, 0, 0, 0 };
    std::array<Real, 4> slope = { 0, 0, 0, 0 };
    for (int i = 1; i < 4; ++i)
    {
      base[i] = Dot(cell.Functions[i - 1], start);
      slope[i] = Dot(cell.Functions[i - 1], ray.MeshDirection);
      base[0] -= base[i];
      slope[0] -= slope[i];
    }
    Real low = -std::numeric_limits<Real>::infinity();
    Real high = -low;
    int lowFace = 0;
    int highFace = 0;
    for (int i = 0; i < 4; ++i)
    {
      const Real distance = -base[i] / slope[i];
      if (slope[i] > 0 && distance > low)
      {
        low = distance;
        lowFace = i;
      }
      else if (slope[i] < 0 && distance < high)
      {
        high = distance;
        highFace = i;
      }
      else if (slope[i] == 0 && base[i] < 0)
      {
        high = low;
      }
    }
    if (!(low < high))
    {
      continue;
    }
    // Relative to a corner of the face, so that on a face of equal scalars nothing is rounded.
    const auto findScalar = [&](int face, Real distance)
    {
      const int first = face == 0 ? 1 : 0;
      Real scalar = cell.Scalars[first];
      for (int i = first + 1; i < 4; ++i)
      {
        scalar +=
          i == face ? 0 : (cell.Scalars[i] - cell.Scalars[first]) * (base[i] + slope[i] * distance);
      }
      return scalar;
    };
    const Real atLow = findScalar(lowFace, low);
    const Real atHigh = findScalar(highFace, high);
    for (std::size_t s = 0; s < this->Scene.Isosurfaces.size(); ++s)
    {
      const double value = this->Scene.Isosurfaces[s].Value;
      const bool counts = !ofLight || this->Scene.Isosurfaces[s].Opacity > 0;
      if (!counts || (atLow < value) == (atHigh < value))
      {
        continue;
      }
      const Real distance = low + (value - atLow) / (atHigh - atLow) * (high - low);
      if (from < distance && distance < to && this->IsKept(ray, distance, ofLight))
      {
        Hit hit{ distance, &cell, static_cast<int>(s), {} };
        for (int i = 0; i < 4; ++i)
        {
          hit.Shares[i] = base[i] + slope[i] * distance;
        }
        hits.push_back(hit);
      }
    }
  }
}

bool IsosurfaceOracle::IsKept(const Ray& ray, Real distance, bool ofLight) const
{
  const RayLimits& limits = this->Scene.Limits;
  for (std::size_t p = ofLight ? limits.NumberOfCameraPlanes : 0; p < limits.Planes.size(); ++p)
  {
    const std::array<double, 4>& plane = limits.Planes[p];
    Real inside = plane[3];
    for (int a = 0; a < 3; ++a)
    {
      inside += plane[a] * (ray.Origin[a] + distance * ray.Direction[a]);
    }
    if (inside < 0)
    {
      return false;
    }
  }
  if (!limits.Cropping)
  {
    return true;
  }
  int region = 0;
  int factor = 1;
  for (int a = 0; a < 3; ++a)
  {
    const double* planes = limits.CroppingPlanes + 2 * a;
    const Real x = ray.MeshOrigin[a] + distance * ray.MeshDirection[a];
    region += factor * (x < planes[0] ? 0 : x <= planes[1] ? 1 : 2);
    factor *= 3;
  }
  return (limits.CroppingFlags >> region & 1) != 0;
}

bool IsosurfaceOracle::IsBlocked(const Light& light, const Vector& world, Real offset) const
{
  const Vector position = { light.Position[0], light.Position[1], light.Position[2] };
  const Vector way = light.Positional ? Subtract(position, world) : position;
  const Ray ray = this->MakeRay(world, way);
  // The offset counts along the axis of the mesh that is nearest to the way, or along the way.
  const Vector& d = ray.MeshDirection;
  const Real along =
    light.Positional ? std::max({ std::abs(d[0]), std::abs(d[1]), std::abs(d[2]) }) : Length(d);
  std::vector<Hit> hits;
  this->AddHits(ray, offset * this->Radius / along,
    light.Positional ? Length(way) : std::numeric_limits<Real>::infinity(), true, hits);
  return !hits.empty();
}

std::array<double, 3> IsosurfaceOracle::Shade(
  const Hit& hit, const Ray& ray, Real shadowOffset) const
{
  const Isosurface& surface = this->Scene.Isosurfaces[hit.Surface];
  if (!this->Scene.Shaded)
  {
    return { surface.Color[0], surface.Color[1], surface.Color[2] };
  }
  Vector gradient = { 0, 0, 0 };
  for (int i = 0; i < 4; ++i)
  {
    if (this->Scene.SmoothShading)
    {
      const GradientRow& row =
        this->Gradients[this->Scene.Mesh.Cells[4 * static_cast<std::size_t>(hit.In->Id) + i]];
      gradient[0] += hit.Shares[i] * row.X;
      gradient[1] += hit.Shares[i] * row.Y;
      gradient[2] += hit.Shares[i] * row.Z;
    }
    else if (i > 0)
    {
      for (int a = 0; a < 3; ++a)
      {
        gradient[a] +=
          (hit.In->Scalars[i] - hit.In->Scalars[0]) * hit.In->Functions[i - 1][a] * this->Radius;
      }
    }
  }
  std::array<double, 3> point, normal, view;
  Vector world;
  for (int a = 0; a < 3; ++a)
  {
    world[a] = ray.Origin[a] + hit.Distance * ray.Direction[a];
    point[a] = static_cast<double>(world[a]);
    view[a] = static_cast<double>(-ray.Direction[a]);
    Real n = 0;
    for (int b = 0; b < 3; ++b)
    {
      n += this->Scene.Grid.MeshFromWorld[b][a] * gradient[b];
    }
    normal[a] = static_cast<double>(n);
  }
  std::vector<Light> lights = this->Scene.Lights;
  for (Light& light : lights)
  {
    if (this->Shadows && this->IsBlocked(light, world, shadowOffset))
    {
      std::fill_n(light.Diffuse, 3, 0.f);
      std::fill_n(light.Specular, 3, 0.f);
    }
  }
  return ShadeReference(surface.Color, Material(), lights, point, normal, view);
}

OraclePixel IsosurfaceOracle::Render(double x, double y) const
{
  return this->Render(x, y, ShadowOffset);
}

OraclePixel IsosurfaceOracle::Render(double x, double y, Real shadowOffset) const
{
  const RayGrid& grid = this->Scene.Grid;
  Vector origin, direction;
  for (int a = 0; a < 3; ++a)
  {
    origin[a] = grid.Origin[a] + static_cast<Real>(x) * grid.OriginStepX[a] +
      static_cast<Real>(y) * grid.OriginStepY[a];
    direction[a] = grid.Direction[a] + static_cast<Real>(x) * grid.DirectionStepX[a] +
      static_cast<Real>(y) * grid.DirectionStepY[a];
  }
  const bool parallel = std::all_of(
    grid.DirectionStepX, grid.DirectionStepX + 3, [](double step) { return step == 0; });
  const Ray ray = this->MakeRay(origin, direction);
  Real end = std::numeric_limits<Real>::infinity();
  if (!this->Scene.MaximumDistances.empty())
  {
    const auto column = static_cast<std::int64_t>(std::lround(x));
    const auto row = static_cast<std::int64_t>(std::lround(y));
    end = this->Scene.MaximumDistances[row * grid.Width + column];
  }
  std::vector<Hit> hits;
  this->AddHits(ray, parallel ? -std::numeric_limits<Real>::infinity() : 0, end, false, hits);
  std::sort(
    hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.Distance < b.Distance; });
  // A face whose points have the value, between two cells that are below it, is met once.
  hits.erase(std::unique(hits.begin(), hits.end(),
               [&](const Hit& a, const Hit& b)
               {
                 return a.Surface == b.Surface &&
                   b.Distance - a.Distance < SameDistance * (this->Radius + std::abs(a.Distance));
               }),
    hits.end());
  OraclePixel pixel;
  bool known = false;
  for (const Hit& hit : hits)
  {
    const double opacity = this->Scene.Isosurfaces[hit.Surface].Opacity;
    const std::array<double, 3> color = this->Shade(hit, ray, shadowOffset);
    const double share = (1 - pixel.Rgba[3]) * opacity;
    for (int c = 0; c < 3; ++c)
    {
      pixel.Rgba[c] += share * color[c];
    }
    pixel.Rgba[3] += share;
    pixel.Depth = known || opacity == 0 ? pixel.Depth : static_cast<double>(hit.Distance);
    known = known || opacity > 0;
  }
  pixel.Hits = static_cast<int>(hits.size());
  return pixel;
}

bool IsosurfaceOracle::IsAtSilhouette(int x, int y, const OraclePixel& pixel, double depth,
  double channel, double displacement, std::vector<OraclePixel>& around) const
{
  const double step =
    displacement * std::max({ this->Scene.Grid.Width, this->Scene.Grid.Height, 2 });
  around.clear();
  for (const auto& [dx, dy] : std::initializer_list<std::pair<double, double>>{
         { 0.9, 0.3 }, { 0.3, -0.9 }, { -0.8, 0.6 }, { -0.5, -0.7 } })
  {
    around.push_back(this->Render(x + step * dx, y + step * dy));
  }
  if (this->Shadows)
  {
    around.push_back(this->Render(x, y, ShadowOffset * ShadowOffsetRange));
    around.push_back(this->Render(x, y, ShadowOffset / ShadowOffsetRange));
  }
  return std::any_of(around.begin(), around.end(),
    [&](const OraclePixel& other)
    {
      bool differs = other.Hits != pixel.Hits || std::abs(other.Depth - pixel.Depth) > depth;
      for (int c = 0; c < 4; ++c)
      {
        differs = differs || std::abs(other.Rgba[c] - pixel.Rgba[c]) > channel;
      }
      return differs;
    });
}

} // namespace tetralux
