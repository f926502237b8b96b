// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/CellProjector.h"

#include "Projection/CellSilhouette.h"
#include "View/RayAcross.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// Corners farther from the picture than this, in pixels, would cost a rasteriser its accuracy.
constexpr double LargestPosition = 16384;

/// How many times farther from 0 than another one's the z of the base may be. Differences to it are
/// rounded in single precision, so that a depth is off by at most 16 times 2^-24 of itself.
constexpr double LargestReach = 16;

} // namespace

int CellProjector::Project(const ScreenPoint* const (&points)[4], ProjectedCell& result)
{
  const ScreenFrame& frame = this->Frame;
  const ProjectionSettings& settings = this->Settings;
  const ScreenPoint& a = *points[0];
  const ScreenPoint& b = *points[1];
  const ScreenPoint& c = *points[2];
  const ScreenPoint& d = *points[3];
  const bool allInFront =
    frame.IsInFront(a) && frame.IsInFront(b) && frame.IsInFront(c) && frame.IsInFront(d);
  ScreenBox box = FindBox(frame, points);
  const ScreenBox whole = box;
  if (!Clamp(box, settings) || (!allInFront && !settings.Interpolate))
  {
    return 0;
  }
  const double referenceX = Floor(0.5 * (box.Lo[0] + box.Hi[0]));
  const double referenceY = Floor(0.5 * (box.Lo[1] + box.Hi[1]));
  this->Cell.emplace(frame, points, frame.IsPerspective() && settings.Interpolate,
    referenceX + settings.Shift, referenceY + ShiftSlope * settings.Shift);
  const LocalCell& cell = *this->Cell;
  double scalarLo = a.Scalar;
  double scalarHi = a.Scalar;
  double scalarSum = 0;
  for (const ScreenPoint* point : points)
  {
    scalarLo = std::min(scalarLo, point->Scalar);
    scalarHi = std::max(scalarHi, point->Scalar);
    scalarSum += point->Scalar;
  }
  if (!cell.HasVolume || !std::isfinite(scalarSum))
  {
    return 0;
  }

  Linear faces[4];
  bool seen[4];
  bool front[4];
  // The largest |z| of each face in the part of the picture that the cell covers; 1 at least in a
  // perspective.
  double reaches[4];
  double leastReach = std::numeric_limits<double>::max();
  bool allSeen = true;
  for (int i = 0; i < 4; ++i)
  {
    seen[i] = cell.FindFace(i, faces[i], front[i]);
    allSeen = allSeen && seen[i];
    reaches[i] = std::abs(faces[i].Value) +
      0.5 * std::abs(faces[i].SlopeX) * (box.Hi[0] - box.Lo[0]) +
      0.5 * std::abs(faces[i].SlopeY) * (box.Hi[1] - box.Lo[1]);
    leastReach = seen[i] ? std::min(leastReach, reaches[i]) : leastReach;
  }
  // The least steep one. A face whose plane passes the eye closely is not steep where it is
  // parallel to the picture, but differences to its z would be rounding alone.
  int base = -1;
  double leastSlope = std::numeric_limits<double>::max();
  for (int i = 0; i < 4; ++i)
  {
    const double slope = faces[i].SlopeX * faces[i].SlopeX + faces[i].SlopeY * faces[i].SlopeY;
    if (seen[i] && slope < leastSlope && reaches[i] <= LargestReach * std::max(leastReach, 1.))
    {
      leastSlope = slope;
      base = i;
    }
  }
  if (base < 0)
  {
    return 0;
  }

  // The silhouette.
  Place corners[4];
  int n = 0;
  const bool near = allInFront && whole.Lo[0] > -LargestPosition &&
    whole.Lo[1] > -LargestPosition && whole.Hi[0] < LargestPosition &&
    whole.Hi[1] < LargestPosition;
  if (near && allSeen)
  {
    n = FindSilhouette(points, front, settings.Margin, corners);
  }
  if (n == 0 && near)
  {
    n = 4;
    FindRectangle(points, settings.Margin, corners);
  }
  else if (n == 0)
  {
    n = 4;
    FindRectangle(box, settings.Margin, corners);
  }
  constexpr double Half = 0.5; // from pixels to the coordinates of gl_FragCoord
  const auto place = [&](int k, float& x, float& y)
  {
    x = static_cast<float>(corners[k].X + Half);
    y = static_cast<float>(corners[k].Y + Half);
  };
  place(0, result.First.X, result.First.Y);
  place(1, result.Second.X, result.Second.Y);
  place(2, result.Third.X, result.Third.Y);
  place(n == 4 ? 3 : 0, result.Fourth.X, result.Fourth.Y);

  // The faces, those of the side of the base first, and with them those that are seen from the
  // side.
  this->Base = faces[base];
  this->Sign = front[base] ? 1 : -1;
  float* slots[3] = { result.First.Face0, result.Second.Face1, result.Second.Face2 };
  int entries = 0;
  int exits = 0;
  this->Faces[0] = base;
  for (int i = 0; i < 4; ++i)
  {
    if (i != base)
    {
      const bool entry = !seen[i] || front[i] == front[base];
      const int slot = entry ? entries++ : 2 - exits++;
      this->Faces[slot + 1] = i;
      if (seen[i])
      {
        Store(faces[i] - this->Base, this->Sign, slots[slot]);
      }
      else
      {
        Store(cell.FindSide(i), 1, slots[slot]);
      }
    }
  }
  if (exits == 0 && allInFront)
  {
    return 0; // rounding left nothing of it
  }
  Store(this->Base, 1, result.First.Base);

  Linear scalar;
  double slope;
  const double scalars[4] = { a.Scalar, b.Scalar, c.Scalar, d.Scalar };
  cell.FindField(scalars, this->Base, scalar, slope);
  Store(scalar, 1, result.Third.Scalar);
  // z rises towards the eye.
  this->EyeScalar = frame.IsPerspective() && settings.Interpolate
    ? slope
    : std::copysign(std::numeric_limits<double>::infinity(), slope);
  result.Third.ScalarSlope = static_cast<float>(this->Sign * slope);
  result.Third.ScalarRange[0] = static_cast<float>(scalarLo);
  result.Third.ScalarRange[1] = static_cast<float>(scalarHi);
  result.Fourth.Reference[0] = static_cast<float>(referenceX + Half);
  result.Fourth.Reference[1] = static_cast<float>(referenceY + Half);
  std::fill_n(result.Fourth.Own, 3, 0.f);
  result.Fourth.Code = static_cast<float>(entries + (this->Sign < 0 ? 4 : 0));
  return n;
}

ProjectedGradient CellProjector::Project(const double gradients[4][3]) const
{
  ProjectedGradient result;
  for (int component = 0; component < 3; ++component)
  {
    const double values[4] = { gradients[0][component], gradients[1][component],
      gradients[2][component], gradients[3][component] };
    Linear field;
    double slope;
    this->Cell->FindField(values, this->Base, field, slope);
    result.Base[component] = static_cast<float>(field.Value);
    result.SlopeX[component] = static_cast<float>(field.SlopeX);
    result.SlopeY[component] = static_cast<float>(field.SlopeY);
    result.Slope[component] = static_cast<float>(this->Sign * slope);
  }
  return result;
}

} // namespace tetralux
