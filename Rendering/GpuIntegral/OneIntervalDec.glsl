// SPDX-License-Identifier: BSD-3-Clause
// The same functions as TransferIntervalsDec.glsl has, for cells that are drawn once for each
// interval that they have part in, see CellDivision.h: the interval's numbers are those of the
// primitive, so that nothing is looked up, and there is one piece. Needs PiecesDec.glsl.
//
// Defines:
//   SLICES   of the segment only a slice counts, between two shares of its length

// IntervalTable::Interval, its open ends beyond all scalars: Lo, Hi, Reference, Attenuation;
// AttenuationSlope, Color; ColorSlope; ColorBend. The vertex shader hands them down.

struct SegmentWalk
{
  bool More;
  float FrontScalar, BackScalar;
  float Length;
};

SegmentWalk StartWalk(float front, float back, float len)
{
#ifdef SLICES
  float change = back - front;
  return SegmentWalk(
    true, front + slice.x * change, front + slice.y * change, (slice.y - slice.x) * len);
#else
  return SegmentWalk(true, front, back, len);
#endif
}

// The piece.
Piece TakePiece(inout SegmentWalk walk)
{
  float lo = intervalBounds.x;
  float hi = intervalBounds.y;
  float front = walk.FrontScalar;
  float back = walk.BackScalar;
  float begin = clamp(front, lo, hi);
  float end = clamp(back, lo, hi);
  float change = back - front;
  // A constant scalar at a node belongs to the interval above it.
  float share = change != 0.0 ? (end - begin) / change : (lo <= front && front < hi ? 1.0 : 0.0);
  float len = walk.Length * share;
  float x0 = begin - intervalBounds.z;
  float x1 = end - intervalBounds.z;
  Piece piece;
  // Rounding may leave an attenuation just below zero where the function comes down to it.
  piece.FrontDepth = clamp((intervalBounds.w + intervalSlopeColor.x * x0) * len, 0.0, LargestDepth);
  piece.BackDepth = clamp((intervalBounds.w + intervalSlopeColor.x * x1) * len, 0.0, LargestDepth);
  piece.FrontColor = intervalSlopeColor.yzw + intervalColorSlope * x0;
  piece.BackColor = intervalSlopeColor.yzw + intervalColorSlope * x1;
#ifdef CURVED_COLORS
  piece.FrontColor += (intervalColorBend * x0) * x0;
  piece.BackColor += (intervalColorBend * x1) * x1;
  piece.Bulge = (intervalColorBend * (x1 - x0)) * (-0.25 * (x1 - x0));
#endif
  walk.More = false;
  return piece;
}
