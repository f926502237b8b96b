// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneOptics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace tetralux
{
namespace
{

std::vector<float> ConvertTexels(const PreIntegrationTable& table)
{
  const int n = table.Scalars.GetSize();
  const int lengths = table.Lengths.Size;
  std::vector<float> texels(4 * static_cast<std::size_t>(n) * n * lengths);
#pragma omp parallel for schedule(static)
  for (int length = 0; length < lengths; ++length)
  {
    float* texel = &texels[4 * static_cast<std::size_t>(n) * n * length];
    for (int back = 0; back < n; ++back)
    {
      for (int front = 0; front < n; ++front, texel += 4)
      {
        table.GetTexel(front, back, length, texel);
      }
    }
  }
  return texels;
}

/// Without padding, and infinite only at both ends: bits tell.
bool AreEqual(
  const std::vector<IntervalTable::Interval>& a, const std::vector<IntervalTable::Interval>& b)
{
  return a.size() == b.size() &&
    std::memcmp(a.data(), b.data(), a.size() * sizeof(IntervalTable::Interval)) == 0;
}

} // namespace

void SceneOptics::SetTransferFunction(
  TransferFunction function, double error, const RunTolerance& tolerance)
{
  IntervalTable intervals = MakeIntervalTable(function, tolerance);
  this->Function = std::move(function);
  this->ApproximationError = error;
  this->SetIntervals(std::move(intervals), tolerance);
}

bool SceneOptics::SetRunTolerance(const RunTolerance& tolerance)
{
  IntervalTable intervals = MakeIntervalTable(this->Function, tolerance);
  const bool changed = !AreEqual(intervals.Intervals, this->Intervals.Intervals);
  if (changed)
  {
    this->SetIntervals(std::move(intervals), tolerance);
  }
  this->SetFunctionError(tolerance);
  return changed;
}

void SceneOptics::SetIntervals(IntervalTable intervals, const RunTolerance& tolerance)
{
  this->Intervals = std::move(intervals);
  this->SetFunctionError(tolerance);
  this->FunctionVersion = MakeVersion();
  this->SetTable(nullptr, 0);
}

void SceneOptics::SetFunctionError(const RunTolerance& tolerance)
{
  this->FunctionError = this->ApproximationError + (this->Intervals.Exact ? 0 : tolerance.Picture);
}

void SceneOptics::SetComponents(ComponentFunctions components)
{
  const std::size_t count = components.Functions.size();
  if (count == 1 || count > static_cast<std::size_t>(MostComponents))
  {
    throw std::invalid_argument("there are functions of " + std::to_string(count) +
      " scalars; there can be 2 to " + std::to_string(MostComponents));
  }
  std::vector<IntervalTable> intervals;
  intervals.reserve(count);
  for (const TransferFunction& function : components.Functions)
  {
    intervals.push_back(MakeIntervalTable(function));
  }
  this->Components = std::move(components);
  this->ComponentIntervals = std::move(intervals);
  this->FunctionVersion = MakeVersion();
}

void SceneOptics::SetIsosurfaces(std::vector<Isosurface> surfaces)
{
  for (const Isosurface& surface : surfaces)
  {
    const float* c = surface.Color;
    if (!std::isfinite(surface.Value) || !std::isfinite(c[0] + c[1] + c[2] + surface.Opacity))
    {
      throw std::invalid_argument("values, colours and opacities of isosurfaces must be finite");
    }
  }
  std::stable_sort(surfaces.begin(), surfaces.end(),
    [](const Isosurface& a, const Isosurface& b) { return a.Value < b.Value; });
  this->Surfaces.clear();
  for (const Isosurface& surface : surfaces)
  {
    if (!this->Surfaces.empty() && this->Surfaces.back().Value == surface.Value)
    {
      this->Surfaces.pop_back();
    }
    this->Surfaces.push_back(surface);
  }
  this->SurfacesVersion = MakeVersion();
}

void SceneOptics::SetTable(std::shared_ptr<const PreIntegrationTable> table, double pictureError)
{
  this->Table = std::move(table);
  this->TableError = pictureError;
  this->TableVersion = MakeVersion();
}

void SceneOptics::PrepareFloatTexels()
{
  if (this->Table && this->Table->Settings.Format != TexelFormat::Float)
  {
    this->Texels.Update(
      CacheKey::Of(this->TableVersion), [this] { return ConvertTexels(*this->Table); });
  }
  else
  {
    this->Texels.Reset();
  }
}

const float* SceneOptics::GetFloatTexels() const
{
  if (!this->Table)
  {
    return nullptr;
  }
  return this->Table->Settings.Format == TexelFormat::Float
    ? reinterpret_cast<const float*>(this->Table->Texels.GetData())
    : this->Texels.Get().data();
}

} // namespace tetralux
