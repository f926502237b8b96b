// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceComponents.h"

#include "ReferenceRays.h"
#include "ReferenceVector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

using reference::Cross;
using reference::Dot;
using reference::Real;
using reference::Vector;

/// Behind a ray this transparent nothing is seen.
constexpr double SmallestTransmittance = 1e-9;

/// A cell on a ray: the weights of its corners are Start + t Slope, t in world units.
struct CellPath
{
  Real Begin, End;
  std::size_t Cell;
  std::array<Real, 4> Start, Slope;
};

Vector Subtract(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/// Whether the ray goes through the cell.
bool Clip(const std::array<Vector, 4>& corners, const ReferenceRay& ray, CellPath& path)
{
  const Real whole = Dot(Subtract(corners[1], corners[0]),
    Cross(Subtract(corners[2], corners[0]), Subtract(corners[3], corners[0])));
  if (whole == 0)
  {
    return false;
  }
  path.Begin = -std::numeric_limits<Real>::infinity();
  path.End = -path.Begin;
  for (std::size_t k = 0; k < 4; ++k)
  {
    // The weight of a corner is the distance from the face across, over that of the corner.
    const Vector& a = corners[(k + 1) % 4];
    const Vector normal =
      Cross(Subtract(corners[(k + 2) % 4], a), Subtract(corners[(k + 3) % 4], a));
    const Real height = Dot(normal, Subtract(corners[k], a));
    path.Start[k] = Dot(normal, Subtract(ray.Origin, a)) / height;
    path.Slope[k] = Dot(normal, ray.Direction) / height;
    if (path.Slope[k] == 0)
    {
      if (path.Start[k] < 0)
      {
        return false;
      }
      continue;
    }
    const Real zero = -path.Start[k] / path.Slope[k];
    (path.Slope[k] > 0 ? path.Begin : path.End) =
      path.Slope[k] > 0 ? std::max(path.Begin, zero) : std::min(path.End, zero);
  }
  return path.Begin < path.End;
}

TransferFunction::Value Look(const TransferFunction& function, double scalar)
{
  const auto& nodes = function.Nodes;
  if (scalar < nodes.front().Scalar)
  {
    return nodes.front().Left;
  }
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
  {
    if (scalar < nodes[k + 1].Scalar)
    {
      const double t = (scalar - nodes[k].Scalar) / (nodes[k + 1].Scalar - nodes[k].Scalar);
      const TransferFunction::Value& a = nodes[k].Right;
      const TransferFunction::Value& b = nodes[k + 1].Left;
      TransferFunction::Value value{};
      value.Attenuation = a.Attenuation + t * (b.Attenuation - a.Attenuation);
      for (int c = 0; c < 3; ++c)
      {
        value.Color[c] = a.Color[c] + t * (b.Color[c] - a.Color[c]);
      }
      return value;
    }
  }
  return nodes.back().Right;
}

/// Attenuation, and emission in the place of colour.
TransferFunction::Value Mix(
  const ComponentFunctions& components, const std::array<double, MostComponents>& scalars)
{
  TransferFunction::Value mixed{};
  const std::size_t count = components.Functions.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    const TransferFunction::Value value = Look(components.Functions[k], scalars[k]);
    mixed.Attenuation += value.Attenuation;
    for (int c = 0; c < 3; ++c)
    {
      mixed.Color[c] += components.Dependent ? value.Color[c] : value.Attenuation * value.Color[c];
    }
  }
  for (double& channel : mixed.Color)
  {
    channel *= components.Dependent ? mixed.Attenuation : 1;
  }
  return mixed;
}

class PixelWalk
{
public:
  PixelWalk(const ReferenceMesh& mesh, const std::vector<std::vector<double>>& scalars,
    const ComponentFunctions& components)
    : Mesh(mesh)
    , Scalars(scalars)
    , Components(components)
  {
  }

  /// Adds what is between two distances, cut where a function may have a step.
  void Add(const CellPath& path, Real begin, Real end)
  {
    if (!this->IsFinite(path.Cell))
    {
      return;
    }
    std::vector<Real> ends = { begin, end };
    const auto first = this->At(path, begin);
    const auto last = this->At(path, end);
    for (std::size_t c = 0; c < this->Scalars.size(); ++c)
    {
      for (const TransferFunction::Node& node : this->Components.Functions[c].Nodes)
      {
        const Real share = (node.Scalar - first[c]) / (last[c] - first[c]);
        if (share > 0 && share < 1)
        {
          ends.push_back(begin + share * (end - begin));
        }
      }
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    {
      this->Step(path, ends[i], ends[i + 1]);
    }
  }

  std::array<double, 4> Rgba{};

private:
  void Step(const CellPath& path, Real begin, Real end)
  {
    double largest = 0;
    for (int i = 0; i < ReferenceSteps; ++i)
    {
      const Real t = begin + (end - begin) * (i + Real(0.5)) / ReferenceSteps;
      largest = std::max(largest, Mix(this->Components, this->At(path, t)).Attenuation);
    }
    const auto length = static_cast<double>(end - begin);
    const int steps =
      std::max(ReferenceSteps, static_cast<int>(std::ceil(largest * length / ReferenceStepDepth)));
    for (int i = 0; i<steps&& this->Transmittance> SmallestTransmittance; ++i)
    {
      const Real t = begin + (end - begin) * (i + Real(0.5)) / steps;
      const TransferFunction::Value value = Mix(this->Components, this->At(path, t));
      const double opacity = -std::expm1(-value.Attenuation * length / steps);
      for (int c = 0; c < 3; ++c)
      {
        this->Rgba[c] += value.Attenuation > 0
          ? this->Transmittance * opacity * value.Color[c] / value.Attenuation
          : 0;
      }
      this->Rgba[3] += this->Transmittance * opacity;
      this->Transmittance *= 1 - opacity;
    }
  }

  bool IsFinite(std::size_t cell) const
  {
    for (const std::vector<double>& values : this->Scalars)
    {
      for (int k = 0; k < 4; ++k)
      {
        if (!std::isfinite(values[this->Mesh.CellScalars ? cell : this->Mesh.Cells[4 * cell + k]]))
        {
          return false;
        }
      }
    }
    return true;
  }

  std::array<double, MostComponents> At(const CellPath& path, Real t) const
  {
    std::array<double, MostComponents> scalars{};
    for (std::size_t c = 0; c < this->Scalars.size(); ++c)
    {
      Real sum = 0;
      for (std::size_t k = 0; k < 4; ++k)
      {
        sum += (path.Start[k] + t * path.Slope[k]) *
          this
            ->Scalars[c][this->Mesh.CellScalars ? path.Cell : this->Mesh.Cells[4 * path.Cell + k]];
      }
      scalars[c] = static_cast<double>(sum);
    }
    return scalars;
  }

  const ReferenceMesh& Mesh;
  const std::vector<std::vector<double>>& Scalars;
  const ComponentFunctions& Components;
  double Transmittance = 1;
};

} // namespace

std::vector<double> RenderComponents(const ReferenceMesh& mesh,
  const std::vector<std::vector<double>>& scalars, const ComponentFunctions& components,
  const RayGrid& rays, const RayLimits& limits)
{
  const std::size_t pixels = static_cast<std::size_t>(rays.Width) * rays.Height;
  std::vector<double> picture(4 * pixels);
#pragma omp parallel for schedule(dynamic)
  for (std::int64_t pixel = 0; pixel < static_cast<std::int64_t>(pixels); ++pixel)
  {
    const ReferenceRay ray = MakeReferenceRay(
      rays, static_cast<int>(pixel % rays.Width), static_cast<int>(pixel / rays.Width));
    std::vector<CellPath> paths;
    for (std::size_t cell = 0; cell < mesh.Cells.size() / 4; ++cell)
    {
      std::array<Vector, 4> corners;
      for (std::size_t k = 0; k < 4; ++k)
      {
        corners[k] = reference::ToVector(&mesh.Points[3 * mesh.Cells[4 * cell + k]]);
      }
      CellPath path;
      path.Cell = cell;
      if (Clip(corners, ray, path))
      {
        paths.push_back(path);
      }
    }
    std::sort(paths.begin(), paths.end(),
      [](const CellPath& a, const CellPath& b) { return a.Begin < b.Begin; });
    PixelWalk walk(mesh, scalars, components);
    for (const CellPath& path : paths)
    {
      for (const auto& part : ApplyReferenceLimits(limits, ray, pixel, path.Begin, path.End))
      {
        walk.Add(path, part[0], part[1]);
      }
    }
    std::copy(walk.Rgba.begin(), walk.Rgba.end(), picture.begin() + 4 * pixel);
  }
  return picture;
}

} // namespace tetralux
