// SPDX-License-Identifier: BSD-3-Clause
#include "Setup/SceneCamera.h"

#include "CommandLine/CommandErrors.h"
#include "Setup/SceneOptions.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkMath.h"
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

bool IsAlong(const double direction[3], const double up[3])
{
  double cross[3];
  vtkMath::Cross(direction, up, cross);
  return vtkMath::Norm(cross) <= SmallestUpSine * vtkMath::Norm(direction) * vtkMath::Norm(up);
}

/// Fraction of the picture that a default view leaves free on either side.
constexpr double PictureMargin = 0.05;

/// Returns the distance from the focal point at which the camera sees all corners of a box. Its
/// direction is kept.
double GetFittingDistance(vtkCamera* camera, const vtkBoundingBox& box, const SceneOptions& options)
{
  const double halfAngle = vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle());
  const double tangentY = (1 - PictureMargin) * std::tan(halfAngle);
  const double tangentX = tangentY * options.Width / options.Height;
  double forward[3], up[3], right[3], focalPoint[3];
  camera->GetDirectionOfProjection(forward);
  camera->OrthogonalizeViewUp();
  camera->GetViewUp(up);
  vtkMath::Cross(forward, up, right);
  camera->GetFocalPoint(focalPoint);
  double distance = 0;
  for (int i = 0; i < 8; ++i)
  {
    double corner[3];
    box.GetCorner(i, corner);
    vtkMath::Subtract(corner, focalPoint, corner);
    const double acrossX = std::abs(vtkMath::Dot(corner, right));
    const double acrossY = std::abs(vtkMath::Dot(corner, up));
    distance = std::max(
      distance, std::max(acrossX / tangentX, acrossY / tangentY) - vtkMath::Dot(corner, forward));
  }
  return distance > 0 ? distance : 1;
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
  camera->SetFocalPoint(focalPoint.data());
  if (options.CameraViewAngle)
  {
    camera->SetViewAngle(*options.CameraViewAngle);
  }
  camera->SetParallelProjection(options.CameraParallelScale.has_value());

  if (options.CameraPosition)
  {
    camera->SetPosition(options.CameraPosition->data());
  }
  else
  {
    camera->SetPosition(focalPoint[0], focalPoint[1], focalPoint[2] + 1);
    camera->SetViewUp(0, 1, 0);
    camera->Azimuth(DefaultAzimuth);
    camera->Elevation(DefaultElevation);
    const double distance = GetFittingDistance(camera, box, options);
    double direction[3];
    camera->GetDirectionOfProjection(direction);
    camera->SetPosition(focalPoint[0] - distance * direction[0],
      focalPoint[1] - distance * direction[1], focalPoint[2] - distance * direction[2]);
  }

  double direction[3];
  camera->GetDirectionOfProjection(direction);
  if (vtkMath::Norm(direction) == 0)
  {
    throw WorkError("--camera-position: it must differ from the focal point, which is the middle "
                    "of the data");
  }
  if (options.CameraViewUp)
  {
    if (IsAlong(direction, options.CameraViewUp->data()))
    {
      throw WorkError("--camera-view-up: it must not lie along the direction of the view");
    }
    camera->SetViewUp(options.CameraViewUp->data());
  }
  else
  {
    const double y[3] = { 0, 1, 0 };
    IsAlong(direction, y) ? camera->SetViewUp(0, 0, 1) : camera->SetViewUp(y);
  }
  if (options.CameraParallelScale)
  {
    camera->SetParallelScale(*options.CameraParallelScale);
  }

  double position[3];
  camera->GetPosition(position);
  double toCenter[3];
  vtkMath::Subtract(center, position, toCenter);
  const double depth = vtkMath::Dot(toCenter, direction);
  const double reach = (1 + RangeMargin) * radius;
  const double nearest = std::max(depth - reach, NearFraction * radius);
  camera->SetClippingRange(nearest, std::max(depth + reach, 2 * nearest));
}
