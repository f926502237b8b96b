// SPDX-License-Identifier: BSD-3-Clause
#include "Setup/SceneCamera.h"

#include "CommandLine/CommandErrors.h"
#include "Setup/SceneOptions.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace
{

constexpr double DefaultAzimuth = 30;   // degrees
constexpr double DefaultElevation = 20; // degrees

/// Sine of the angle between view and up below which they count as parallel.
constexpr double SmallestUpSine = 1e-6;

/// Distance of the near plane from a camera inside the bounds, as a fraction of their radius.
constexpr double NearFraction = 1e-6;

/// Margin of the clipping range against rounding, as a fraction of the bounds' radius.
constexpr double RangeMargin = 0.01;

constexpr double DefaultUp[3] = { 0, 1, 0 };

/// Distance of the focal point from which on vtkCamera takes it as it is, units of the data.
constexpr double SmallestFocalDistance = 1e-19;

bool IsAlong(const double direction[3], const double up[3])
{
  double cross[3];
  vtkMath::Cross(direction, up, cross);
  return vtkMath::Norm(cross) <= SmallestUpSine * vtkMath::Norm(direction) * vtkMath::Norm(up);
}

/// Fraction of the picture that a default view leaves free on either side.
constexpr double PictureMargin = 0.05;

/// Returns the direction of a default view. It is that of a camera at the origin: one that turns
/// around a focal point far away loses digits, and one that is too near does not turn.
SceneOptions::Vector GetDefaultDirection()
{
  vtkNew<vtkCamera> camera;
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(0, 0, 1);
  camera->Azimuth(DefaultAzimuth);
  camera->Elevation(DefaultElevation);
  SceneOptions::Vector direction;
  camera->GetDirectionOfProjection(direction.data());
  return direction;
}

/// Returns the distance from the focal point at which a camera sees all corners of a box.
double GetFittingDistance(const SceneOptions::Vector& focalPoint,
  const SceneOptions::Vector& forward, double viewAngle, const vtkBoundingBox& box,
  const SceneOptions& options)
{
  const double halfAngle = vtkMath::RadiansFromDegrees(0.5 * viewAngle);
  const double tangentY = (1 - PictureMargin) * std::tan(halfAngle);
  const double tangentX = tangentY * options.Width / options.Height;
  double up[3], right[3];
  vtkMath::Cross(forward.data(), DefaultUp, right);
  vtkMath::Normalize(right);
  vtkMath::Cross(right, forward.data(), up);
  double distance = 0;
  for (int i = 0; i < 8; ++i)
  {
    double corner[3];
    box.GetCorner(i, corner);
    vtkMath::Subtract(corner, focalPoint.data(), corner);
    const double acrossX = std::abs(vtkMath::Dot(corner, right));
    const double acrossY = std::abs(vtkMath::Dot(corner, up));
    distance = std::max(distance,
      std::max(acrossX / tangentX, acrossY / tangentY) - vtkMath::Dot(corner, forward.data()));
  }
  return distance > 0 ? distance : 1;
}

/// Returns the direction from one point to another, of length 1; 0 if they are the same.
SceneOptions::Vector GetDirection(const SceneOptions::Vector& from, const SceneOptions::Vector& to)
{
  SceneOptions::Vector direction;
  vtkMath::Subtract(to.data(), from.data(), direction.data());
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  for (double& x : direction)
  {
    x = length > 0 ? x / length : 0;
  }
  return direction;
}

/// Returns the point at a distance along a direction.
SceneOptions::Vector GoAlong(
  const SceneOptions::Vector& point, const SceneOptions::Vector& direction, double distance)
{
  return { point[0] + distance * direction[0], point[1] + distance * direction[1],
    point[2] + distance * direction[2] };
}

} // namespace

void CheckCamera(const SceneOptions& options)
{
  if (options.CameraViewAngle && options.CameraParallelScale)
  {
    throw UsageError("--camera-view-angle and --camera-parallel-scale: a camera has one of them, "
                     "the angle in perspective, the scale in parallel projection");
  }
  if (options.CameraPosition && options.CameraPosition == options.CameraFocalPoint)
  {
    throw UsageError("--camera-position: it must differ from --camera-focal-point");
  }
  if (options.CameraViewUp && vtkMath::Norm(options.CameraViewUp->data()) == 0)
  {
    throw UsageError("--camera-view-up: it must not be 0,0,0");
  }
}

void PlaceCamera(const SceneOptions& options, const double bounds[6], vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const vtkBoundingBox box(bounds);
  double center[3];
  box.GetCenter(center);
  const double radius = 0.5 * box.GetDiagonalLength();

  const SceneOptions::Vector focalPoint =
    options.CameraFocalPoint.value_or(SceneOptions::Vector{ center[0], center[1], center[2] });
  if (options.CameraViewAngle)
  {
    camera->SetViewAngle(*options.CameraViewAngle);
  }
  camera->SetParallelProjection(options.CameraParallelScale.has_value());

  SceneOptions::Vector position;
  SceneOptions::Vector direction;
  if (options.CameraPosition)
  {
    position = *options.CameraPosition;
    direction = GetDirection(position, focalPoint);
    if (vtkMath::Norm(direction.data()) == 0)
    {
      throw WorkError("--camera-position: it must differ from the focal point, which is the middle "
                      "of the data");
    }
  }
  else
  {
    direction = GetDefaultDirection();
    const double distance =
      GetFittingDistance(focalPoint, direction, camera->GetViewAngle(), box, options);
    position = GoAlong(focalPoint, direction, -distance);
    if (position == focalPoint)
    {
      throw WorkError(options.CameraFocalPoint
          ? "--camera-focal-point: it is too far from the data, so that it and a camera beside it "
            "are the same point"
          : "the data is too far from the origin for its size: a camera beside it is the same "
            "point");
    }
  }
  // Only its direction counts.
  const double focalDistance = std::max(SmallestFocalDistance,
    std::hypot(
      focalPoint[0] - position[0], focalPoint[1] - position[1], focalPoint[2] - position[2]));
  camera->SetPosition(position.data());
  camera->SetFocalPoint(GoAlong(position, direction, focalDistance).data());

  if (options.CameraViewUp)
  {
    if (IsAlong(direction.data(), options.CameraViewUp->data()))
    {
      throw WorkError("--camera-view-up: it must not lie along the direction of the view");
    }
    camera->SetViewUp(options.CameraViewUp->data());
  }
  else
  {
    IsAlong(direction.data(), DefaultUp) ? camera->SetViewUp(0, 0, 1)
                                         : camera->SetViewUp(DefaultUp);
  }
  if (options.CameraParallelScale)
  {
    camera->SetParallelScale(*options.CameraParallelScale);
  }

  double toCenter[3];
  vtkMath::Subtract(center, position.data(), toCenter);
  const double depth = vtkMath::Dot(toCenter, direction.data());
  const double reach = (1 + RangeMargin) * radius;
  const double nearest = std::max(depth - reach, NearFraction * radius);
  camera->SetClippingRange(nearest, std::max(depth + reach, 2 * nearest));
}
