// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurfaces/StudyCase.h"

#include "Base/Stopwatch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <thread>
#include <utility>

namespace tetralux
{
namespace
{

constexpr Isosurface FirstSurface = { 0, { 1, 0.9f, 0.8f }, 1 };
constexpr Isosurface SecondSurface = { 0, { 0.4f, 0.6f, 1 }, 1 };

/// Distance of the light from the middle, in radii of the mesh.
constexpr double LightDistance = 3;

/// Distances of the camera's planes from its position, in radii of the mesh.
///@{
constexpr double NearDistance = 0.1;
constexpr double FarDistance = 20;
///@}

/// Gap between copies, as a share of the mesh's longest extent.
constexpr double CopyGap = 0.05;

/// All regions of a cropping but the one of the largest x, y and z, where the camera is.
constexpr std::uint32_t AllButUpperCorner = 0x3ffffff;

/// Before each frame, in which threads of the case before stop waiting for more work.
constexpr std::chrono::milliseconds PauseForThreads(2);

/// From the left, above and behind the camera.
Light MakeLight(const PerspectiveView& view, const double center[3], double radius)
{
  Light light{};
  light.Positional = true;
  for (int a = 0; a < 3; ++a)
  {
    const double direction = (-6 * view.Right[a] + 6 * view.Up[a] - 7 * view.Forward[a]) / 11;
    light.Position[a] = center[a] + LightDistance * radius * direction;
    light.Ambient[a] = light.Diffuse[a] = light.Specular[a] = 1;
  }
  return light;
}

/// What a window's depth buffer holds of points, relative to the camera's position.
DepthMap MakeDepthMap(const PerspectiveView& view, double radius)
{
  const double near = NearDistance * radius;
  const double far = FarDistance * radius;
  DepthMap map{};
  for (int a = 0; a < 3; ++a)
  {
    map.Depth[a] = (far + near) / (far - near) * view.Forward[a];
    map.Divisor[a] = view.Forward[a];
  }
  map.Depth[3] = -2 * far * near / (far - near);
  return map;
}

/// Distances of the points from the middle, and colours for them.
void SetColorArray(VolumeScene& scene)
{
  const WalkMesh& mesh = *scene.Mesh.GetMesh();
  const std::vector<double>& points = mesh.GetMesh().Points;
  const double* center = mesh.GetCenter();
  std::vector<double> distances;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    distances.push_back(
      std::hypot(points[i] - center[0], points[i + 1] - center[1], points[i + 2] - center[2]));
  }
  scene.Mesh.SetColorScalars(std::move(distances));
  const TransferFunction::Value blue = { { 0, 0, 1 }, 1 };
  const TransferFunction::Value green = { { 0, 1, 0 }, 1 };
  const TransferFunction::Value red = { { 1, 0, 0 }, 1 };
  TransferFunction function;
  function.Nodes = { { 0, blue, blue }, { 0.5 * mesh.GetRadius(), green, green },
    { mesh.GetRadius(), red, red } };
  scene.Optics.SetTransferFunction(function);
}

} // namespace

StudyMesh MakeStudyMesh(
  TetrahedralMesh mesh, const std::vector<double>& scalars, double isovalue, double second)
{
  StudyMesh result;
  result.Mesh = std::make_shared<WalkMesh>(std::move(mesh));
  result.Scalars = MapScalars(result.Mesh->GetMesh(), scalars);
  result.Isovalue = isovalue;
  result.SecondIsovalue = second;
  return result;
}

ComparisonMesh MakeCopies(const ComparisonMesh& mesh, int count)
{
  std::array<double, 3> lower, upper;
  for (int a = 0; a < 3; ++a)
  {
    lower[a] = upper[a] = mesh.Mesh.Points[a];
  }
  for (std::size_t i = 0; i < mesh.Mesh.Points.size(); ++i)
  {
    lower[i % 3] = std::min(lower[i % 3], mesh.Mesh.Points[i]);
    upper[i % 3] = std::max(upper[i % 3], mesh.Mesh.Points[i]);
  }
  double longest = 0;
  for (int a = 0; a < 3; ++a)
  {
    longest = std::max(longest, upper[a] - lower[a]);
  }

  ComparisonMesh result;
  result.Name = mesh.Name;
  const std::size_t copies = static_cast<std::size_t>(count) * count * count;
  result.Mesh.Points.reserve(copies * mesh.Mesh.Points.size());
  result.Mesh.Cells.reserve(copies * mesh.Mesh.Cells.size());
  result.Scalars.reserve(copies * mesh.Scalars.size());
  for (std::size_t copy = 0; copy < copies; ++copy)
  {
    const auto n = static_cast<std::size_t>(count);
    const std::size_t places[3] = { copy % n, copy / n % n, copy / (n * n) };
    const auto firstPoint = static_cast<std::int32_t>(result.Mesh.GetNumberOfPoints());
    for (std::size_t i = 0; i < mesh.Mesh.Points.size(); ++i)
    {
      const std::size_t a = i % 3;
      const double pitch = upper[a] - lower[a] + CopyGap * longest;
      result.Mesh.Points.push_back(mesh.Mesh.Points[i] + pitch * static_cast<double>(places[a]));
    }
    for (const std::int32_t point : mesh.Mesh.Cells)
    {
      result.Mesh.Cells.push_back(firstPoint + point);
    }
    result.Scalars.insert(result.Scalars.end(), mesh.Scalars.begin(), mesh.Scalars.end());
  }
  return result;
}

StudyCase::StudyCase(const StudyMesh& mesh, const StudySettings& settings, int size, double zoom)
  : Name(settings.Name)
  , Options(settings.Options)
{
  const double* center = mesh.Mesh->GetCenter();
  const double radius = mesh.Mesh->GetRadius();
  const PerspectiveView view(center, radius / zoom, size);
  this->Grid = view.Grid;
  this->Options.Shaded = true;
  this->Options.Lights = { MakeLight(view, center, radius) };

  this->Scene.Mesh.SetMesh(mesh.Mesh);
  this->Scene.Mesh.SetPointScalars(mesh.Scalars);
  this->Scene.Optics.SetModel(OpticalModel::Isosurfaces);
  std::vector<Isosurface> surfaces = { FirstSurface };
  surfaces.front().Value = mesh.Isovalue;
  if (settings.SecondSurface)
  {
    surfaces.push_back(SecondSurface);
    surfaces.back().Value = mesh.SecondIsovalue;
  }
  for (Isosurface& surface : surfaces)
  {
    surface.Opacity = settings.Opacity;
  }
  this->Scene.Optics.SetIsosurfaces(surfaces);
  if (settings.ColorArray)
  {
    SetColorArray(this->Scene);
  }
  if (settings.ClipPlane)
  {
    this->Limits.Planes.push_back({ 1, 0, 0, -center[0] });
  }
  if (settings.ClipBox)
  {
    this->Limits.Cropping = true;
    this->Limits.CroppingFlags = AllButUpperCorner;
    for (int a = 0; a < 3; ++a)
    {
      this->Limits.CroppingPlanes[2 * a] = center[a] - 2 * radius;
      this->Limits.CroppingPlanes[2 * a + 1] = center[a];
    }
  }
  const std::size_t pixels = static_cast<std::size_t>(size) * size;
  this->Colors.resize(4 * pixels);
  this->Depths.resize(pixels);
  if (settings.WindowDepths)
  {
    this->WindowDepths.resize(pixels);
    this->Options.WindowDepths = this->WindowDepths;
    this->Options.Depth = MakeDepthMap(view, radius);
  }
}

double StudyCase::DrawFrame()
{
  const Stopwatch stopwatch;
  this->Statistics = this->Tracer.Trace(
    this->Scene, this->Grid, this->Limits, this->Options, this->Colors, this->Depths);
  return stopwatch.GetSeconds();
}

std::vector<double> MeasureFrames(const StudyCases& cases, int frames)
{
  std::vector<std::vector<double>> seconds(cases.size());
  for (int frame = 0; frame <= frames; ++frame)
  {
    for (std::size_t c = 0; c < cases.size(); ++c)
    {
      std::this_thread::sleep_for(PauseForThreads);
      const double measured = cases[c]->DrawFrame();
      if (frame > 0)
      {
        seconds[c].push_back(measured);
      }
    }
  }
  std::vector<double> medians;
  std::transform(seconds.begin(), seconds.end(), std::back_inserter(medians), FindMedian);
  return medians;
}

double FindMedian(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

} // namespace tetralux
