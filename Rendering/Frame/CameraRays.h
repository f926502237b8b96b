// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CameraRays_h
#define tetralux_CameraRays_h

#include "Frame/DrawnViewport.h"
#include "TetraluxRenderingModule.h"
#include "View/DepthMap.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <array>

class vtkCamera;
class vtkRenderer;

namespace tetralux
{

/// What pixels show, as homogeneous world coordinates relative to a position: ray (i, j) at depth d
/// of the depth buffer, 0..1, is at Farthest + i FarthestStepX + j FarthestStepY + (1 - d) Nearer.
struct DepthPlaces
{
  double Farthest[4], FarthestStepX[4], FarthestStepY[4], Nearer[4];
  double Position[3];

  /// Moves the rays, in pixels.
  void Shift(double x, double y);
};

/// Where the rays of a camera come from, in homogeneous coordinates of the world: the last one is
/// 1, or 0 in a parallel projection, where the others point against the rays. Throws
/// std::invalid_argument, with one line, where the camera's matrices have no inverse.
std::array<double, 4> FindEye(vtkCamera* camera);

/// The rays of a renderer's camera through the visible part of its viewport: any projection
/// that vtkCamera can make, since they are taken from its matrices. All is computed relative to the
/// camera's position, so that a scene far from the origin loses no accuracy.
class TETRALUXRENDERING_EXPORT CameraRays
{
public:
  /// sampleDistance: pixels from ray to ray. Throws std::invalid_argument, with one line, where the
  /// camera's matrices have no inverse.
  CameraRays(vtkRenderer* renderer, double sampleDistance);

  /// The visible part of the viewport; empty where Width or Height is 0.
  const PixelRectangle& GetVisible() const { return this->Viewport.Visible; }

  /// The rays, from the camera's eye or, in a parallel projection, the plane through it. Its
  /// MeshFromWorld is the identity.
  const RayGrid& GetGrid() const { return this->Grid; }

  /// Adds the near and the far plane.
  void AddClippingRange(RayLimits& limits) const;

  /// Pixels of the visible part that a box may cover; empty if it covers none. worldFromBox: rows
  /// of an affine matrix. center and halfSize: of the box.
  PixelRectangle FindCovered(
    const double worldFromBox[16], const double center[3], const double halfSize[3]) const;

  /// What the depth buffer holds of points in the world.
  DepthMap GetDepthMap() const;

  /// Distance in world units from the start of ray (i, j) to where the depth buffer (0..1) has this
  /// value. There are rays between those of the grid, too. Some 30 operations.
  double GetDistance(double i, double j, double depth) const;

  /// Width of a ray, its distance to the next one: the first number times the distance from its
  /// start, plus the second one.
  std::array<double, 2> GetWidth() const;

  DepthPlaces GetDepthPlaces() const;

private:
  /// Position of a ray in normalized device coordinates.
  void GetDevicePoint(double i, double j, double& x, double& y) const;

  DrawnViewport Viewport;
  RayGrid Grid;
  double Position[3] = { 0, 0, 0 };
  double DeviceFromWorld[16]; ///< rows; world relative to Position
  double WorldFromDevice[16];

  // For GetDistance.
  DepthPlaces Places;
  double DirectionScale =
    1; ///< makes squares of directions numbers that neither vanish nor overflow
};

} // namespace tetralux

#endif
