// SPDX-License-Identifier: BSD-3-Clause
// Emission and absorption in closed form: premultiplied colour and opacity of a segment.

vec4 IntegrateSegment(float front, float back, float len)
{
  // The opacity is what adds up, not the transmittance what is multiplied: pieces too thin for
  // 1 - opacity to differ from 1 still count.
  vec4 gathered = vec4(0.0);
  SegmentWalk walk = StartWalk(front, back, len);
  do
  {
    Piece piece = TakePiece(walk);
    vec3 weights = WeighSegment(piece.FrontDepth, piece.BackDepth);
    vec3 color = weights.x * piece.FrontColor + weights.y * piece.BackColor;
#ifdef CURVED_COLORS
    color += weights.z * piece.Bulge;
#endif
    gathered += (1.0 - gathered.a) * vec4(color, weights.x + weights.y);
  } while (walk.More);
  return gathered;
}
