// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PolygonLanes_h
#define tetralux_PolygonLanes_h

// Isopolygons as the rays of a frame see them, LaneCount at a time, one a lane: a polygon that is
// as small as a pixel takes longer to place than to intersect.

#include "Isosurface/FramePolygon.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// What an edge function is rounded by, in squares of the largest coordinate: four products of two
/// rounded coordinates each, and three sums, with a factor of two to spare.
constexpr double EdgeRounding = 16. / (1ll << 53);

/// What a division rounds u and v of a corner by, as a share of the largest |u| and |v|, with a
/// factor of four to spare.
constexpr double BoxRounding = 4. / (1ll << 53);

/// Polygons whose box is smaller than this, as a share of the largest |u| and |v|, have an area and
/// edge functions below EdgeRounding: its square root, and less. Which way they turn is not known.
constexpr double TinyBox = 1. / (1 << 26);

TETRALUX_INLINE Double8 LeastOf(const Double8 (&v)[4])
{
  return Min(Min(v[0], v[1]), Min(v[2], v[3]));
}

TETRALUX_INLINE Double8 LargestOf(const Double8 (&v)[4])
{
  return Max(Max(v[0], v[1]), Max(v[2], v[3]));
}

/// Polygons of a leaf that are placed in a RayFrame together.
class PolygonLanes
{
public:
  /// bounds: of the rays. largest: |u| and |v| of them, at least 1.
  PolygonLanes(const RayFrame& frame, const RayBounds& bounds, double largest)
    : Frame(frame)
    , Bounds(bounds)
    , Largest(largest)
  {
  }

  /// Finds where polygons are: bounds and keys of corners. count: 1 ... LaneCount. least: the least
  /// key that may still change a ray. Returns those that a ray within the bounds may hit, one bit
  /// each.
  TETRALUX_INLINE unsigned PlaceCorners(const Isopolygon* polygons, int count, double least)
  {
    const RayFrame& frame = this->Frame;
    const double(&m)[3][4] = frame.Rows;
    const double* x[LaneCount];
    const double* y[LaneCount];
    const double* z[LaneCount];
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      // Lanes without a polygon get the first one.
      const Isopolygon& polygon = polygons[lane < count ? lane : 0];
      x[lane] = polygon.X;
      y[lane] = polygon.Y;
      z[lane] = polygon.Z;
    }
    Double8 px[4], py[4], pz[4], d[4];
    LoadRows(x, px[0], px[1], px[2], px[3]);
    LoadRows(y, py[0], py[1], py[2], py[3]);
    LoadRows(z, pz[0], pz[1], pz[2], pz[3]);
    for (int i = 0; i < 4; ++i)
    {
      const auto place = [&](const double(&row)[4])
      {
        return Double8(row[0]) * px[i] + Double8(row[1]) * py[i] + Double8(row[2]) * pz[i] +
          Double8(row[3]);
      };
      Store(this->X[i], place(m[0]));
      Store(this->Y[i], place(m[1]));
      d[i] = place(m[2]);
      Store(this->Depth[i], d[i]);
    }
    const Double8 none = 0.;
    const Double8 infinite = InfiniteKey;
    const Double8 nearest = LeastOf(d);
    const Double8 farthest = LargestOf(d);
    Mask8 may = MaskFromBits((1u << count) - 1);
    Mask8 allBefore = may;
    Double8 lowKey = none - farthest;
    Double8 highKey = none - nearest;
    if (!frame.Parallel)
    {
      may = may & (none < farthest);
      allBefore = none < nearest;
      lowKey = Double8(1.) / farthest;
      highKey = Select(allBefore, Double8(1.) / nearest, infinite);
    }
    may = may & (Double8(least) < highKey);
    Store(this->LowKey, lowKey);
    Store(this->HighKey, highKey);
    if (!Any(may))
    {
      return 0;
    }

    const Mask8 beside = this->FindBoxes(d, allBefore);
    return Bits(AndNot(may, beside));
  }

  /// Finds the edges and planes of the polygons whose corners are placed. Returns those that a ray
  /// may hit, one bit each.
  TETRALUX_INLINE unsigned PlaceEdges()
  {
    const RayFrame& frame = this->Frame;
    const Double8 none = 0.;
    Double8 x[4], y[4], d[4], w[4];
    for (int i = 0; i < 4; ++i)
    {
      x[i] = LoadDouble8(this->X[i]);
      y[i] = LoadDouble8(this->Y[i]);
      d[i] = LoadDouble8(this->Depth[i]);
      w[i] = frame.Parallel ? Double8(1.) : d[i];
    }
    // Edge i runs from corner i to the next one.
    Double8 size = none;
    Double8 normal[3] = { none, none, none };
    Double8 edges[3][4];
    for (int i = 0; i < 4; ++i)
    {
      const int n = (i + 1) % 4;
      edges[0][i] = y[i] * w[n] - y[n] * w[i];
      edges[1][i] = w[i] * x[n] - w[n] * x[i];
      edges[2][i] = x[i] * y[n] - x[n] * y[i];
      size = Max(size, Max(Max(Abs(x[i]), Abs(y[i])), Abs(w[i]) * Double8(this->Largest)));
      for (int a = 0; a < 3; ++a)
      {
        normal[a] = normal[a] + edges[a][i];
      }
    }
    Store(this->Tolerance, Double8(EdgeRounding) * size * size);
    // Six times the volume between the polygon and the origin; of parallel rays twice its area.
    Double8 volume = none;
    for (int i = 0; i < 4; ++i)
    {
      volume = volume + Double8(0.25) * (normal[0] * x[i] + normal[1] * y[i] + normal[2] * w[i]);
    }
    Mask8 flat = volume == none; // seen from its edge
    Double8 key[3];
    if (frame.Parallel)
    {
      // Relative to the first corner, where nothing cancels.
      Double8 across[3] = { none, none, none };
      for (int i = 1; i < 3; ++i)
      {
        const Double8 ux = x[i] - x[0], uy = y[i] - y[0], ud = d[i] - d[0];
        const Double8 vx = x[i + 1] - x[0], vy = y[i + 1] - y[0], vd = d[i + 1] - d[0];
        across[0] = across[0] + (uy * vd - ud * vy);
        across[1] = across[1] + (ud * vx - ux * vd);
        across[2] = across[2] + (ux * vy - uy * vx);
      }
      flat = flat | (across[2] == none);
      key[0] = across[0] / across[2];
      key[1] = across[1] / across[2];
      key[2] = none - d[0] -
        (key[0] * (x[0] + Double8(frame.Shift[0])) + key[1] * (y[0] + Double8(frame.Shift[1])));
    }
    else
    {
      for (int a = 0; a < 3; ++a)
      {
        key[a] = normal[a] / volume;
      }
    }
    // A tiny one that is seen from its edge closes the gap between its neighbours.
    Store(this->Key[0], Select(flat, none, key[0]));
    Store(this->Key[1], Select(flat, none, key[1]));
    Store(this->Key[2], Select(flat, LoadDouble8(this->LowKey), key[2]));
    const Mask8 turned = volume < none;
    for (int i = 0; i < 4; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        Store(this->Edges[a][i], Select(turned, none - edges[a][i], edges[a][i]));
      }
    }
    return ~Bits(AndNot(flat, MaskFromBits(this->Tiny)));
  }

  /// Bounds, as PlaceCorners finds them.
  ///@{
  Double8 GetLowU() const { return LoadDouble8(this->LowU); }
  Double8 GetHighU() const { return LoadDouble8(this->HighU); }
  Double8 GetLowV() const { return LoadDouble8(this->LowV); }
  Double8 GetHighV() const { return LoadDouble8(this->HighV); }
  double GetHighKey(int lane) const { return this->HighKey[lane]; }
  ///@}

  /// What PlaceCorners finds of a polygon.
  TETRALUX_INLINE void GetCorners(int lane, FramePolygon& result) const
  {
    result.LowKey = this->LowKey[lane];
    result.HighKey = this->HighKey[lane];
    result.LowU = this->LowU[lane];
    result.HighU = this->HighU[lane];
    result.LowV = this->LowV[lane];
    result.HighV = this->HighV[lane];
  }

  /// What PlaceEdges finds of it.
  TETRALUX_INLINE void GetEdges(int lane, FramePolygon& result) const
  {
    for (int i = 0; i < 4; ++i)
    {
      result.U[i] = this->Edges[0][i][lane];
      result.V[i] = this->Edges[1][i][lane];
      result.One[i] = this->Edges[2][i][lane];
    }
    for (int a = 0; a < 3; ++a)
    {
      result.Key[a] = this->Key[a][lane];
    }
    result.Tolerance = this->Tolerance[lane];
  }

private:
  /// Finds the boxes in u and v of polygons, without bounds of one that is not wholly before the
  /// origin of the rays. Returns those that no ray within the bounds can hit.
  TETRALUX_INLINE Mask8 FindBoxes(const Double8 (&depth)[4], Mask8 allBefore)
  {
    const RayFrame& frame = this->Frame;
    const RayBounds& bounds = this->Bounds;
    Double8 u[4], v[4];
    for (int i = 0; i < 4; ++i)
    {
      const Double8 x = LoadDouble8(this->X[i]);
      const Double8 y = LoadDouble8(this->Y[i]);
      u[i] = frame.Parallel ? x : x / depth[i];
      v[i] = frame.Parallel ? y : y / depth[i];
    }
    const Double8 infinite = InfiniteKey;
    const Double8 lowU = Select(allBefore, LeastOf(u), Double8(-InfiniteKey));
    const Double8 highU = Select(allBefore, LargestOf(u), infinite);
    const Double8 lowV = Select(allBefore, LeastOf(v), Double8(-InfiniteKey));
    const Double8 highV = Select(allBefore, LargestOf(v), infinite);
    const Double8 tiny = TinyBox * this->Largest;
    this->Tiny = Bits((highU - lowU < tiny) & (highV - lowV < tiny));
    const Double8 rounding = BoxRounding * this->Largest;
    const Double8 lowest[2] = { lowU - rounding, lowV - rounding };
    const Double8 highest[2] = { highU + rounding, highV + rounding };
    Store(this->LowU, lowest[0]);
    Store(this->HighU, highest[0]);
    Store(this->LowV, lowest[1]);
    Store(this->HighV, highest[1]);
    return (Double8(bounds.HighU) < lowest[0]) | (highest[0] < Double8(bounds.LowU)) |
      (Double8(bounds.HighV) < lowest[1]) | (highest[1] < Double8(bounds.LowV));
  }

  const RayFrame& Frame;
  const RayBounds& Bounds;
  double Largest;

  double X[4][LaneCount], Y[4][LaneCount], Depth[4][LaneCount];
  unsigned Tiny = 0; ///< by TinyBox, one bit each

  // As in FramePolygon.
  double Edges[3][4][LaneCount]; ///< factors of u, v and 1
  double Key[3][LaneCount];
  double LowKey[LaneCount], HighKey[LaneCount];
  double Tolerance[LaneCount];
  double LowU[LaneCount], HighU[LaneCount], LowV[LaneCount], HighV[LaneCount];
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
