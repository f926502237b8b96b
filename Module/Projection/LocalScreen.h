// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LocalScreen_h
#define tetralux_LocalScreen_h

// Cells and faces as they are seen around a reference pixel of their own: near to it, functions of
// the pixel keep their accuracy in single precision.

#include "Projection/ProjectionSettings.h"
#include "Projection/ScreenFrame.h"

#include <algorithm>
#include <limits>

namespace tetralux
{

struct Vector
{
  double X, Y, Z;
};

inline Vector operator-(const Vector& a, const Vector& b)
{
  return { a.X - b.X, a.Y - b.Y, a.Z - b.Z };
}

inline double Dot(const Vector& a, const Vector& b) { return a.X * b.X + a.Y * b.Y + a.Z * b.Z; }

inline Vector Cross(const Vector& a, const Vector& b)
{
  return { a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X };
}

/// Between lo and hi, also what is not a number.
inline double Bound(double x, double lo, double hi) { return x >= lo ? (x <= hi ? x : hi) : lo; }

/// std::floor of what an int holds, without the call that it takes on old processors.
inline double Floor(double x)
{
  const int truncated = static_cast<int>(x);
  return truncated - (x < truncated ? 1 : 0);
}

/// A point of a perspective as (x t, y t, t), with x and y relative to a place of the picture.
inline Vector GetHomogeneous(
  const ScreenFrame& frame, const ScreenPoint& p, double referenceX, double referenceY)
{
  if (frame.IsInFront(p))
  {
    return { (p.X - referenceX) * p.Depth, (p.Y - referenceY) * p.Depth, p.Depth };
  }
  return { p.X - referenceX * p.Depth, p.Y - referenceY * p.Depth, p.Depth };
}

/// The smallest rectangle of pixels, not rounded, around some places.
struct ScreenBox
{
  double Lo[2] = { std::numeric_limits<double>::max(), std::numeric_limits<double>::max() };
  double Hi[2] = { std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest() };

  void Add(double x, double y)
  {
    this->Lo[0] = std::min(this->Lo[0], x);
    this->Lo[1] = std::min(this->Lo[1], y);
    this->Hi[0] = std::max(this->Hi[0], x);
    this->Hi[1] = std::max(this->Hi[1], y);
  }
};

/// Places of the part of a cell, or of a face, that is in front of the eye: its corners, and where
/// its edges come from behind.
template <int Size>
ScreenBox FindBox(const ScreenFrame& frame, const ScreenPoint* const (&points)[Size])
{
  ScreenBox box;
  for (const ScreenPoint* a : points)
  {
    if (frame.IsInFront(*a))
    {
      box.Add(a->X, a->Y);
      continue;
    }
    for (const ScreenPoint* b : points)
    {
      if (frame.IsInFront(*b))
      {
        const double t = (ScreenFrame::SmallestDepth - a->Depth) / (b->Depth - a->Depth);
        const double x = a->X + t * (b->X * b->Depth - a->X);
        const double y = a->Y + t * (b->Y * b->Depth - a->Y);
        box.Add(x / ScreenFrame::SmallestDepth, y / ScreenFrame::SmallestDepth);
      }
    }
  }
  return box;
}

/// Cuts off what is beyond the picture; false where no pixel's centre is left.
inline bool Clamp(ScreenBox& box, const ProjectionSettings& settings)
{
  const double size[2] = { static_cast<double>(settings.Width),
    static_cast<double>(settings.Height) };
  for (int a = 0; a < 2; ++a)
  {
    box.Lo[a] = Bound(box.Lo[a], -1, size[a] + 1);
    box.Hi[a] = Bound(box.Hi[a], -2, size[a]);
    if (!(-Floor(settings.Margin - box.Lo[a]) <= Floor(box.Hi[a] + settings.Margin)))
    {
      return false;
    }
  }
  return box.Lo[0] < size[0] && box.Lo[1] < size[1] && box.Hi[0] > -1 && box.Hi[1] > -1;
}

} // namespace tetralux

#endif
