//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Covers the pixels whose rays are done, so that the depth test keeps them out of later passes
// (Weiler et al. 2003, section 5.2).

//VTK::RayStates::Dec

uniform isampler2D rayStates;
uniform isampler2D rayEntries;
uniform isampler2D nextEntries;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int state = texelFetch(rayStates, pixel, 0).w;
  bool lastPart = texelFetch(rayEntries, pixel, 0).y + 1 == NUMBER_OF_PARTS;
  bool noEntry =
    lastPart && state == RayNeedsEntry && texelFetch(nextEntries, pixel, 0).x == NoEntry;
  if (state != RayIsDone && !noEntry)
  {
    discard;
  }
  gl_FragDepth = 0.0;
}
