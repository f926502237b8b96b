// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCastLightParts_h
#define tetralux_RayCastLightParts_h

// The light along the rays' ways through a cell, cut into parts on which it is nearly a parabola
// (what Kraus et al. 2004, section 6, leave to be done).
//
// Along a ray the gradient is linear, and so is the vector to a positional light. What lights make
// of a colour depends on the directions of both alone, besides the distance. So a part ends
//
// * where the gradient turns away from the viewer: the normal changes sides there;
// * where it turns away from a light, and where the ray comes into the cone of a spot or out of it:
//   light ends there, highlights at once;
// * where the ray is nearest to a positional light;
// * where a direction has turned by LightSteps::Turn, or the distance to a light that distance
//   weakens has changed by LightSteps::Approach of itself; by more where the part adds little.
//
// All are roots of linear or quadratic functions: nothing is searched for. On such a part light is
// smooth, and a parabola through it at the three Chebyshev points is off by at most 1/192 of its
// third derivative.

#include "Optics/LightSteps.h"
#include "RayCast/RayCastLight.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Shortest part, as a share of the way. What a nearer cut would change is less than single
/// precision keeps of the cell's light.
constexpr float ShortestLightPart = 1.f / (1 << 20);

class LightParts
{
public:
  LightParts(const WorldRays& rays, Double8 start)
    : Lights(rays, start)
  {
  }

  /// The next cell: from distance near on, and the gradients there and behind it, in coordinates of
  /// the mesh.
  TETRALUX_INLINE void Enter(
    Double8 near, Double8 length, const LaneVector& gradient, const LaneVector& farGradient)
  {
    this->Near = near;
    this->Length = length;
    this->NearGradient = gradient;
    this->FarGradient = farGradient;
    this->Entered = false;
    this->End = -1.f;
  }

  /// The share of the cell where each ray's part ends; below 0 before the first part, 2 where it
  /// ends with the cell.
  TETRALUX_INLINE Float8 GetEnd() const { return this->End; }

  /// The largest weight in the picture for which the part is right enough.
  TETRALUX_INLINE Float8 GetWeight() const { return this->Weight; }

  /// Goes on to the parts of some rays that begin at shares of the cell, for a weight in the
  /// picture.
  /// heavyEnd: no part goes beyond that which weighs more than SmallLightWeight. So the weight is
  /// spread over the part, and most of what the parabola is off by cancels.
  TETRALUX_NOINLINE void Begin(
    const KernelLighting& lighting, Mask8 lanes, Float8 begin, Float8 weight, Float8 heavyEnd)
  {
    if (!this->Entered)
    {
      this->EnterWorld(lighting);
    }
    const Float8 small = static_cast<float>(SmallLightWeight);
    const Float8 bounded = Max(weight, small * Float8(LeastWeight));
    const Float8 longer =
      Float8(1.f) / Power(bounded * (Float8(1.f) / small), Float8(1.f / 3)); // 1 for larger weights
    const Float8 one = 1.f;
    const Float8 brighter = this->FindBrightness(lighting, begin);
    const Float8 steps = longer * Power(one / brighter, Float8(1.f / 3));
    const Float8 farthest = Select(small < weight, Min(heavyEnd, one), one);
    const Float8 end = this->FindEnd(lighting, begin, farthest, steps);
    const Float8 length = end - begin;
    const auto find = [&](float share)
    {
      const Float8 at = Fma(length, Float8(share), begin);
      return this->Lights.Find(lighting, Fma(this->Change, at, this->Gradient),
        Fma(ToDouble(at), this->Length, this->Near));
    };
    const LaneFactors first = find(static_cast<float>(LightSamples[0]));
    const LaneFactors middle = find(static_cast<float>(LightSamples[1]));
    const LaneFactors last = find(static_cast<float>(LightSamples[2]));
    // Newton's form, from the middle.
    constexpr auto Reach = static_cast<float>(LightSamples[2] - LightSamples[1]);
    const auto fit = [&](LaneVector LaneFactors::*f)
    {
      const LaneVector slope = (last.*f - first.*f) * Float8(0.5f / Reach);
      const LaneVector bend =
        ((first.*f - middle.*f) + (last.*f - middle.*f)) * Float8(0.5f / (Reach * Reach));
      this->Middle.*f = Select(lanes, middle.*f, this->Middle.*f);
      this->Slope.*f = Select(lanes, slope, this->Slope.*f);
      this->Bend.*f = Select(lanes, bend, this->Bend.*f);
    };
    fit(&LaneFactors::Scale);
    fit(&LaneFactors::Add);
    this->Origin = Select(lanes, begin, this->Origin);
    this->Weight = Select(lanes, Select(small <= weight, one, bounded), this->Weight);
    this->InverseLength = Select(lanes, one / length, this->InverseLength);
    this->End = Select(lanes, Select(end < one, end, Float8(2.f)), this->End);
  }

  /// The factors at a share of the cell in the current part.
  TETRALUX_INLINE LaneFactors At(Float8 share) const
  {
    const Float8 x = Fma(share - this->Origin, this->InverseLength, Float8(-0.5f));
    const auto find = [&](LaneVector LaneFactors::*f)
    { return Fma(Fma(this->Bend.*f, x, this->Slope.*f), x, this->Middle.*f); };
    return { find(&LaneFactors::Scale), find(&LaneFactors::Add) };
  }

private:
  /// Of SmallLightWeight: parts that add less are no longer.
  static constexpr float LeastWeight = 1.f / 512;

  /// How much brighter near lights shine at a share than LightSteps knows; at least 1.
  TETRALUX_INLINE Float8 FindBrightness(const KernelLighting& lighting, Float8 share) const
  {
    Float8 brightness = 1.f;
    for (int i = 0; i < lighting.NumberOfLights; ++i)
    {
      const KernelLight& light = lighting.Lights[i];
      if (light.Fades)
      {
        const LaneVector way = this->Lights.GetWayToLight(
          lighting, light, Fma(ToDouble(share), this->Length, this->Near));
        brightness = Max(LaneLights::GetShare(light, Sqrt(Dot(way, way))), brightness);
      }
    }
    return brightness;
  }

  void EnterWorld(const KernelLighting& lighting)
  {
    this->Entered = true;
    const Float8 zero = 0.f;
    const Float8 near = LaneLights::GetScale(this->NearGradient);
    const Float8 far = LaneLights::GetScale(this->FarGradient);
    // Both by the same scale; 0 is that of no gradient.
    const Float8 scale = Select((zero < near) & (zero < far), Min(near, far), Max(near, far));
    this->Gradient = LaneLights::ToWorld(lighting, this->NearGradient * scale);
    this->Change = LaneLights::ToWorld(lighting, this->FarGradient * scale) - this->Gradient;
  }

  /// The nearest of the ends that a part may have.
  struct PartEnd
  {
    Float8 Begin;
    Float8 End;

    /// A cut at a share; one before the begin, or as good as there, was made before.
    TETRALUX_INLINE void Cut(Float8 share)
    {
      const Float8 shortest = ShortestLightPart;
      this->End = Select((this->Begin + shortest < share) & (share < this->End), share, this->End);
    }

    /// No longer than a step.
    TETRALUX_INLINE void Limit(Float8 step)
    {
      const Float8 share = this->Begin + Max(step, Float8(ShortestLightPart));
      this->End = Select(share < this->End, share, this->End);
    }

    /// Where c + b t + a t^2 changes its sign. Of both roots the one without cancellation is found
    /// by the formula, the other one by their product.
    TETRALUX_INLINE void CutAtRoots(Float8 c, Float8 b, Float8 a)
    {
      const Float8 zero = 0.f;
      const Float8 root = Sqrt(Fma(b, b, Float8(-4.f) * a * c)); // no number: there are none
      const Float8 q = Float8(-0.5f) * (b + Select(b < zero, zero - root, root));
      this->Cut(c / q);
      this->Cut(q / a);
    }
  };

  /// How far a vector that is linear in the share may go on until its direction has turned.
  ///
  /// Along its line, at t from its shortest point in units of its length there, its direction is
  /// arctan(t): far from there, a third derivative by t is up to (1 + 1.6 t)^2 times the one by the
  /// angle, in units of how fast it turns.
  static TETRALUX_INLINE Float8 FindTurn(
    const LaneVector& vector, const LaneVector& change, Float8 tangent)
  {
    const Float8 length = Sqrt(Dot(vector, vector));
    const Float8 along = Dot(vector, change) / length;
    const LaneVector across = change - vector * (along / length);
    const Float8 turning = Sqrt(Dot(across, across));
    const Float8 curved = Float8(1.f) / Fma(Float8(1.6f), Abs(along) / turning, Float8(1.f));
    const Float8 bounded = tangent * Power(curved, Float8(2.f / 3));
    const Float8 rate = turning - bounded * along;
    const Float8 never = 2.f;
    return Select(Float8(0.f) < rate, bounded * length / rate, never);
  }

  /// The tangent of an angle of 0..1, at most 2 % less than right.
  static TETRALUX_INLINE Float8 FindTangent(Float8 angle)
  {
    static constexpr float c[] = { 1.f, 1.f / 3, 2.f / 15, 17.f / 315 };
    return angle * Polynomial(angle * angle, c);
  }

  /// farthest: a part ends there. longer: than LightSteps by a factor.
  TETRALUX_INLINE Float8 FindEnd(
    const KernelLighting& lighting, Float8 begin, Float8 farthest, Float8 longer) const
  {
    const Float8 one = 1.f;
    const Float8 tangent = FindTangent(Min(one, longer * Float8(lighting.Turn)));
    const LaneVector& view = this->Lights.GetView();
    const LaneVector& g = this->Gradient;
    const LaneVector& dg = this->Change;
    PartEnd part{ begin, one };
    part.Limit(farthest - begin);
    part.Cut(Float8(-1.f) * Dot(g, view) / Dot(dg, view));
    part.Limit(FindTurn(Fma(dg, begin, g), dg, tangent));
    for (int i = 0; i < lighting.NumberOfLights; ++i)
    {
      const KernelLight& light = lighting.Lights[i];
      if (!light.Positional)
      {
        const LaneVector toLight = Broadcast(light.Position);
        part.Cut(Float8(-1.f) * Dot(g, toLight) / Dot(dg, toLight));
        continue;
      }
      const LaneVector toLight = this->Lights.GetWayToLight(lighting, light, this->Near);
      const LaneVector change = view * ToFloat(this->Length * Double8(-1 / lighting.Unit));
      const LaneVector fromBegin = Fma(change, begin, toLight);
      const Float8 approach = Dot(toLight, change);
      const Float8 way2 = Dot(change, change);
      part.CutAtRoots(Dot(g, toLight), Dot(g, change) + Dot(dg, toLight), Dot(dg, change));
      part.Cut(Float8(-1.f) * approach / way2);
      part.Limit(FindTurn(fromBegin, change, tangent));
      if (light.Fades)
      {
        part.Limit(
          Min(one, longer * Float8(lighting.Approach)) * Sqrt(Dot(fromBegin, fromBegin) / way2));
      }
      if (light.IsSpot)
      {
        // Where the angle to the axis is that of the cone, or opposite to it: across the axis and
        // along it apart, so that nothing cancels in narrow cones.
        const LaneVector axis = Broadcast(light.Axis);
        const LaneVector across = this->Lights.GetAcrossAxis(lighting, light, this->Near);
        const LaneVector acrossChange =
          this->Lights.GetAcrossAxis(lighting, light, this->Near + this->Length) - across;
        const Float8 axial = Dot(toLight, axis);
        const Float8 axialChange = Dot(change, axis);
        const Float8 sine2 = light.ConeSine * light.ConeSine;
        const Float8 cosine2 = one - sine2;
        part.CutAtRoots(cosine2 * Dot(across, across) - sine2 * axial * axial,
          Float8(2.f) * (cosine2 * Dot(across, acrossChange) - sine2 * axial * axialChange),
          cosine2 * Dot(acrossChange, acrossChange) - sine2 * axialChange * axialChange);
      }
    }
    return Select(part.End < one - Float8(ShortestLightPart), part.End, one);
  }

  LaneLights Lights;

  // The cell.
  Double8 Near = 0., Length = 0.;
  LaneVector NearGradient, FarGradient;
  bool Entered = false;        ///< Gradient and Change are of the cell
  LaneVector Gradient, Change; ///< at the near end, in the world, and to the far end

  // The parts, x = (share - Origin) InverseLength - 1/2 from one end to the other.
  Float8 Origin = 0.f, End = -1.f, InverseLength = 0.f, Weight = 0.f;
  LaneFactors Middle, Slope, Bend;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
