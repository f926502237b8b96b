//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Covers the pixels in which no cell is drawn: those of depth 0.

uniform sampler2D opaqueDepth;

out vec4 fragOutput0; // gl_FragData[0]

void main()
{
  if (texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).x > 0.0)
  {
    discard;
  }
  gl_FragDepth = 0.0;
  fragOutput0 = vec4(0.0);
}
