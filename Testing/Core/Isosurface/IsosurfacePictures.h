// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfacePictures_h
#define tetralux_IsosurfacePictures_h

#include "Isosurface/IsosurfaceTracer.h"
#include "RayScene.h"

#include <map>
#include <string>
#include <vector>

namespace tetralux
{

struct TracedPicture
{
  std::vector<float> Colors;
  std::vector<float> Depths;
  IsosurfaceStatistics Statistics;
};

/// Shaded, SmoothShading and Lights are those of the scene.
///@{
TracedPicture TracePicture(IsosurfaceTracer& tracer, VolumeScene& volume, const RayScene& scene,
  IsosurfaceOptions options = {});
TracedPicture TracePicture(const RayScene& scene, const IsosurfaceOptions& options = {});
///@}

/// Bit by bit.
bool IsSame(const TracedPicture& a, const TracedPicture& b);

/// What a picture may differ from the oracle by.
struct PictureTolerance
{
  /// Of a depth, in diameters of the mesh.
  double Depth = 2e-6;
  /// Of a channel: what IsosurfaceOptions::MaximumError lets rays leave out, and as much for light
  /// in single precision.
  double Channel = 2e-4;
  /// Share of the pixels that may be at silhouettes, where the oracle does not tell.
  double Silhouettes = 2e-3;
  /// A pixel is at a silhouette if the oracle's rays this far around it differ, in widths of the
  /// picture: above the rounding of rays in double precision, far below what a picture shows.
  double Displacement = 1e-9;
};

struct PictureDifference
{
  double Depth = 0;    ///< largest, in diameters of the mesh
  double Channel = 0;  ///< largest
  int Silhouettes = 0; ///< pixels left out
  int SeenAlone = 0;   ///< of them, those that are as no ray around them is
  int Hits = 0;        ///< surfaces that the oracle's rays met
  int Wrong = 0;       ///< pixels beyond the tolerance
};

/// Fails where a picture differs from IsosurfaceOracle by more than the tolerance.
PictureDifference ExpectOracle(const RayScene& scene, const TracedPicture& picture,
  bool shadows = false, const PictureTolerance& tolerance = {});

/// A generated mesh with surfaces of some values between its scalars, translucent, unlit.
RayScene MakeIsosurfaceScene(
  const std::string& mesh, const std::map<std::string, double>& parameters, int surfaces = 3);

/// Surfaces of values within the scalars' range, none of which is a scalar.
std::vector<Isosurface> MakeSurfaces(const std::vector<double>& scalars, int count, float opacity);

/// The middle and half the diagonal of the box around a mesh.
struct MeshBox
{
  explicit MeshBox(const TetrahedralMesh& mesh);
  std::array<double, 3> Middle;
  double Radius;
};

/// A camera that sees the whole mesh from outside, in a direction without symmetry.
RayGrid MakeOuterGrid(const TetrahedralMesh& mesh, bool parallel, int width, int height);

/// A perspective camera near the middle of the mesh, of a wide angle.
RayGrid MakeInnerGrid(const TetrahedralMesh& mesh, int width, int height);

/// A distant light, a positional one that fades, and a spot, around a mesh.
std::vector<Light> MakeIsosurfaceLights(const TetrahedralMesh& mesh);

} // namespace tetralux

#endif
