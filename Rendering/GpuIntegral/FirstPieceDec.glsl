// SPDX-License-Identifier: BSD-3-Clause
// Where along a segment the transfer function first attenuates: the share of the segment that is in
// front of that; 2 where it never does.

float FindFirst(float front, float back)
{
  SegmentWalk walk = StartWalk(front, back, 1.0);
  float first = 2.0;
  do
  {
    float passed = 1.0 - walk.Length;
    Piece piece = TakePiece(walk);
    first = first > 1.0 && piece.FrontDepth + piece.BackDepth > 0.0 ? passed : first;
  } while (walk.More && first > 1.0);
  return first;
}
