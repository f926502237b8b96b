// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/CellSilhouette.h"

#include <cmath>

namespace tetralux
{
namespace
{

/// A widened corner may move by this many margins; sharper ones get a rectangle around all.
constexpr double LongestMiter = 64;

/// A convex polygon, each edge moved outwards; false where a corner is too sharp for that.
bool Widen(Place* corners, int n, double margin)
{
  double area = 0;
  for (int k = 0; k < n; ++k)
  {
    const Place& a = corners[k];
    const Place& b = corners[(k + 1) % n];
    area +=
      (a.X - corners[0].X) * (b.Y - corners[0].Y) - (a.Y - corners[0].Y) * (b.X - corners[0].X);
  }
  Place normals[4]; // of the edge from each corner on, outwards
  for (int k = 0; k < n; ++k)
  {
    const double dx = corners[(k + 1) % n].X - corners[k].X;
    const double dy = corners[(k + 1) % n].Y - corners[k].Y;
    const double scale = (area < 0 ? -1 : 1) / std::sqrt(dx * dx + dy * dy);
    normals[k] = { dy * scale, -dx * scale };
  }
  for (int k = 0; k < n; ++k)
  {
    const Place& before = normals[(k + n - 1) % n];
    const Place& after = normals[k];
    const double sum = 1 + before.X * after.X + before.Y * after.Y; // 2 cos^2 of half the angle
    if (!(sum >= 2 / (LongestMiter * LongestMiter)))
    {
      return false;
    }
    const double miter = margin / sum;
    corners[k].X += miter * (before.X + after.X);
    corners[k].Y += miter * (before.Y + after.Y);
  }
  return true;
}

} // namespace

int FindSilhouette(
  const ScreenPoint* const points[4], const bool front[4], double margin, Place corners[4])
{
  const int fronts = front[0] + front[1] + front[2] + front[3];
  int order[4];
  int n = 0;
  if (fronts == 1 || fronts == 3)
  {
    // Class 1: the triangle of the one face that looks the other way.
    for (int i = 0; i < 4; ++i)
    {
      if (front[i] != (fronts == 1))
      {
        order[n++] = i;
      }
    }
  }
  else if (fronts == 2)
  {
    // Class 2: the edge between the front faces joins the points that back faces are opposite to,
    // and crosses the edge between the back faces.
    int first = 0;
    int second = 1;
    for (int i = 0; i < 4; ++i)
    {
      if (front[i])
      {
        order[first] = i;
        first += 2;
      }
      else
      {
        order[second] = i;
        second += 2;
      }
    }
    n = 4;
  }
  for (int k = 0; k < n; ++k)
  {
    corners[k] = { points[order[k]]->X, points[order[k]]->Y };
  }
  return n > 0 && Widen(corners, n, margin) ? n : 0;
}

void FindRectangle(const ScreenPoint* const points[4], double margin, Place corners[4])
{
  double longest = 0;
  Place along = { 1, 0 };
  for (int i = 0; i < 4; ++i)
  {
    for (int k = 0; k < i; ++k)
    {
      const double dx = points[i]->X - points[k]->X;
      const double dy = points[i]->Y - points[k]->Y;
      const double length = std::sqrt(dx * dx + dy * dy);
      if (length > longest)
      {
        longest = length;
        along = { dx / length, dy / length };
      }
    }
  }
  ScreenBox box; // along and across
  for (int i = 0; i < 4; ++i)
  {
    const double dx = points[i]->X - points[0]->X;
    const double dy = points[i]->Y - points[0]->Y;
    box.Add(dx * along.X + dy * along.Y, dy * along.X - dx * along.Y);
  }
  for (int k = 0; k < 4; ++k)
  {
    const double u = k == 0 || k == 3 ? box.Lo[0] - margin : box.Hi[0] + margin;
    const double v = k < 2 ? box.Lo[1] - margin : box.Hi[1] + margin;
    corners[k] = { points[0]->X + u * along.X - v * along.Y,
      points[0]->Y + u * along.Y + v * along.X };
  }
}

void FindRectangle(const ScreenBox& box, double margin, Place corners[4])
{
  corners[0] = { box.Lo[0] - margin, box.Lo[1] - margin };
  corners[1] = { box.Hi[0] + margin, box.Lo[1] - margin };
  corners[2] = { box.Hi[0] + margin, box.Hi[1] + margin };
  corners[3] = { box.Lo[0] - margin, box.Hi[1] + margin };
}

} // namespace tetralux
