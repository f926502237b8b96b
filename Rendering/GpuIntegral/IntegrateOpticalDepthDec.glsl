// SPDX-License-Identifier: BSD-3-Clause
// Where all that attenuates has one colour, and absorption alone: the optical depth tells all.

uniform vec3 constantColor; // 0 for absorption alone

vec4 IntegrateSegment(float front, float back, float len)
{
  float depth = 0.0;
  SegmentWalk walk = StartWalk(front, back, len);
  do
  {
    Piece piece = TakePiece(walk);
    depth += 0.5 * (piece.FrontDepth + piece.BackDepth);
  } while (walk.More);
  return GetOpacity(depth) * vec4(constantColor, 1.0);
}
