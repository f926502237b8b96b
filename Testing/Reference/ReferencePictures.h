// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferencePictures_h
#define tetralux_ReferencePictures_h

// What tests of the oracle's pictures share: scenes, and rays in plain terms.

#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace tetralux
{
namespace reference_pictures
{

using Vector = std::array<double, 3>;

/// A mesh with scalars, and the view of it that the renderer takes.
struct Scene
{
  TetrahedralMesh Mesh;
  std::vector<double> Scalars;
  bool CellScalars = false;

  ReferenceImage Render(const TransferFunction& function, const RayGrid& grid,
    const RayLimits& limits = {}, Span<const std::uint8_t> pixels = {}) const
  {
    return RenderReference(this->View(), function, grid, limits, pixels);
  }
  ReferenceMesh View() const
  {
    return { this->Mesh.Points, this->Mesh.Cells, this->Scalars, this->CellScalars };
  }
};

/// A scene whose scalar is gradient * point + constant.
inline Scene MakeLinearScene(TetrahedralMesh mesh, const Vector& gradient, double constant)
{
  Scene scene;
  scene.Mesh = std::move(mesh);
  for (std::size_t i = 0; i < scene.Mesh.Points.size(); i += 3)
  {
    const double* p = scene.Mesh.Points.data() + i;
    scene.Scalars.push_back(
      gradient[0] * p[0] + gradient[1] * p[1] + gradient[2] * p[2] + constant);
  }
  return scene;
}

inline Scene MakeConstantScene(TetrahedralMesh mesh)
{
  return MakeLinearScene(std::move(mesh), { 0, 0, 0 }, 0);
}

inline Scene MakeUnitTetrahedron()
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  mesh.Cells = { 0, 1, 2, 3 };
  return MakeConstantScene(std::move(mesh));
}

/// A ray in plain terms; its direction has length 1.
struct WorldRay
{
  long double Origin[3];
  long double Direction[3];
};

inline WorldRay GetRay(const RayGrid& grid, int i, int j)
{
  WorldRay ray;
  long double length = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    ray.Origin[axis] = grid.Origin[axis] + i * grid.OriginStepX[axis] + j * grid.OriginStepY[axis];
    ray.Direction[axis] =
      grid.Direction[axis] + i * grid.DirectionStepX[axis] + j * grid.DirectionStepY[axis];
    length += ray.Direction[axis] * ray.Direction[axis];
  }
  for (long double& component : ray.Direction)
  {
    component /= std::sqrt(length);
  }
  return ray;
}

/// The part begin..end of a line in a box; empty where begin >= end.
struct Chord
{
  long double Begin = -std::numeric_limits<long double>::infinity();
  long double End = std::numeric_limits<long double>::infinity();
  double Length() const
  {
    return this->Begin < this->End ? static_cast<double>(this->End - this->Begin) : 0;
  }
};

inline Chord ClipByBox(const WorldRay& ray, const Vector& lower, const Vector& upper)
{
  Chord chord;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (ray.Direction[axis] == 0)
    {
      if (ray.Origin[axis] < lower[axis] || ray.Origin[axis] > upper[axis])
      {
        return { 0, 0 };
      }
      continue;
    }
    const long double a = (lower[axis] - ray.Origin[axis]) / ray.Direction[axis];
    const long double b = (upper[axis] - ray.Origin[axis]) / ray.Direction[axis];
    chord.Begin = std::max(chord.Begin, std::min(a, b));
    chord.End = std::min(chord.End, std::max(a, b));
  }
  return chord;
}

/// One ray from position through target, as a picture of one pixel.
inline RayGrid MakeSingleRay(const Vector& position, const Vector& target)
{
  RayGrid grid;
  grid.Width = grid.Height = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Origin[axis] = position[axis];
    grid.Direction[axis] = target[axis] - position[axis];
  }
  return grid;
}

inline const TransferFunction Grey = MakeConstantFunction(1.5, { 0.2, 0.4, 0.8 });

} // namespace reference_pictures
} // namespace tetralux

#endif
