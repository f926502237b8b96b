//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// One texel of a picture's depths for each fragment, where it has one.

//VTK::Output::Dec

uniform sampler2D depths;
in vec2 texCoord;

void main()
{
  float depth = texture(depths, texCoord).r;
  if (depth >= 1.0)
  {
    discard;
  }
  gl_FragDepth = depth;
}
