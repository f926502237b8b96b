//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// The picture that rays gathered: premultiplied colour and opacity, and the distance of the first
// contribution from where the ray starts, -1 where there is none. A ray that was done is left alone
// by later passes: what it came to is in that texture of the two in which it took more steps.

//VTK::RayStates::Dec
//VTK::GetRay::Dec
//VTK::RayFrame::Dec
//VTK::Lighting::Dec
//VTK::RayIntegral::Dec

//VTK::FirstContribution::Dec

uniform isampler2D rayEntries;
uniform sampler2D rayColors;
uniform sampler2D rayFirsts;
uniform isampler2D otherRayEntries;
uniform sampler2D otherRayColors;
uniform sampler2D otherRayFirsts;

// gl_FragData[0], gl_FragData[1]
out vec4 fragOutput0;
out vec2 fragOutput1;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int steps = texelFetch(rayEntries, pixel, 0).z;
  int otherSteps = texelFetch(otherRayEntries, pixel, 0).z;
  vec4 color = texelFetch(rayColors, pixel, 0);
  vec4 first = texelFetch(rayFirsts, pixel, 0);
  if (otherSteps > steps)
  {
    steps = otherSteps;
    color = texelFetch(otherRayColors, pixel, 0);
    first = texelFetch(otherRayFirsts, pixel, 0);
  }
  bool any = first.x < LargestFloat;
#ifdef GATHER_LARGEST
  color = any ? ClassifyLargest(color.r) : vec4(0.0);
#endif
  float distance = first.x;
#ifdef FIND_FIRST
  float share = any ? FindFirst(first.z, first.w) : 0.0;
  distance += share <= 1.0 ? share * (first.y - first.x) : 0.0;
#endif
  RayFrame frame = MakeRayFrame(GetRay(gl_FragCoord.xy));
  fragOutput0 = color;
  fragOutput1 = vec2(any ? (frame.Start + distance) * rayLengthUnit : -1.0, float(steps));
}
