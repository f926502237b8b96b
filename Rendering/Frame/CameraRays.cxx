// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/CameraRays.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tetralux
{
namespace
{

using Vector4 = std::array<double, 4>;

/// Change of the homogeneous coordinate from the near to the far plane, relative, below which a
/// projection counts as parallel: the rounding of an explicit matrix, while the most distant eye
/// that makes sense gives more.
constexpr double SmallestPerspective = 1e-12;

/// The model-view matrix for coordinates relative to a position. What rounding leaves of the
/// position's own image, which is the origin for all cameras but special ones, is set to 0.
void MakeRelative(const vtkMatrix4x4* matrix, const double position[3], double result[16])
{
  constexpr double Rounding = 8 * std::numeric_limits<double>::epsilon();
  for (int row = 0; row < 4; ++row)
  {
    double sum = matrix->GetElement(row, 3);
    double size = std::abs(sum);
    for (int column = 0; column < 3; ++column)
    {
      const double element = matrix->GetElement(row, column);
      result[4 * row + column] = element;
      sum += element * position[column];
      size += std::abs(element * position[column]);
    }
    result[4 * row + 3] = std::abs(sum) <= Rounding * size ? 0 : sum;
  }
}

void Invert(const double matrix[16], double result[16])
{
  const double determinant = vtkMatrix4x4::Determinant(matrix);
  if (determinant == 0 || !std::isfinite(determinant))
  {
    throw std::invalid_argument("the camera's matrices have no inverse: its position, focal point "
                                "or clipping range is degenerate");
  }
  vtkMatrix4x4::Invert(matrix, result);
}

Vector4 Multiply(const double matrix[16], const Vector4& vector)
{
  Vector4 result;
  vtkMatrix4x4::MultiplyPoint(matrix, vector.data(), result.data());
  return result;
}

/// Towards larger depths, at a point a + z b of homogeneous coordinates: linear in a.
std::array<double, 3> GetDirection(const Vector4& a, const Vector4& b)
{
  return { b[0] * a[3] - a[0] * b[3], b[1] * a[3] - a[1] * b[3], b[2] * a[3] - a[2] * b[3] };
}

} // namespace

std::array<double, 4> FindEye(vtkCamera* camera)
{
  double position[3];
  camera->GetPosition(position);
  double viewFromWorld[16];
  double worldFromView[16];
  double viewFromDevice[16];
  MakeRelative(camera->GetModelViewTransformMatrix(), position, viewFromWorld);
  Invert(viewFromWorld, worldFromView);
  // The same eye for any aspect.
  Invert(camera->GetProjectionTransformMatrix(1, -1, 1)->GetData(), viewFromDevice);
  const Vector4 middle = Multiply(worldFromView, Multiply(viewFromDevice, { 0, 0, 0, 1 }));
  const Vector4 eye = Multiply(worldFromView, Multiply(viewFromDevice, { 0, 0, 1, 0 }));
  if (std::abs(eye[3]) > SmallestPerspective * std::abs(middle[3]))
  {
    return { position[0] + eye[0] / eye[3], position[1] + eye[1] / eye[3],
      position[2] + eye[2] / eye[3], 1 };
  }
  const std::array<double, 3> direction = GetDirection(middle, eye);
  return { -direction[0], -direction[1], -direction[2], 0 };
}

void DepthPlaces::Shift(double x, double y)
{
  for (int c = 0; c < 4; ++c)
  {
    this->Farthest[c] += x * this->FarthestStepX[c] + y * this->FarthestStepY[c];
  }
}

CameraRays::CameraRays(vtkRenderer* renderer, double sampleDistance)
{
  this->Viewport = FindDrawnViewport(renderer);
  const PixelRectangle& visible = this->Viewport.Visible;
  if (visible.Width == 0)
  {
    return;
  }
  const auto countRays = [sampleDistance](int pixels)
  { return std::max(1, static_cast<int>(std::lround(pixels / sampleDistance))); };
  this->Grid.Width = countRays(visible.Width);
  this->Grid.Height = countRays(visible.Height);

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->GetPosition(this->Position);
  double viewFromWorld[16];
  MakeRelative(camera->GetModelViewTransformMatrix(), this->Position, viewFromWorld);
  const double* deviceFromView =
    camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1)->GetData();
  // Inverted one by one: the zeros of each stay zeros.
  double worldFromView[16];
  double viewFromDevice[16];
  Invert(viewFromWorld, worldFromView);
  Invert(deviceFromView, viewFromDevice);
  vtkMatrix4x4::Multiply4x4(deviceFromView, viewFromWorld, this->DeviceFromWorld);
  vtkMatrix4x4::Multiply4x4(worldFromView, viewFromDevice, this->WorldFromDevice);

  // The points that pixel (i, j) shows are a + z b, where a is linear in i and j.
  double x0, y0, x1, y1;
  this->GetDevicePoint(0, 0, x0, y0);
  this->GetDevicePoint(1, 1, x1, y1);
  const Vector4 a = Multiply(this->WorldFromDevice, { x0, y0, 0, 1 });
  const Vector4 stepX = Multiply(this->WorldFromDevice, { x1 - x0, 0, 0, 0 });
  const Vector4 stepY = Multiply(this->WorldFromDevice, { 0, y1 - y0, 0, 0 });
  const Vector4 b = Multiply(this->WorldFromDevice, { 0, 0, 1, 0 });

  const std::array<double, 3> direction = GetDirection(a, b);
  this->Places = this->GetDepthPlaces();
  this->DirectionScale =
    1 / std::max({ std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2]) });
  if (std::abs(b[3]) > SmallestPerspective * std::abs(a[3]))
  {
    // All rays come from where z is infinite.
    const std::array<double, 3> directionX = GetDirection(stepX, b);
    const std::array<double, 3> directionY = GetDirection(stepY, b);
    for (int c = 0; c < 3; ++c)
    {
      this->Grid.Origin[c] = this->Position[c] + b[c] / b[3];
      this->Grid.Direction[c] = direction[c];
      this->Grid.DirectionStepX[c] = directionX[c];
      this->Grid.DirectionStepY[c] = directionY[c];
    }
    return;
  }

  // Parallel rays start on the plane z = 0 of the view.
  const double* plane = &viewFromWorld[8];
  const double slope = plane[0] * direction[0] + plane[1] * direction[1] + plane[2] * direction[2];
  const auto onPlane = [&](const Vector4& point, double offset, int c)
  {
    const double height =
      (plane[0] * point[0] + plane[1] * point[1] + plane[2] * point[2]) / a[3] + offset;
    return point[c] / a[3] - (slope != 0 ? height / slope * direction[c] : 0);
  };
  for (int c = 0; c < 3; ++c)
  {
    this->Grid.Origin[c] = this->Position[c] + onPlane(a, plane[3], c);
    this->Grid.OriginStepX[c] = onPlane(stepX, 0, c);
    this->Grid.OriginStepY[c] = onPlane(stepY, 0, c);
    this->Grid.Direction[c] = direction[c];
  }
}

void CameraRays::GetDevicePoint(double i, double j, double& x, double& y) const
{
  const PixelRectangle& whole = this->Viewport.Whole;
  const PixelRectangle& visible = this->Viewport.Visible;
  const double pixelX = visible.X - whole.X + (i + 0.5) * visible.Width / this->Grid.Width;
  const double pixelY = visible.Y - whole.Y + (j + 0.5) * visible.Height / this->Grid.Height;
  x = 2 * pixelX / whole.Width - 1;
  y = 2 * pixelY / whole.Height - 1;
}

DepthPlaces CameraRays::GetDepthPlaces() const
{
  double x0, y0, x1, y1;
  this->GetDevicePoint(0, 0, x0, y0);
  this->GetDevicePoint(1, 1, x1, y1);
  // Depth 1 is at z = 1 of device coordinates, depth 0 at z = -1.
  const Vector4 farthest = Multiply(this->WorldFromDevice, { x0, y0, 1, 1 });
  const Vector4 stepX = Multiply(this->WorldFromDevice, { x1 - x0, 0, 0, 0 });
  const Vector4 stepY = Multiply(this->WorldFromDevice, { 0, y1 - y0, 0, 0 });
  const Vector4 nearer = Multiply(this->WorldFromDevice, { 0, 0, -2, 0 });
  DepthPlaces places;
  std::copy(farthest.begin(), farthest.end(), places.Farthest);
  std::copy(stepX.begin(), stepX.end(), places.FarthestStepX);
  std::copy(stepY.begin(), stepY.end(), places.FarthestStepY);
  std::copy(nearer.begin(), nearer.end(), places.Nearer);
  std::copy_n(this->Position, 3, places.Position);
  return places;
}

void CameraRays::AddClippingRange(RayLimits& limits) const
{
  // -w <= z <= w of device coordinates.
  for (const int sign : { 1, -1 })
  {
    std::array<double, 4> plane;
    for (int c = 0; c < 4; ++c)
    {
      plane[c] = this->DeviceFromWorld[12 + c] + sign * this->DeviceFromWorld[8 + c];
    }
    for (int c = 0; c < 3; ++c)
    {
      plane[3] -= plane[c] * this->Position[c];
    }
    limits.Planes.insert(limits.Planes.begin() + limits.NumberOfCameraPlanes, plane);
    ++limits.NumberOfCameraPlanes;
  }
}

PixelRectangle CameraRays::FindCovered(
  const double worldFromBox[16], const double center[3], const double halfSize[3]) const
{
  const PixelRectangle& whole = this->Viewport.Whole;
  const PixelRectangle& visible = this->Viewport.Visible;
  const PixelRectangle all{ 0, 0, visible.Width, visible.Height };
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  double lower[2] = { Infinity, Infinity };
  double upper[2] = { -Infinity, -Infinity };
  for (int corner = 0; corner < 8; ++corner)
  {
    Vector4 point = { 0, 0, 0, 1 };
    for (int c = 0; c < 3; ++c)
    {
      point[c] = center[c] + ((corner >> c & 1) != 0 ? halfSize[c] : -halfSize[c]);
    }
    point = Multiply(worldFromBox, point);
    for (int c = 0; c < 3; ++c)
    {
      point[c] -= this->Position[c];
    }
    point = Multiply(this->DeviceFromWorld, point);
    const double x = (point[0] / point[3] + 1) / 2 * whole.Width + whole.X - visible.X;
    const double y = (point[1] / point[3] + 1) / 2 * whole.Height + whole.Y - visible.Y;
    if (!(point[3] > 0) || !std::isfinite(x) || !std::isfinite(y))
    {
      return all; // a part of the box is behind the eye
    }
    lower[0] = std::min(lower[0], x);
    lower[1] = std::min(lower[1], y);
    upper[0] = std::max(upper[0], x);
    upper[1] = std::max(upper[1], y);
  }
  // A pixel more on each side, for what rounding does.
  const auto clamp = [](double x, int size)
  { return static_cast<int>(std::max(0., std::min(x, static_cast<double>(size)))); };
  const int x0 = clamp(std::floor(lower[0]) - 1, visible.Width);
  const int y0 = clamp(std::floor(lower[1]) - 1, visible.Height);
  const int x1 = clamp(std::ceil(upper[0]) + 1, visible.Width);
  const int y1 = clamp(std::ceil(upper[1]) + 1, visible.Height);
  return x0 < x1 && y0 < y1 ? PixelRectangle{ x0, y0, x1 - x0, y1 - y0 } : PixelRectangle();
}

DepthMap CameraRays::GetDepthMap() const
{
  DepthMap map;
  std::copy_n(this->DeviceFromWorld + 8, 4, map.Depth);
  std::copy_n(this->DeviceFromWorld + 12, 4, map.Divisor);
  for (int c = 0; c < 3; ++c)
  {
    const double offset = this->Grid.Origin[c] - this->Position[c];
    map.Depth[3] += map.Depth[c] * offset;
    map.Divisor[3] += map.Divisor[c] * offset;
  }
  return map;
}

double CameraRays::GetDistance(double i, double j, double depth) const
{
  // All that is divided is linear in i, j and depth.
  const DepthPlaces& places = this->Places;
  const auto getPlace = [&](int c)
  {
    return places.Farthest[c] + i * places.FarthestStepX[c] + j * places.FarthestStepY[c] +
      (1 - depth) * places.Nearer[c];
  };
  const double weight = 1 / getPlace(3);
  double along = 0;
  double squares = 0;
  for (int c = 0; c < 3; ++c)
  {
    const double origin = this->Grid.Origin[c] - this->Position[c] + i * this->Grid.OriginStepX[c] +
      j * this->Grid.OriginStepY[c];
    const double direction = this->DirectionScale *
      (this->Grid.Direction[c] + i * this->Grid.DirectionStepX[c] +
        j * this->Grid.DirectionStepY[c]);
    along += (getPlace(c) * weight - origin) * direction;
    squares += direction * direction;
  }
  return along / std::sqrt(squares);
}

std::array<double, 2> CameraRays::GetWidth() const
{
  const auto measure = [](const double(&vector)[3])
  { return std::hypot(vector[0], vector[1], vector[2]); };
  double middle[3]; // of the grid
  for (int c = 0; c < 3; ++c)
  {
    middle[c] = this->Grid.Direction[c] +
      0.5 *
        (this->Grid.Width * this->Grid.DirectionStepX[c] +
          this->Grid.Height * this->Grid.DirectionStepY[c]);
  }
  return { measure(this->Grid.DirectionStepX) / measure(middle), measure(this->Grid.OriginStepX) };
}

} // namespace tetralux
