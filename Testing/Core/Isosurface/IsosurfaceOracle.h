// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceOracle_h
#define tetralux_IsosurfaceOracle_h

#include "RayScene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// What a ray sees of isosurfaces.
struct OraclePixel
{
  std::array<double, 4> Rgba = { 0, 0, 0, 0 }; ///< premultiplied
  double Depth = -1;                           ///< as IsosurfaceTracer::Trace
  int Hits = 0;
};

/// Isosurfaces by brute force: each ray is clipped by every cell that has any of the values, in
/// extended precision, and the crossings are sorted. Nothing is known about neighbours.
///
/// A ray that goes exactly through an edge may meet a surface in both cells there, or in none: such
/// rays are told by displaced ones (IsAtSilhouette).
class IsosurfaceOracle
{
public:
  /// The scene must outlive the oracle. shadows: whether surfaces block lights.
  explicit IsosurfaceOracle(const RayScene& scene, bool shadows = false);

  /// The ray of any point of the picture, in pixels.
  OraclePixel Render(double x, double y) const;

  /// The rays around a pixel, and whether they see something else than it does: another number of
  /// surfaces, or a depth or a channel that differs by more than given. displacement: how far
  /// around it, in widths of the picture.
  bool IsAtSilhouette(int x, int y, const OraclePixel& pixel, double depth, double channel,
    double displacement, std::vector<OraclePixel>& around) const;

  double GetDiameter() const { return 2 * this->Radius; } ///< of the box around the mesh

private:
  using Real = long double;
  using Vector = std::array<Real, 3>;

  /// Coordinates of the ends of three edges are Functions (x - Corner).
  struct Cell
  {
    std::int32_t Id;
    Vector Corner;
    Vector Functions[3];
    std::array<Real, 4> Scalars;
  };
  /// Around a cell, and a little larger.
  struct Sphere
  {
    double Middle[3];
    double SquaredRadius;
  };
  struct Ray
  {
    Vector Origin, Direction;         ///< world; of length 1
    Vector MeshOrigin, MeshDirection; ///< the same in the mesh
  };
  struct Hit
  {
    Real Distance;
    const Cell* In;
    int Surface;
    std::array<Real, 4> Shares; ///< of the corners
  };

  Ray MakeRay(const Vector& origin, const Vector& direction) const;
  OraclePixel Render(double x, double y, Real shadowOffset) const;
  /// ofLight: planes of the camera and surfaces that are not visible do not count.
  void AddHits(const Ray& ray, Real from, Real to, bool ofLight, std::vector<Hit>& hits) const;
  bool IsKept(const Ray& ray, Real distance, bool ofLight) const;
  bool IsBlocked(const Light& light, const Vector& world, Real offset) const;
  std::array<double, 3> Shade(const Hit& hit, const Ray& ray, Real shadowOffset) const;

  const RayScene& Scene;
  bool Shadows;
  double Radius;
  std::vector<Cell> Cells; ///< that any surface crosses
  std::vector<Sphere> Spheres;
  std::vector<GradientRow> Gradients; ///< of points, where lighting is smooth
};

} // namespace tetralux

#endif
