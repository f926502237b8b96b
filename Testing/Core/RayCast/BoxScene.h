// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BoxScene_h
#define tetralux_BoxScene_h

// What tests of the ray caster share: a box with a smooth field, seen from outside.

#include "RayScene.h"

#include <array>
#include <string>
#include <vector>

namespace tetralux
{
namespace box_scene
{

using Vector = std::array<double, 3>;

/// Portable kernels round twice where the others round once; half of the error goal would already
/// mean that they compute something else.
inline constexpr double KernelDifference = 1e-5;

inline constexpr int ImageSize = 64;

inline RayGrid LookAtUnitCube(const Vector& from, int size = ImageSize)
{
  return MakePerspectiveGrid(from, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, size, size);
}

inline const Vector Oblique = { 3.1, 2.2, 2.7 };

inline TetrahedralMesh MakeUnitBox(int n, double jitter = 0.15)
{
  return MakeBox(n, n, n, { 0, 0, 0 }, { 1, 1, 1 }, jitter);
}

inline RayScene MakeBoxScene(int n = 11, double jitter = 0.15)
{
  RayScene scene;
  scene.Mesh = MakeUnitBox(n, jitter);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(20);
  scene.Grid = LookAtUnitCube(Oblique);
  return scene;
}

inline RayScene CellScalars()
{
  RayScene scene = MakeBoxScene();
  const std::vector<double> field = MakeSmoothField(scene.Mesh);
  scene.CellScalars = true;
  scene.Scalars.clear();
  for (std::size_t c = 0; c < scene.Mesh.Cells.size(); c += 4)
  {
    scene.Scalars.push_back(field[scene.Mesh.Cells[c]]);
  }
  return scene;
}

/// A function with steps.
inline RayScene Steps()
{
  RayScene scene = MakeBoxScene();
  scene.Function.Nodes = {
    { 0.2, { { 0, 0, 1 }, 0 }, { { 0, 0.2, 1 }, 2 } },
    { 0.4, { { 0, 1, 1 }, 3 }, { { 1, 0, 0 }, 0 } },
    { 0.5, { { 1, 1, 0 }, 0 }, { { 0, 1, 0 }, 8 } },
    { 0.8, { { 0, 1, 0.5 }, 8 }, { { 1, 1, 1 }, 40 } },
  };
  return scene;
}

inline std::string GetName(Precision precision)
{
  return precision == Precision::Single ? "single"
    : precision == Precision::Double    ? "double"
                                        : "automatic";
}

} // namespace box_scene
} // namespace tetralux

#endif
