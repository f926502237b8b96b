// SPDX-License-Identifier: BSD-3-Clause
// The light along a ray's way through a cell, cut into parts on which it is nearly a parabola:
// RayCastLightParts.h, which this follows word by word. Needs LightingDec.glsl.

uniform float lightTurn; // LightSteps
uniform float lightApproach;

// As in RayCastLightParts.h.
const float ShortestPart = 1.0 / 1048576.0;

// As there, and in LightSteps.h.
const float SmallLightWeight = 1.0 / 32.0;
const float LeastLightWeight = 1.0 / 512.0;

// As in LightSteps.h, from the middle of a part.
const float LightSampleReach = 0.4330127018922194;

// In the world; lengths in units of rays.
struct LightPath
{
  vec3 Place; // at the front
  vec3 Way;   // to the back
  vec3 View;
  vec3 Gradient; // at the front
  vec3 Change;   // of the gradient, to the back
};

LightPath MakeLightPath(vec3 frontGradient, vec3 backGradient, vec3 frontPoint, vec3 backPoint,
  vec3 direction)
{
  float front = FindGradientScale(frontGradient);
  float back = FindGradientScale(backGradient);
  // Both by the same scale; 0 is that of no gradient.
  float scale = front > 0.0 && back > 0.0 ? min(front, back) : max(front, back);
  LightPath path;
  path.Place = worldFromRay * frontPoint;
  path.Way = worldFromRay * (backPoint - frontPoint);
  path.View = worldFromRay * direction;
  path.Gradient = ToWorld(frontGradient, scale);
  path.Change = ToWorld(backGradient, scale) - path.Gradient;
  return path;
}

LightFactors FindLightAt(LightPath path, float share)
{
  return Illuminate(
    path.Place + share * path.Way, path.Gradient + share * path.Change, path.View);
}

// The end of a part that begins at begin: share, if that is nearer, but not where a cut was before.
float CutLight(float share, float begin, float end)
{
  return share > begin + ShortestPart && share < end ? share : end;
}

float LimitLight(float step, float begin, float end)
{
  float share = begin + max(step, ShortestPart);
  return share < end ? share : end;
}

// Cuts where c + b t + a t^2 changes its sign.
float CutLightAtRoots(float c, float b, float a, float begin, float end)
{
  float discriminant = b * b - 4.0 * a * c;
  float q = -0.5 * (b + (b < 0.0 ? -1.0 : 1.0) * sqrt(max(0.0, discriminant)));
  bool any = discriminant >= 0.0;
  end = any && q != 0.0 ? CutLight(c / q, begin, end) : end;
  return any && a != 0.0 ? CutLight(q / a, begin, end) : end;
}

// How far a vector that is linear in the share may go on until it has turned.
float FindTurn(vec3 vector, vec3 change, float tangent)
{
  float size = length(vector);
  float along = size > 0.0 ? dot(vector, change) / size : 0.0;
  vec3 across = size > 0.0 ? change - along / size * vector : vec3(0.0);
  float turning = length(across);
  float bounded = tangent * pow(turning / (turning + 1.6 * abs(along) + 1e-30), 2.0 / 3.0);
  float rate = turning - bounded * along;
  return size > 0.0 && rate > 0.0 ? bounded * size / rate : 2.0;
}

float CutAtSide(float atFront, float change, float begin, float end)
{
  return change != 0.0 ? CutLight(-atFront / change, begin, end) : end;
}

#ifdef POSITIONAL_LIGHTS
// How much brighter near lights shine than LightSteps knows; at least 1.
float FindNearBrightness(vec3 place)
{
  float brightness = 1.0;
  for (int light = 0; light < NUMBER_OF_LIGHTS; ++light)
  {
    vec4 falloff = lightFalloffs[light];
    bool fades = lightPositions[light].w > 0.0 && (falloff.y != 0.0 || falloff.z != 0.0);
    float distance = length(lightPositions[light].xyz - place);
    float weakened = falloff.x + distance * (falloff.y + distance * falloff.z);
    brightness = fades && weakened > 0.0 ? max(brightness, 1.0 / weakened) : brightness;
  }
  return brightness;
}
#endif

// weight: of the part in the picture; if it is not small the part ends at heavyEnd.
float FindLightEnd(LightPath path, float begin, float weight, float heavyEnd)
{
  float longer = pow(clamp(weight / SmallLightWeight, LeastLightWeight, 1.0), -1.0 / 3.0);
#ifdef POSITIONAL_LIGHTS
  longer *= pow(FindNearBrightness(path.Place + begin * path.Way), -1.0 / 3.0);
#endif
  float tangent = tan(min(1.0, longer * lightTurn));
  float end = LimitLight(weight > SmallLightWeight ? heavyEnd - begin : 1.0, begin, 1.0);
  end = CutAtSide(dot(path.Gradient, path.View), dot(path.Change, path.View), begin, end);
  end = LimitLight(FindTurn(path.Gradient + begin * path.Change, path.Change, tangent), begin, end);
#if NUMBER_OF_LIGHTS > 0
  for (int light = 0; light < NUMBER_OF_LIGHTS; ++light)
  {
    vec3 position = lightPositions[light].xyz;
    if (lightPositions[light].w == 0.0)
    {
      end = CutAtSide(dot(path.Gradient, position), dot(path.Change, position), begin, end);
    }
#ifdef POSITIONAL_LIGHTS
    else
    {
      vec3 toLight = position - path.Place;
      vec3 change = -path.Way;
      vec3 fromBegin = toLight + begin * change;
      float approach = dot(toLight, change);
      float way2 = dot(change, change);
      end = CutLightAtRoots(dot(path.Gradient, toLight),
        dot(path.Gradient, change) + dot(path.Change, toLight), dot(path.Change, change), begin,
        end);
      end = CutAtSide(approach, way2, begin, end);
      end = LimitLight(FindTurn(fromBegin, change, tangent), begin, end);
      if (lightFalloffs[light].y != 0.0 || lightFalloffs[light].z != 0.0)
      {
        float share = min(1.0, longer * lightApproach);
        float step = way2 > 0.0 ? share * length(fromBegin) * inversesqrt(way2) : 2.0;
        end = LimitLight(step, begin, end);
      }
#ifdef SPOTS
      if (lightCones[light].w <= 1.0)
      {
        // Where the angle to the axis is that of the cone, or opposite to it.
        vec3 axis = lightCones[light].xyz;
        vec3 across = lightAcrossAxes[light] - cross(path.Place, axis);
        vec3 acrossChange = cross(change, axis);
        float axial = dot(toLight, axis);
        float axialChange = dot(change, axis);
        float sine2 = lightCones[light].w * lightCones[light].w;
        float cosine2 = 1.0 - sine2;
        end = CutLightAtRoots(cosine2 * dot(across, across) - sine2 * axial * axial,
          2.0 * (cosine2 * dot(across, acrossChange) - sine2 * axial * axialChange),
          cosine2 * dot(acrossChange, acrossChange) - sine2 * axialChange * axialChange, begin,
          end);
      }
#endif
    }
#endif
  }
#endif
  return end < 1.0 - ShortestPart ? end : 1.0;
}
