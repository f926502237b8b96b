// SPDX-License-Identifier: BSD-3-Clause
// Emission alone: the integral of attenuation times colour, a polynomial on each piece. Opacity 0.

vec4 IntegrateSegment(float front, float back, float len)
{
  vec3 gathered = vec3(0.0);
  SegmentWalk walk = StartWalk(front, back, len);
  do
  {
    Piece piece = TakePiece(walk);
    // The integrals of d0 + (d1 - d0) w times 1 - w, w and 4 w (1 - w), over w from 0 to 1.
    float d0 = piece.FrontDepth / 6.0;
    float d1 = piece.BackDepth / 6.0;
    gathered += (2.0 * d0 + d1) * piece.FrontColor + (d0 + 2.0 * d1) * piece.BackColor;
#ifdef CURVED_COLORS
    gathered += 2.0 * (d0 + d1) * piece.Bulge;
#endif
  } while (walk.More);
  return vec4(gathered, 0.0);
}
