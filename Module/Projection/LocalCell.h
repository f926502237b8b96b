// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LocalCell_h
#define tetralux_LocalCell_h

#include "Projection/LocalScreen.h"
#include "Projection/ScreenFrame.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{

/// Volumes below this times the product of three edges are rounding alone.
constexpr double SmallestRelativeVolume = 1e-15;

/// Slopes of a face in z beyond this belong to one that is seen exactly from the side: no pixel's
/// centre lies on it. Their products with pixels stay in the range of single precision.
constexpr double LargestSlope = 1e30;

/// What a face has in place of its function where it never limits a ray.
constexpr float Never = 1e37f;

/// A linear function of the pixel, relative to a cell's reference.
struct Linear
{
  double Value, SlopeX, SlopeY;
};

inline Linear operator-(const Linear& a, const Linear& b)
{
  return { a.Value - b.Value, a.SlopeX - b.SlopeX, a.SlopeY - b.SlopeY };
}

inline void Store(const Linear& f, double factor, float result[3])
{
  result[0] = static_cast<float>(factor * f.Value);
  result[1] = static_cast<float>(factor * f.SlopeX);
  result[2] = static_cast<float>(factor * f.SlopeY);
}

/// The tetrahedron whose faces and field become linear functions of the pixel, relative to a
/// reference pixel: of (x t, y t, t) with the eye in the origin, or of (x, y, t).
class LocalCell
{
public:
  LocalCell(const ScreenFrame& frame, const ScreenPoint* const points[4], bool homogeneous,
    double referenceX, double referenceY)
    : Homogeneous(homogeneous)
  {
    for (int i = 0; i < 4; ++i)
    {
      const ScreenPoint& p = *points[i];
      this->Points[i] = homogeneous ? GetHomogeneous(frame, p, referenceX, referenceY)
                                    : Vector{ p.X - referenceX, p.Y - referenceY, p.Depth };
    }
    const Vector a = this->Points[1] - this->Points[0];
    const Vector b = this->Points[2] - this->Points[0];
    const Vector c = this->Points[3] - this->Points[0];
    this->Normals[1] = Cross(b, c);
    this->Normals[2] = Cross(c, a);
    this->Normals[3] = Cross(a, b);
    this->Volume = Dot(this->Normals[1], a);
    this->HasVolume = this->Volume * this->Volume >
      SmallestRelativeVolume * SmallestRelativeVolume * (Dot(a, a) * Dot(b, b) * Dot(c, c));
    Vector& rest = this->Normals[0];
    rest = { 0, 0, 0 };
    this->Heights[0] = -this->Volume;
    for (int i = 1; i < 4; ++i)
    {
      const Vector& normal = this->Normals[i];
      rest = rest - normal;
      this->Heights[i] = Dot(normal, this->Points[0]);
      this->Heights[0] -= this->Heights[i];
    }
  }

  /// Whether there is anything inside, beyond rounding.
  bool HasVolume;

  /// z on a face, and whether rays enter by it; false where it is seen from the side.
  bool FindFace(int i, Linear& face, bool& front) const
  {
    const Vector& normal = this->Normals[i];
    if (this->Homogeneous)
    {
      const double height = this->Heights[i];
      const double inverse = 1 / height;
      face = { normal.Z * inverse, normal.X * inverse, normal.Y * inverse };
      front = (height > 0) == (this->Volume > 0);
    }
    else
    {
      const double inverse = 1 / normal.Z;
      face = { -this->Heights[i] * inverse, normal.X * inverse, normal.Y * inverse };
      front = (normal.Z > 0) == (this->Volume > 0);
    }
    return std::abs(face.Value) + std::abs(face.SlopeX) + std::abs(face.SlopeY) <= LargestSlope;
  }

  /// Of a face that is seen from the side: more than any z in front of it, less behind it.
  Linear FindSide(int i) const
  {
    const Vector& normal = this->Normals[i];
    const double size = std::max(std::abs(normal.X), std::abs(normal.Y));
    if (!(size > 0))
    {
      return { Never, 0, 0 };
    }
    const double scale = (this->Volume > 0 ? LargestSlope : -LargestSlope) / size;
    // In the plane of (x t, y t, t) that the eye is in, or of a direction without depth.
    const double constant = this->Homogeneous ? normal.Z : -this->Heights[i];
    return { scale * constant, scale * normal.X, scale * normal.Y };
  }

  /// A value that is linear in the cell, from those at its points: at z = base + something, times z
  /// where homogeneous, on base and for something.
  void FindField(const double values[4], const Linear& base, Linear& onBase, double& slope) const
  {
    Vector gradient = { 0, 0, 0 };
    const double inverse = 1 / this->Volume;
    for (int i = 1; i < 4; ++i)
    {
      const double share = (values[i] - values[0]) * inverse;
      gradient.X += share * this->Normals[i].X;
      gradient.Y += share * this->Normals[i].Y;
      gradient.Z += share * this->Normals[i].Z;
    }
    const double origin = values[0] - Dot(gradient, this->Points[0]);
    if (this->Homogeneous)
    {
      // value z = origin z + gradient . (x, y, 1)
      slope = origin;
      onBase = { gradient.Z, gradient.X, gradient.Y };
    }
    else
    {
      // value = origin + gradient . (x, y, -z)
      slope = -gradient.Z;
      onBase = { origin, gradient.X, gradient.Y };
    }
    onBase.Value += slope * base.Value;
    onBase.SlopeX += slope * base.SlopeX;
    onBase.SlopeY += slope * base.SlopeY;
  }

private:
  bool Homogeneous;
  Vector Points[4];
  Vector Normals[4]; ///< of each face, opposite to the point of that number; inwards for Volume > 0
  double Heights[4]; ///< normal . face
  double Volume;     ///< six times that of the cell, signed
};

} // namespace tetralux

#endif
