// SPDX-License-Identifier: BSD-3-Clause
// A piece of a segment: the part of it that is in one interval of the transfer function.

// A part of a segment on which attenuation is linear, and colour linear or a parabola; of no length
// at times.
struct Piece
{
  float FrontDepth, BackDepth; // attenuation at its ends times its length, 0..LargestDepth
  vec3 FrontColor, BackColor;
#ifdef CURVED_COLORS
  vec3 Bulge; // in the middle, from the line between both ends
#endif
};

// The colour of a piece at a share of it.
vec3 GetPieceColor(Piece piece, float share)
{
  vec3 color = mix(piece.FrontColor, piece.BackColor, share);
#ifdef CURVED_COLORS
  color += 4.0 * share * (1.0 - share) * piece.Bulge;
#endif
  return color;
}
