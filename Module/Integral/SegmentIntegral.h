// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SegmentIntegral_h
#define tetralux_SegmentIntegral_h

// The ray integral over a segment on which attenuation and colour are linear (Weiler et al. 2003,
// equations 3 and 4), in closed form.
//
// With w from 0 to 1 along the segment, D0 and D1 the attenuation at its ends times its length,
//
//   T(w) = D0 w + (D1 - D0) w^2 / 2          optical depth up to w,
//   D = T(1) = (D0 + D1) / 2,
//   I = integral of exp(-T(w)) dw,
//
// integration by parts turns the radiance, the integral of T'(w) c(w) exp(-T(w)) dw, into
//
//   c(0) (1 - I) + c(1) (I - exp(-D)):
//
// two weights that are never negative and add up to the opacity 1 - exp(-D). All that is left is I
// without cancellation, with b = (D1 - D0) / 2 (so |b| <= D):
//
// * thin, D <= ThinDepth. About the middle of the segment, x = w - 1/2 and q = 1/4 - x^2,
//   I = exp(-D/2) J with J the integral of cosh(D x) exp(b q); the weights are
//   (1 - exp(-D)) / 2 +- exp(-D/2) (cosh(D/2) - J), where 1 - exp(-D) = 2 exp(-D/2) sinh(D/2), and
//   the bracket is a power series without a constant term: nothing is subtracted from 1. Fitted
//   instead of cut off, 14 terms reach to D = ThinDepth: this form is the cheapest.
// * thick, b >= 0: I = sqrt(pi / 4b) (erfcx(D0 / 2 sqrt b) - exp(-D) erfcx(D1 / 2 sqrt b)).
// * thick, b < 0: I = (F(D0 / 2 sqrt -b) - exp(-D) F(D1 / 2 sqrt -b)) / sqrt -b, F Dawson's
//   function. In both the first term is at least 1 / (1 - exp(-D)) times the difference at most:
//   with D > ThinDepth less than half a bit is lost.
//
// The error of both weights is below SegmentWeightError (tested against quadrature from D = 1e-12
// to 1e12 and for every ratio of D0 and D1). RayIntegral.h has the same in double precision.

#include "Integral/SegmentWeightError.h"
#include "Simd/LaneFunctions.h"

namespace tetralux
{

/// Largest optical depth of a segment in single precision, opaque by far. A larger one is taken for
/// this, which keeps products of depths finite.
constexpr double LargestSingleDepth = 1e30;

namespace TETRALUX_ISA
{

/// Optical depth up to which the power series is used. Its error is 1.3e-7 of the opacity there,
/// and the thick forms, whose functions are less exact, are divided by no less than 0.78.
constexpr float ThinDepth = 1.5f;

/// exp(x^2) erfc(x) for x >= 0, relative error 3e-7: a polynomial in (x - 2) / (x + 2) over 1 + 2 x
/// (the form of Shepherd and Laframboise 1981, fitted anew for single precision).
TETRALUX_INLINE Float8 Erfcx(Float8 x)
{
  static constexpr float c[] = { 1.276978398805772f, -0.09276308076094691f, -0.16603152294877047f,
    0.1640358228778913f, -0.054208257431634856f, -0.007942665315677444f, 0.008678230866667462f,
    0.0010430746953785425f, -0.0013827317021457312f, -0.00018362550701861349f,
    0.00015546249239000234f };
  return Polynomial((x - Float8(2.f)) / (x + Float8(2.f)), c) / Fma(Float8(2.f), x, Float8(1.f));
}

/// Dawson's function, exp(-x^2) times the integral of exp(t^2) from 0 to x, for x >= 0; relative
/// error 8e-7: x / (1 + 2 x^2) times a rational function of (x^2 - 5) / (x^2 + 5), fitted by
/// iteratively reweighted least squares over [0, infinity).
TETRALUX_INLINE Float8 Dawson(Float8 x)
{
  static constexpr float p[] = { 0.35916317150740984f, -0.6028247674552745f, 1.3478181196586743f,
    -0.7240405603849414f, 0.7673592096749966f, 0.879081495729471f, -0.4064554588760132f,
    0.5181498198520664f, -0.05610198484941842f };
  static constexpr float q[] = { 0.2821932530093071f, -0.3214913798099469f, 0.7452631827404192f,
    -0.09567982340171519f, 0.6204841001518593f, 0.34414081061288326f, 0.33293893803968555f,
    0.14339652571288797f, 0.030903588301291585f };
  // Beyond this the function is 1 / 2x to the last bit, and x^2 could overflow.
  constexpr float Large = 1e9f;
  const Float8 bounded = Min(x, Float8(Large));
  const Float8 y = bounded * bounded;
  const Float8 t = (y - Float8(5.f)) / (y + Float8(5.f));
  const Float8 f =
    bounded * Polynomial(t, p) / (Polynomial(t, q) * Fma(Float8(2.f), y, Float8(1.f)));
  return Select(x < Float8(Large), f, Float8(0.5f) / x);
}

/// sinh(x) for 0 <= x <= ThinDepth / 2, error 3e-9 of x; above that any number.
TETRALUX_INLINE Float8 Sinh(Float8 x)
{
  static constexpr float c[] = { 1.f, 0.16666676f, 0.00833235f, 0.00020141f };
  return x * Polynomial(x * x, c);
}

/// How a segment's colours add up.
struct SegmentWeights
{
  Float8 Front;         ///< weight of the colour at the front end
  Float8 Back;          ///< weight of the colour at the back end
  Float8 Transmittance; ///< exp(-D)
};

/// 1 - exp(-D) and exp(-D) of a segment of constant attenuation, D at least 0: the opacity keeps
/// its relative accuracy where D is tiny.
TETRALUX_INLINE void IntegrateConstant(Float8 depth, Float8& opacity, Float8& transmittance)
{
  const Float8 half = Float8(0.5f) * depth;
  const Float8 root = ExpMinus(half);
  transmittance = root * root;
  opacity =
    Select(Float8(ThinDepth) < depth, Float8(1.f) - transmittance, Float8(2.f) * root * Sinh(half));
}

/// Optical depth up to which exp(-D/2) is a short one. A packet mostly has only such segments.
constexpr float ShortDepth = 2 * MostOfShortExp;
static_assert(ShortDepth <= ThinDepth, "what is short is thin");

/// Weights of a thin segment from its optical depths, both at least 0 and their mean at most
/// ThinDepth; above that any number. root: exp(-D/2).
TETRALUX_INLINE SegmentWeights IntegrateThinSegment(Float8 d0, Float8 d1, Float8 root)
{
  const Float8 depth = Float8(0.5f) * (d0 + d1);
  const Float8 b = Float8(0.5f) * (d1 - d0);
  const Float8 half = Float8(0.5f) * depth;
  // The bracket as a polynomial in b and D^2, by iteratively reweighted least squares over
  // |b| <= D <= ThinDepth, relative to the opacity. The terms of its power series are
  // -(integral of x^2m q^n) / ((2m)! n!) b^n D^2m, and for n = 0 those of cosh(D/2) more; the
  // first one, -b / 6, is kept as it is for the smallest depths.
  static constexpr float p0[] = { -1.f / 6, -0.0166666904f, -0.00119011029f, -6.6211389e-5f,
    -3.11817831e-6f };
  static constexpr float p1[] = { 0.0833334742f, -0.0041663916f, -0.000297384474f, -1.68304107e-5f,
    -9.80885306e-7f };
  static constexpr float p2[] = { 0.00208277594f, -3.77287079e-5f, -2.03036638e-6f };
  static constexpr float p3 = 1.89982749e-5f;
  const Float8 d2 = depth * depth;
  Float8 bracket = Fma(d2, Float8(p3), Polynomial(b, p2));
  bracket = Fma(d2, bracket, Polynomial(b, p1));
  bracket = Fma(d2, bracket, b * Polynomial(b, p0));
  const Float8 mean = Sinh(half);
  SegmentWeights w;
  w.Front = root * (mean + bracket);
  w.Back = root * (mean - bracket);
  w.Transmittance = root * root;
  return w;
}

TETRALUX_INLINE SegmentWeights IntegrateThinSegment(Float8 d0, Float8 d1)
{
  return IntegrateThinSegment(d0, d1, ExpMinus(Float8(0.25f) * (d0 + d1)));
}

/// The weight of a colour 4 w (1 - w) along a thin segment, as a share of its opacity: 2 / 3 in the
/// limit. By iteratively reweighted least squares over |b| <= D <= ThinDepth; error 2.4e-4, within
/// BulgeShareError.
TETRALUX_INLINE Float8 FindBulgeShare(Float8 d0, Float8 d1)
{
  const Float8 depth = Float8(0.5f) * (d0 + d1);
  const Float8 b = Float8(0.5f) * (d1 - d0);
  static constexpr float p0[] = { 0.66644458f, 0.06649459f, 0.00453237f };
  static constexpr float p1[] = { -0.01047766f, -0.00124714f };
  return Fma(depth * depth, Polynomial(b, p1), Polynomial(b, p0));
}

/// The integral I of a thick segment. transmittance: exp(-D).
TETRALUX_INLINE Float8 IntegrateThickSegment(
  Float8 d0, Float8 d1, Float8 transmittance, Mask8 thick)
{
  // Equal ends would divide 0 by 0. Any smaller slope leaves the same limit, 1 / D0 - ..., since
  // both functions are then at arguments where they are 1 / x to rounding.
  const Float8 depth = Float8(0.5f) * (d0 + d1);
  const Float8 b = Float8(0.5f) * (d1 - d0);
  const Float8 floor = Float8(1e-12f) * depth;
  const Float8 slopeRoot = Sqrt(Max(Abs(b), floor));
  const Float8 scale = Float8(0.5f) / slopeRoot;
  const Float8 x0 = d0 * scale;
  const Float8 x1 = d1 * scale;
  const Mask8 falling = b < Float8(0.f);
  Float8 integral = Float8(0.f);
  if (Any(thick & falling))
  {
    integral = (Dawson(x0) - transmittance * Dawson(x1)) / slopeRoot;
  }
  if (Any(AndNot(thick, falling)))
  {
    constexpr float HalfRootOfPi = 0.886226925f;
    integral = Select(falling, integral,
      Float8(HalfRootOfPi) * (Erfcx(x0) - transmittance * Erfcx(x1)) / slopeRoot);
  }
  return integral;
}

/// Sets the weights of the lanes that are thick.
TETRALUX_INLINE void SetThickWeights(Mask8 thick, Float8 integral, SegmentWeights& w)
{
  w.Front = Select(thick, Max(Float8(0.f), Float8(1.f) - integral), w.Front);
  w.Back = Select(thick, Max(Float8(0.f), integral - w.Transmittance), w.Back);
}

/// Weights of a segment from its optical depths, both at least 0 and at most LargestSingleDepth.
TETRALUX_INLINE SegmentWeights IntegrateSegment(Float8 d0, Float8 d1)
{
  const Float8 depth = Float8(0.5f) * (d0 + d1);
  if (!Any(Float8(ShortDepth) < depth))
  {
    return IntegrateThinSegment(d0, d1, ShortExpMinus(Float8(0.5f) * depth));
  }
  SegmentWeights w = IntegrateThinSegment(d0, d1);
  const Mask8 thick = Float8(ThinDepth) < depth;
  if (Any(thick))
  {
    SetThickWeights(thick, IntegrateThickSegment(d0, d1, w.Transmittance, thick), w);
  }
  return w;
}

/// The weight of a colour 4 w (1 - w) along a thick segment. integral: I.
///
/// By parts it is 4 I - 8 M with M the integral of w exp(-T(w)), and D0 I + (D1 - D0) M = 1 -
/// exp(-D). Where the slope is small, which that divides by, it is the weight at constant
/// attenuation and the first term in the slope; the second one is below 0.001 times its square.
TETRALUX_INLINE Float8 FindThickBulge(Float8 d0, Float8 d1, Float8 transmittance, Float8 integral)
{
  static constexpr float SmallSlope = 0.25f;
  const Float8 depth = Float8(0.5f) * (d0 + d1);
  const Float8 slope = d1 - d0;
  const Float8 opacity = Float8(1.f) - transmittance;
  const Mask8 small = Abs(slope) < Float8(SmallSlope);
  const Float8 steep = Fma(Float8(4.f), integral,
    Float8(-8.f) * (opacity - d0 * integral) / Select(small, Float8(1.f), slope));
  // Moments of exp(-D w).
  const Float8 inverse = Float8(1.f) / Max(depth, Float8(1.f));
  const Float8 m1 = (opacity * inverse - transmittance) * inverse;
  const Float8 m2 = (Float8(2.f) * m1 - transmittance) * inverse;
  const Float8 m3 = (Float8(3.f) * m2 - transmittance) * inverse;
  const Float8 even = Float8(4.f) * depth * (m1 - m2);
  const Float8 odd = Float8(2.f) * (m1 - Float8(3.f) * m2 + Float8(2.f) * m3);
  return Max(Float8(0.f), Select(small, Fma(slope, odd, even), steep));
}

/// Weights of a segment as IntegrateSegment has them, and bulge, of a colour 4 w (1 - w), whose
/// error is BulgeShareError of the opacity.
TETRALUX_INLINE SegmentWeights IntegrateCurvedSegment(Float8 d0, Float8 d1, Float8& bulge)
{
  const Float8 depth = Float8(0.5f) * (d0 + d1);
  const bool isShort = !Any(Float8(ShortDepth) < depth);
  SegmentWeights w = isShort ? IntegrateThinSegment(d0, d1, ShortExpMinus(Float8(0.5f) * depth))
                             : IntegrateThinSegment(d0, d1);
  bulge = FindBulgeShare(d0, d1) * (w.Front + w.Back);
  if (isShort)
  {
    return w;
  }
  const Mask8 thick = Float8(ThinDepth) < depth;
  if (Any(thick))
  {
    const Float8 integral = IntegrateThickSegment(d0, d1, w.Transmittance, thick);
    SetThickWeights(thick, integral, w);
    bulge = Select(thick, FindThickBulge(d0, d1, w.Transmittance, integral), bulge);
  }
  return w;
}

} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
