// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LaneLights_h
#define tetralux_LaneLights_h

// Lights that shine on what the rays of a packet meet: ambient and diffuse light times the colour,
// and Blinn's specular light, as in VTK's mappers of volumes. The normal is the gradient of the
// scalar, turned to the viewer; what has no gradient faces the viewer.

#include "Lighting/KernelLighting.h"
#include "Lighting/WorldRays.h"
#include "Simd/LaneFunctions.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// A vector, or a colour, in each lane.
struct LaneVector
{
  Float8 C[3];

  TETRALUX_INLINE LaneVector operator+(const LaneVector& b) const
  {
    return { { this->C[0] + b.C[0], this->C[1] + b.C[1], this->C[2] + b.C[2] } };
  }
  TETRALUX_INLINE LaneVector operator-(const LaneVector& b) const
  {
    return { { this->C[0] - b.C[0], this->C[1] - b.C[1], this->C[2] - b.C[2] } };
  }
  TETRALUX_INLINE LaneVector operator*(Float8 s) const
  {
    return { { this->C[0] * s, this->C[1] * s, this->C[2] * s } };
  }
};

TETRALUX_INLINE Float8 Dot(const LaneVector& a, const LaneVector& b)
{
  return Fma(a.C[0], b.C[0], Fma(a.C[1], b.C[1], a.C[2] * b.C[2]));
}

TETRALUX_INLINE LaneVector Select(Mask8 m, const LaneVector& a, const LaneVector& b)
{
  return { { Select(m, a.C[0], b.C[0]), Select(m, a.C[1], b.C[1]), Select(m, a.C[2], b.C[2]) } };
}

TETRALUX_INLINE LaneVector Fma(const LaneVector& a, Float8 s, const LaneVector& b)
{
  return { { Fma(a.C[0], s, b.C[0]), Fma(a.C[1], s, b.C[1]), Fma(a.C[2], s, b.C[2]) } };
}

TETRALUX_INLINE LaneVector Broadcast(const float (&v)[3]) { return { { v[0], v[1], v[2] } }; }
TETRALUX_INLINE LaneVector Broadcast(const double (&v)[3])
{
  return { { static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]) } };
}

/// What lights make of a colour: color Scale + Add.
struct LaneFactors
{
  LaneVector Scale; ///< ambient and diffuse light
  LaneVector Add;   ///< specular light

  TETRALUX_INLINE LaneVector Apply(const LaneVector& color) const
  {
    return { { Fma(color.C[0], this->Scale.C[0], this->Add.C[0]),
      Fma(color.C[1], this->Scale.C[1], this->Add.C[1]),
      Fma(color.C[2], this->Scale.C[2], this->Add.C[2]) } };
  }
};

/// The lights as some rays meet them.
class LaneLights
{
public:
  LaneLights(const WorldRays& rays, Double8 start)
    : Rays(rays)
    , Start(start)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->View.C[a] = ToFloat(rays.Direction[a]);
    }
  }

  /// From the viewer, of length 1.
  const LaneVector& GetView() const { return this->View; }

  /// From where the rays are at distance z to a positional light, in units of KernelLighting.
  TETRALUX_INLINE LaneVector GetWayToLight(
    const KernelLighting& lighting, const KernelLight& light, Double8 z) const
  {
    Double8 way[3];
    this->FindWay(lighting, light, z, way);
    const Double8 largest = Max(Max(Abs(way[0]), Abs(way[1])), Abs(way[2]));
    // Squares of it are finite.
    constexpr double Farthest = 1e15;
    const Double8 scale = Min(Double8(1.), Double8(Farthest) / largest);
    return { { ToFloat(way[0] * scale), ToFloat(way[1] * scale), ToFloat(way[2] * scale) } };
  }

  /// The way to a spot times its axis, as vectors: how far the rays are beside the axis. Not from
  /// the way in single precision, whose rounding may be wider than the cone of a spot far away.
  TETRALUX_INLINE LaneVector GetAcrossAxis(
    const KernelLighting& lighting, const KernelLight& light, Double8 z) const
  {
    Double8 way[3];
    this->FindWay(lighting, light, z, way);
    LaneVector across;
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      across.C[a] = ToFloat(way[b] * Double8(light.Axis[c]) - way[c] * Double8(light.Axis[b]));
    }
    return across;
  }

  /// What distance leaves of a positional light.
  static TETRALUX_INLINE Float8 GetShare(const KernelLight& light, Float8 distance)
  {
    const Float8 falloff = Fma(distance,
      Fma(distance, Float8(light.Falloff[2]), Float8(light.Falloff[1])), Float8(light.Falloff[0]));
    return Float8(1.f) / falloff;
  }

  /// Returns a gradient in the world, of any length.
  static TETRALUX_INLINE LaneVector ToWorld(
    const KernelLighting& lighting, const LaneVector& gradient)
  {
    LaneVector world;
    for (int a = 0; a < 3; ++a)
    {
      world.C[a] = Dot(Broadcast(lighting.NormalFromMesh[a]), gradient);
    }
    return world;
  }

  /// Gradients about 1 long, whose squares are in any range. 0 where there is none.
  static TETRALUX_INLINE Float8 GetScale(const LaneVector& gradient)
  {
    const Float8 largest = Max(Max(Abs(gradient.C[0]), Abs(gradient.C[1])), Abs(gradient.C[2]));
    return Keep(Float8(0.f) < largest, Float8(1.f) / largest);
  }

  /// The light at distance z. gradient: in the world, not beyond the range of squares. visible: for
  /// each light, stride after stride, the share that nothing blocks, 0..1; nullptr: all of it.
  TETRALUX_NOINLINE LaneFactors Find(const KernelLighting& lighting, const LaneVector& gradient,
    Double8 z, const float* visible = nullptr, int stride = 0) const
  {
    const Float8 zero = 0.f;
    const Float8 one = 1.f;
    const Float8 steepness = Dot(gradient, gradient);
    const Mask8 known = zero < steepness;
    LaneVector normal =
      Select(known, gradient * (one / Sqrt(steepness)), this->View * Float8(-1.f));
    normal = Select(zero < Dot(normal, this->View), normal * Float8(-1.f), normal);
    LaneFactors factors = { { { zero, zero, zero } }, { { zero, zero, zero } } };
    for (int i = 0; i < lighting.NumberOfLights; ++i)
    {
      const KernelLight& light = lighting.Lights[i];
      LaneVector toLight;
      Float8 share = one;
      if (light.Positional)
      {
        const LaneVector way = this->GetWayToLight(lighting, light, z);
        const Float8 squared = Dot(way, way);
        const Float8 distance = Sqrt(squared);
        const Mask8 apart = zero < distance;
        toLight = way * Keep(apart, one / distance);
        share = Keep(apart, GetShare(light, distance));
        if (light.IsSpot)
        {
          const Float8 cosine = zero - Dot(toLight, Broadcast(light.Axis));
          const LaneVector across = this->GetAcrossAxis(lighting, light, z);
          const Float8 sine2 = Dot(across, across);
          const Float8 ofCone2 = Float8(light.ConeSine * light.ConeSine) * squared;
          const Mask8 before = zero < cosine;
          const Mask8 inside =
            light.IsWide ? before | (ofCone2 <= sine2) : before & (sine2 <= ofCone2);
          share = share * Keep(inside, Power(Max(zero, cosine), Float8(light.Exponent)));
        }
      }
      else
      {
        toLight = Broadcast(light.Position);
      }
      if (visible)
      {
        share = share * LoadFloat8(visible + i * stride);
      }
      const Float8 cosine = Dot(normal, toLight);
      const Mask8 faces = zero < cosine;
      const Float8 diffuse = Keep(faces, share * cosine);
      for (int c = 0; c < 3; ++c)
      {
        factors.Scale.C[c] =
          factors.Scale.C[c] + Fma(diffuse, Float8(light.Diffuse[c]), Float8(light.Ambient[c]));
      }
      if (lighting.Shines && Any(faces))
      {
        // Blinn's halfway vector between the light and the viewer.
        const LaneVector halfway = toLight - this->View;
        const Float8 length2 = Dot(halfway, halfway);
        const Float8 cosineOfHalf = Dot(normal, halfway) / Sqrt(length2);
        const Float8 specular = Keep(
          faces & (zero < length2), share * Power(cosineOfHalf, Float8(lighting.SpecularPower)));
        for (int c = 0; c < 3; ++c)
        {
          factors.Add.C[c] = Fma(specular, Float8(light.Specular[c]), factors.Add.C[c]);
        }
      }
    }
    return factors;
  }

private:
  TETRALUX_INLINE void FindWay(
    const KernelLighting& lighting, const KernelLight& light, Double8 z, Double8 (&way)[3]) const
  {
    const Double8 distance = this->Start + z;
    for (int a = 0; a < 3; ++a)
    {
      const Double8 position = Fma(distance, this->Rays.Direction[a], this->Rays.Origin[a]);
      way[a] = (Double8(light.Position[a]) - position) * Double8(1 / lighting.Unit);
    }
  }

  WorldRays Rays;
  Double8 Start; ///< distance of z = 0 along the rays
  LaneVector View;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
