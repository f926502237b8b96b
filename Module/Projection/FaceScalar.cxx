// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/FaceScalar.h"

#include "Projection/LocalScreen.h"
#include "View/RayAcross.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// Coefficients beyond this belong to a face that is seen exactly from the side. Their products
/// with pixels stay in the range of single precision.
constexpr double LargestCoefficient = 1e30;

/// f(x, y) = v . (x, y, 1) / divisor as it is stored; false where that leaves the range.
bool Store(const Vector& v, double divisor, float result[3])
{
  const double inverse = 1 / divisor;
  const double values[3] = { v.Z * inverse, v.X * inverse, v.Y * inverse };
  bool bounded = true;
  for (int k = 0; k < 3; ++k)
  {
    bounded = bounded && std::abs(values[k]) <= LargestCoefficient;
    result[k] = bounded ? static_cast<float>(values[k]) : 0.f;
  }
  return bounded;
}

} // namespace

FaceScalar FindFaceScalar(const ScreenFrame& frame, const ProjectionSettings& settings,
  const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c)
{
  const ScreenPoint* const points[3] = { &a, &b, &c };
  const ScreenBox box = FindBox(frame, points);
  const auto middle = [&](int axis, double size)
  { return Floor(0.5 * (Bound(box.Lo[axis], 0, size) + Bound(box.Hi[axis], 0, size))); };
  const double referenceX = middle(0, settings.Width);
  const double referenceY = middle(1, settings.Height);

  // A function f of the pixel with value f_i at point i, over the depth t_i in a perspective, is
  // v . (x, y, 1) where v . p_i = f_i, p_i = (x_i t_i, y_i t_i, t_i): by Cramer's rule.
  const bool homogeneous = frame.IsPerspective() && settings.Interpolate;
  const double originX = referenceX + settings.Shift;
  const double originY = referenceY + ShiftSlope * settings.Shift;
  Vector p[3];
  for (int i = 0; i < 3; ++i)
  {
    p[i] = homogeneous ? GetHomogeneous(frame, *points[i], originX, originY)
                       : Vector{ points[i]->X - originX, points[i]->Y - originY, 1 };
  }
  const double lowest = std::min({ a.Scalar, b.Scalar, c.Scalar });
  const double highest = std::max({ a.Scalar, b.Scalar, c.Scalar });
  Vector sum = { 0, 0, 0 };
  for (int i = 0; i < 3; ++i)
  {
    const double share = highest > lowest ? (points[i]->Scalar - lowest) / (highest - lowest) : 0;
    const Vector across = Cross(p[(i + 1) % 3], p[(i + 2) % 3]);
    sum = { sum.X + share * across.X, sum.Y + share * across.Y, sum.Z + share * across.Z };
  }
  const Vector normal = Cross(p[1] - p[0], p[2] - p[0]);
  const double determinant = Dot(normal, p[0]);

  FaceScalar result{};
  constexpr double Half = 0.5; // from pixels to the coordinates of gl_FragCoord
  result.Reference[0] = static_cast<float>(referenceX + Half);
  result.Reference[1] = static_cast<float>(referenceY + Half);
  result.Lowest = static_cast<float>(lowest);
  result.Highest = static_cast<float>(highest);
  const bool shareBounded = Store(sum, determinant, result.Share);
  const bool inverseBounded = Store(normal, determinant, result.Inverse);
  if (!shareBounded || !inverseBounded)
  {
    // Any scalar of it.
    std::fill_n(result.Share, 3, 0.f);
    std::fill_n(result.Inverse, 3, 0.f);
    result.Inverse[0] = 1;
  }
  return result;
}

} // namespace tetralux
