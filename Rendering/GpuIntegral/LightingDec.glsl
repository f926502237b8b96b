// SPDX-License-Identifier: BSD-3-Clause
// What lights make of a colour, as LaneLights of RayCastLight.h: ambient and diffuse light times
// the colour, and Blinn's specular light, in the world, whose lengths are in units of rays. Points
// and directions are those of rays, in radii of the mesh from its centre; gradients are in
// coordinates of the mesh, of any length.
// NUMBER_OF_LIGHTS is how many lights there are; POSITIONAL_LIGHTS and SPOTS tell that some are
// such, HIGHLIGHTS that there is specular light.

uniform mat3 worldFromRay;   // from the centre of the mesh
uniform mat3 normalFromMesh; // of the world, times any factor
uniform float specularPower;
#if NUMBER_OF_LIGHTS > 0
uniform vec4 lightPositions[NUMBER_OF_LIGHTS]; // from the centre of the mesh and 1; of a distant
                                               // light the direction towards it and 0
uniform vec4 lightCones[NUMBER_OF_LIGHTS];     // axis of a spot, sine of half its cone, negative if
                                               // that is wide; above 1 there is no cone
uniform vec3 lightAcrossAxes[NUMBER_OF_LIGHTS]; // of a spot the way from the mesh to it
                                                // times the axis: of a spot far away its
                                                // cone may be narrower than what the way rounds
uniform vec4 lightFalloffs[NUMBER_OF_LIGHTS];  // coefficients of the distance, exponent of a spot
uniform vec3 lightAmbient[NUMBER_OF_LIGHTS];   // all times the material's
uniform vec3 lightDiffuse[NUMBER_OF_LIGHTS];
uniform vec3 lightSpecular[NUMBER_OF_LIGHTS];
#endif

// A lit colour is color Scale + Add.
struct LightFactors
{
  vec3 Scale;
  vec3 Add;
};

// What makes gradients of the mesh ones of about 1, whose squares are in any range; 0 where there
// is none. By the largest component.
float FindGradientScale(vec3 gradient)
{
  vec3 size = abs(gradient);
  float largest = max(size.x, max(size.y, size.z));
  return largest > 0.0 && largest < 3.4e38 ? 1.0 / largest : 0.0;
}

// The gradient in the world, of any length; 0 where there is none.
vec3 ToWorld(vec3 gradient, float scale)
{
  return scale > 0.0 ? normalFromMesh * (gradient * scale) : vec3(0.0);
}

// place and gradient: in the world, from the centre of the mesh; view: from the viewer, 1 long.
// The normal is the gradient turned to the viewer; what has no gradient faces the viewer.
LightFactors Illuminate(vec3 place, vec3 gradient, vec3 view)
{
  LightFactors factors = LightFactors(vec3(0.0), vec3(0.0));
#if NUMBER_OF_LIGHTS > 0
  float steepness = dot(gradient, gradient);
  vec3 normal = steepness > 0.0 ? gradient * inversesqrt(steepness) : -view;
  normal = dot(normal, view) > 0.0 ? -normal : normal;
  for (int light = 0; light < NUMBER_OF_LIGHTS; ++light)
  {
    vec3 toLight = lightPositions[light].xyz;
    float share = 1.0;
#ifdef POSITIONAL_LIGHTS
    bool positional = lightPositions[light].w > 0.0;
    toLight -= positional ? place : vec3(0.0);
    float distance = length(toLight);
    toLight = distance > 0.0 ? toLight / distance : vec3(0.0);
    vec4 falloff = lightFalloffs[light];
    share = 1.0 / (falloff.x + distance * (falloff.y + distance * falloff.z));
    share = distance > 0.0 ? share : 0.0;
#ifdef SPOTS
    vec4 cone = lightCones[light];
    float spot = -dot(toLight, cone.xyz);
    vec3 across = lightAcrossAxes[light] - cross(place, cone.xyz);
    float sine2 = dot(across, across);
    float ofCone2 = cone.w * cone.w * distance * distance;
    bool inside = cone.w < 0.0 ? spot > 0.0 || sine2 >= ofCone2 : spot > 0.0 && sine2 <= ofCone2;
    share *= cone.w > 1.0 ? 1.0 : inside ? pow(max(spot, 1e-30), falloff.w) : 0.0;
#endif
    share = positional ? share : 1.0;
#endif
    float cosine = dot(normal, toLight);
    float lit = cosine > 0.0 ? share : 0.0;
    factors.Scale += lightAmbient[light] + lit * cosine * lightDiffuse[light];
#ifdef HIGHLIGHTS
    // Blinn's halfway vector between the light and the viewer.
    vec3 halfway = toLight - view;
    float halfwayLength = length(halfway);
    float highlight = halfwayLength > 0.0 ? dot(normal, halfway) / halfwayLength : 0.0;
    float shine = halfwayLength > 0.0 ? pow(max(highlight, 1e-30), specularPower) : 0.0;
    factors.Add += lit * shine * lightSpecular[light];
#endif
  }
#endif
  return factors;
}

// point: where; gradient: of the mesh; direction: the change of a ray's point for one unit.
LightFactors FindLight(vec3 point, vec3 gradient, vec3 direction)
{
  return Illuminate(worldFromRay * point, ToWorld(gradient, FindGradientScale(gradient)),
    worldFromRay * direction);
}
