// SPDX-License-Identifier: BSD-3-Clause
// Where along a segment the transfer function first attenuates: the share of the segment that is in
// front of that; 2 where it never does.

float FindFirst(float front, float back)
{
  SegmentWalk walk = StartWalk(front, back, 1.0);
  float passed = 1.0 - walk.Length;
  Piece piece;
  while (TakePiece(walk, piece))
  {
    if (piece.FrontDepth + piece.BackDepth > 0.0)
    {
      return passed;
    }
    passed = 1.0 - walk.Length;
  }
  return 2.0;
}
