// SPDX-License-Identifier: BSD-3-Clause
// Cuts a segment, along which the scalar runs linearly, at the nodes of the transfer function, and
// walks over the pieces, front to back.

// Three texels for each interval, as IntervalTable has them: Lo, Hi, Reference, Attenuation;
// AttenuationSlope, Color; ColorSlope. The first one begins and the last one ends beyond all scalars.
uniform samplerBuffer transferIntervals;
uniform int numberOfTransferIntervals;

// A part of a segment on which attenuation and colour are linear.
struct Piece
{
  float FrontDepth, BackDepth; // attenuation at its ends times its length, 0..LargestDepth
  vec3 FrontColor, BackColor;
};

// What of a segment is left.
struct SegmentWalk
{
  bool More;
  int Interval;
  float FrontScalar, BackScalar;
  float Length;
};

// Scalars nearer to 0 count as 0, nodes too: differences of all others are normal numbers, which no
// graphics card flushes to 0.
const float SmallestScalar = 1e-30;

// The interval that a scalar is in; of the two at a node, the lower one where the scalar falls.
int FindTransferInterval(float scalar, bool falling)
{
  int first = 0;
  for (int count = numberOfTransferIntervals; count > 1;)
  {
    int halfCount = count / 2;
    float lo = texelFetch(transferIntervals, 3 * (first + halfCount)).x;
    first += lo < scalar || (lo == scalar && !falling) ? halfCount : 0;
    count -= halfCount;
  }
  return first;
}

SegmentWalk StartWalk(float front, float back, float len)
{
  // A scalar that is not a number spoils the whole segment: it contributes nothing.
  bool more = !isnan(front) && !isnan(back) && len > 0.0;
  front = abs(front) < SmallestScalar ? 0.0 : front;
  back = abs(back) < SmallestScalar ? 0.0 : back;
  return SegmentWalk(more, FindTransferInterval(front, back < front), front, back, len);
}

// The next piece; false where there is none.
bool TakePiece(inout SegmentWalk walk, out Piece piece)
{
  if (!walk.More)
  {
    return false;
  }
  vec4 bounds = texelFetch(transferIntervals, 3 * walk.Interval);
  vec4 slopeColor = texelFetch(transferIntervals, 3 * walk.Interval + 1);
  vec3 colorSlope = texelFetch(transferIntervals, 3 * walk.Interval + 2).xyz;
  float lo = bounds.x;
  float hi = bounds.y;

  // By the scalar that is left, not by that from the start of the segment: however narrow an interval
  // is, its length keeps its relative accuracy.
  bool last = lo <= walk.BackScalar && walk.BackScalar <= hi;
  float end = last ? walk.BackScalar : clamp(walk.BackScalar, lo, hi);
  float inverse = 1.0 / (last ? 1.0 : walk.BackScalar - walk.FrontScalar);
  float len = last ? walk.Length : walk.Length * ((end - walk.FrontScalar) * inverse);

  float x0 = walk.FrontScalar - bounds.z;
  float x1 = end - bounds.z;
  // Rounding may leave an attenuation just below zero where the function comes down to it.
  piece.FrontDepth = clamp((bounds.w + slopeColor.x * x0) * len, 0.0, LargestDepth);
  piece.BackDepth = clamp((bounds.w + slopeColor.x * x1) * len, 0.0, LargestDepth);
  piece.FrontColor = slopeColor.yzw + colorSlope * x0;
  piece.BackColor = slopeColor.yzw + colorSlope * x1;

  walk.More = !last;
  walk.Length *= (walk.BackScalar - end) * inverse;
  walk.FrontScalar = end;
  walk.Interval += lo <= walk.BackScalar ? 1 : -1;
  return true;
}
