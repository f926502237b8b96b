// SPDX-License-Identifier: BSD-3-Clause
// Cuts a segment, along which the scalar runs linearly, where intervals of the transfer function
// end, and walks over the pieces, front to back. Needs PiecesDec.glsl and
// ScalarBucketsDec.glsl. To be used as
//
//   SegmentWalk walk = StartWalk(front, back, len);
//   do
//   {
//     Piece piece = TakePiece(walk);
//     ...
//   } while (walk.More);
//
// with the test at the end: a software renderer runs a loop's body once more where it is at the
// begin.

// Four texels for each interval, as IntervalTable has them: Lo, Hi, Reference, Attenuation;
// AttenuationSlope, Color; ColorSlope; ColorBend. The first one begins and the last one ends beyond
// all scalars. Without CURVED_COLORS there are no bends.
uniform samplerBuffer transferIntervals;
uniform isamplerBuffer transferBuckets;

// Scalars nearer to 0 count as 0, nodes too: differences of all others are normal numbers, which no
// graphics card flushes to 0.
const float SmallestScalar = 1e-30;

// Larger ones count as this, as in the mesh: all are inside of an interval.
const float LargestScalar = 1e30;

// What of a segment is left.
struct SegmentWalk
{
  bool More;
  int Interval;
  float FrontScalar, BackScalar;
  float Length;
};

float BoundScalar(float scalar)
{
  return abs(scalar) < SmallestScalar ? 0.0 : clamp(scalar, -LargestScalar, LargestScalar);
}

SegmentWalk StartWalk(float front, float back, float len)
{
  // A scalar that is not a number spoils the whole segment: it contributes nothing.
  bool valid = !isnan(front) && !isnan(back) && len > 0.0;
  front = valid ? BoundScalar(front) : 0.0;
  back = valid ? BoundScalar(back) : 0.0;
  return SegmentWalk(
    true, GetFirstInterval(transferBuckets, front), front, back, valid ? len : 0.0);
}

// The next piece.
Piece TakePiece(inout SegmentWalk walk)
{
  vec4 bounds = texelFetch(transferIntervals, 4 * walk.Interval);
  vec4 slopeColor = texelFetch(transferIntervals, 4 * walk.Interval + 1);
  vec3 colorSlope = texelFetch(transferIntervals, 4 * walk.Interval + 2).xyz;
  float lo = bounds.x;
  float hi = bounds.y;
  float front = walk.FrontScalar;
  float back = walk.BackScalar;

  // The first interval may be too low: nothing of the segment is in it. A constant scalar at a node
  // belongs to the interval above it.
  bool tooLow = hi < front || (hi == front && front <= back);
  bool last = !tooLow && lo <= back && back <= hi;
  float end = tooLow ? front : clamp(back, lo, hi);
  // By the scalar that is left, not by that from the start of the segment: however narrow an
  // interval is, its length keeps its relative accuracy.
  float inverse = 1.0 / (front == back ? 1.0 : back - front);
  float len = last ? walk.Length : walk.Length * ((end - front) * inverse);

  float x0 = min(front, hi) - bounds.z;
  float x1 = min(end, hi) - bounds.z;
  Piece piece;
  // Rounding may leave an attenuation just below zero where the function comes down to it.
  piece.FrontDepth = clamp((bounds.w + slopeColor.x * x0) * len, 0.0, LargestDepth);
  piece.BackDepth = clamp((bounds.w + slopeColor.x * x1) * len, 0.0, LargestDepth);
  piece.FrontColor = slopeColor.yzw + colorSlope * x0;
  piece.BackColor = slopeColor.yzw + colorSlope * x1;
#ifdef CURVED_COLORS
  vec3 bend = texelFetch(transferIntervals, 4 * walk.Interval + 3).xyz;
  // In this order nothing overflows where there is no bend, however far from the nodes.
  piece.FrontColor += (bend * x0) * x0;
  piece.BackColor += (bend * x1) * x1;
  piece.Bulge = (bend * (x1 - x0)) * (-0.25 * (x1 - x0));
#endif

  walk.Length = tooLow ? walk.Length : walk.Length * ((back - end) * inverse);
  walk.FrontScalar = end;
  walk.Interval += tooLow || lo <= back ? 1 : -1;
  // There is always an end: also where a compiler holds that nothing can be no number.
  walk.More = !last && walk.Interval >= 0;
  return piece;
}
