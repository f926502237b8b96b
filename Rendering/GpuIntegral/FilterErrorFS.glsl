//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// How far off the graphics card is between two texels of 0 and 1, at the share that texCoord.x
// tells.

//VTK::Output::Dec

uniform sampler3D texels;
in vec2 texCoord;

void main()
{
  float share = texCoord.x;
  // Of two texels, whose centres are at 1/4 and 3/4.
  vec3 place = vec3(0.25 + 0.5 * share, 0.25, 0.25);
  gl_FragData[0] = vec4(abs(texture(texels, place).r - share));
}
