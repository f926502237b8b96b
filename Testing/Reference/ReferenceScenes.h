// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceScenes_h
#define tetralux_ReferenceScenes_h

#include "Mesh/TetrahedralMesh.h"
#include "Optics/TransferFunction.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// The rays of VTK's camera through the pixel centres of a whole image, which has the camera's
/// window to itself. ViewUp need not be perpendicular to the view, only not along it. Distances
/// along rays count from the position, in a parallel image from the plane through it.
///@{

/// viewAngle: the vertical one, degrees.
RayGrid MakePerspectiveGrid(const std::array<double, 3>& position,
  const std::array<double, 3>& focalPoint, const std::array<double, 3>& viewUp, double viewAngle,
  int width, int height);

/// parallelScale: half the height of the image, world units.
RayGrid MakeParallelGrid(const std::array<double, 3>& position,
  const std::array<double, 3>& focalPoint, const std::array<double, 3>& viewUp,
  double parallelScale, int width, int height);
///@}

/// The part of the image whose lower left pixel is (x, y); it may reach beyond the image.
RayGrid MakeTile(const RayGrid& grid, int x, int y, int width, int height);

/// Places the mesh in the world by an affine matrix (that of a volume): sets MeshFromWorld to its
/// inverse. Throws std::invalid_argument where there is none.
void PlaceMesh(RayGrid& grid, const double worldFromMesh[3][4]);

/// Adds the near and far plane of a camera; distances from the position along the view.
void AddClippingRange(RayLimits& limits, const std::array<double, 3>& position,
  const std::array<double, 3>& focalPoint, double nearDistance, double farDistance);

/// The function of one attenuation (per world unit) and colour everywhere.
TransferFunction MakeConstantFunction(double attenuation, const std::array<double, 3>& color);

/// A function without steps. Each of points: scalar, red, green, blue, attenuation per world unit.
TransferFunction MakeLinearFunction(const std::vector<std::array<double, 5>>& points);

/// A function whose colour and attenuation vary between its nodes at 0, 0.4 and 1, and step there.
TransferFunction MakeFunctionWithSteps();

/// A box of nx x ny x nz hexahedra, each split into five tetrahedra, points in rows along x, then
/// y, then z. Inner points are displaced at random by up to jitter times the spacing along each
/// axis; 0.15 keeps every volume positive. The hull stays a box.
TetrahedralMesh MakeBox(int nx, int ny, int nz, const std::array<double, 3>& lower,
  const std::array<double, 3>& upper, double jitter = 0, std::uint64_t seed = 1);

/// Long tetrahedra around the z axis, apart from each other, each with one end above the next one:
/// seen along z, none is the farthest.
TetrahedralMesh MakeCyclicTetrahedra(int count);

} // namespace tetralux

#endif
