// SPDX-License-Identifier: BSD-3-Clause
// The ray integral over a segment on which attenuation and colour are linear, in closed form:
// SegmentIntegral.h, whose derivation and whose thin form this has.
//
// An optical depth beyond the thin form is cut into parts that are ThinDepth thick, instead of
// taking Dawson's function and erfcx: sums and products alone, besides the places of the cuts,
// whose rounding does not matter. So the error is the same on every graphics card, and a software
// renderer, which runs both sides of every branch, does not pay for functions that few segments
// need.

// Optical depth over length at most; squares of it must be finite. The colour is all from the front
// end long before.
const float LargestDepth = 1e18;

// As in SegmentIntegral.h.
const float ThinDepth = 1.5;

// Parts of a thick segment: behind them exp(-16.5), less than a rounding of the opacity, is left.
const int LargestNumberOfParts = 12;

// exp(-x) for 0 <= x <= ThinDepth / 2, relative error 2e-7: fitted by iteratively reweighted least
// squares.
float ExpMinusSmall(float x)
{
  return 1.0 +
    x * (-0.99999973 +
          x * (0.49999347 +
                x * (-0.16661251 + x * (0.041456332 + x * (-0.0079112696 + x * 0.00095526196)))));
}

// sinh(x) for 0 <= x <= ThinDepth / 2, error 3e-9 of x.
float SinhSmall(float x)
{
  float y = x * x;
  return x * (1.0 + y * (0.16666676 + y * (0.00833235 + y * 0.00020141)));
}

// 1 - exp(-depth) for depth >= 0, with its relative accuracy where depth is tiny.
float GetOpacity(float depth)
{
  float halfDepth = 0.5 * min(depth, ThinDepth);
  float thin = 2.0 * ExpMinusSmall(halfDepth) * SinhSmall(halfDepth);
  return depth <= ThinDepth ? thin : 1.0 - exp2(-1.44269504 * depth); // 1 / ln 2
}

// What the colours at the front and the back end of a segment add up with; their sum is the
// opacity. d0, d1: attenuation at its ends times its length, 0..LargestDepth, for (d0 + d1) / 2 <=
// ThinDepth.
vec2 WeighThinSegment(float d0, float d1)
{
  float depth = 0.5 * (d0 + d1);
  float b = 0.5 * (d1 - d0);
  float y = depth * depth;
  float p0 = b * (-0.16666667 +
    b * (-0.0166666904 + b * (-0.00119011029 + b * (-6.6211389e-5 + b * -3.11817831e-6))));
  float p1 = 0.0833334742 +
    b * (-0.0041663916 + b * (-0.000297384474 + b * (-1.68304107e-5 + b * -9.80885306e-7)));
  float p2 = 0.00208277594 + b * (-3.77287079e-5 + b * -2.03036638e-6);
  float bracket = p0 + y * (p1 + y * (p2 + y * 1.89982749e-5));
  float halfDepth = 0.5 * depth;
  float mean = SinhSmall(halfDepth);
  return ExpMinusSmall(halfDepth) * vec2(mean + bracket, mean - bracket);
}

// The weight of a colour 4 w (1 - w) along a thin segment, as a share of its opacity: as in
// SegmentIntegral.h.
float FindBulgeShare(float d0, float d1)
{
  float depth = 0.5 * (d0 + d1);
  float b = 0.5 * (d1 - d0);
  return 0.66644458 + b * (0.06649459 + b * 0.00453237) +
    depth * depth * (-0.01047766 - 0.00124714 * b);
}

// The same for any depth: weights of the front, of the back, and with CURVED_COLORS of a colour
// 4 w (1 - w).
vec3 WeighSegment(float d0, float d1)
{
#ifdef ONLY_THIN_SEGMENTS
  vec2 thin = WeighThinSegment(d0, d1);
  return vec3(thin, FindBulgeShare(d0, d1) * (thin.x + thin.y));
#else
  vec3 weights = vec3(0.0);
  float slope = d1 - d0;
  float begin = 0.0; // of the part, as a share of the segment
  float front = d0;  // attenuation there
  for (int part = 0; part < LargestNumberOfParts; ++part)
  {
    float rest = 1.0 - begin;
    bool last = 0.5 * (front + d1) * rest <= ThinDepth;
    // Where the depth from the beginning of the part is ThinDepth: front h + slope h^2 / 2.
    float root = sqrt(max(0.0, front * front + 2.0 * ThinDepth * slope));
    float share = last ? rest : 2.0 * ThinDepth / (front + root);
    float end = last ? 1.0 : begin + share;
    float back = last ? d1 : d0 + slope * end;
    vec2 part01 = WeighThinSegment(front * share, back * share);
    float transmittance = 1.0 - (weights.x + weights.y);
    weights.xy += transmittance *
      vec2(part01.x * (1.0 - begin) + part01.y * (1.0 - end), part01.x * begin + part01.y * end);
#ifdef CURVED_COLORS
    // In the part 4 w (1 - w) is linear between its ends, plus a bulge of the same shape.
    float bulge = FindBulgeShare(front * share, back * share) * (part01.x + part01.y);
    weights.z += transmittance *
      (4.0 * (part01.x * begin * (1.0 - begin) + part01.y * end * (1.0 - end)) +
        bulge * share * share);
#endif
    if (last)
    {
      break;
    }
    begin = end;
    front = back;
  }
  return weights;
#endif
}
