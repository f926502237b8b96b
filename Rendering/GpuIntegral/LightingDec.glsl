// SPDX-License-Identifier: BSD-3-Clause
// What lights make of a colour, as FindLight of SurfaceShading.h: ambient and diffuse light times
// the colour, and Blinn's specular light, in the world, whose lengths are in units of rays. Points
// and directions are those of rays, in radii of the mesh from its centre; gradients are in
// coordinates of the mesh, of any length.
// NUMBER_OF_LIGHTS is how many lights there are.

uniform mat3 worldFromRay;   // from the centre of the mesh
uniform mat3 normalFromMesh; // of the world, times any factor
uniform float specularPower;
#if NUMBER_OF_LIGHTS > 0
uniform vec4 lightPositions[NUMBER_OF_LIGHTS]; // from the centre of the mesh and 1; of a distant
                                               // light the direction towards it and 0
uniform vec4 lightCones[NUMBER_OF_LIGHTS];     // axis of a spot, cosine of half its cone
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

// The normal in the world, turned to the viewer; what has no gradient faces the viewer.
vec3 FindNormal(vec3 gradient, vec3 direction)
{
  // By the largest component first: squares may be beyond any range.
  vec3 size = abs(gradient);
  float largest = max(size.x, max(size.y, size.z));
  bool known = largest > 0.0 && largest < 3.4e38;
  vec3 normal = known ? normalFromMesh * (gradient / largest) : -direction;
  return dot(normal, direction) > 0.0 ? -normalize(normal) : normalize(normal);
}

// point: where; direction: the change of a ray's point for one unit.
LightFactors FindLight(vec3 point, vec3 gradient, vec3 direction)
{
  LightFactors factors = LightFactors(vec3(0.0), vec3(0.0));
#if NUMBER_OF_LIGHTS > 0
  vec3 place = worldFromRay * point;
  vec3 view = worldFromRay * direction;
  vec3 normal = FindNormal(gradient, view);
  for (int light = 0; light < NUMBER_OF_LIGHTS; ++light)
  {
    bool positional = lightPositions[light].w > 0.0;
    vec3 toLight = lightPositions[light].xyz - (positional ? place : vec3(0.0));
    float distance = length(toLight);
    toLight = distance > 0.0 ? toLight / distance : vec3(0.0);
    vec4 falloff = lightFalloffs[light];
    vec4 cone = lightCones[light];
    float share = 1.0 / (falloff.x + distance * (falloff.y + distance * falloff.z));
    share = distance > 0.0 ? share : 0.0;
    float spot = -dot(toLight, cone.xyz);
    share *= cone.w <= -1.0 ? 1.0 : spot >= cone.w ? pow(max(spot, 1e-30), falloff.w) : 0.0;
    share = positional ? share : 1.0;

    // Blinn's halfway vector between the light and the viewer.
    float cosine = dot(normal, toLight);
    vec3 halfway = toLight - view;
    float halfwayLength = length(halfway);
    float highlight = halfwayLength > 0.0 ? dot(normal, halfway) / halfwayLength : 0.0;
    float lit = cosine > 0.0 ? share : 0.0;
    factors.Scale += lightAmbient[light] + lit * cosine * lightDiffuse[light];
    float shine = halfwayLength > 0.0 ? pow(max(highlight, 1e-30), specularPower) : 0.0;
    factors.Add += lit * shine * lightSpecular[light];
  }
#endif
  return factors;
}
