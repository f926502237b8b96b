//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// One texel of an opaque picture and of its depths for each fragment, where it has one.

//VTK::Output::Dec

uniform sampler2D image;
uniform sampler2D depths;
in vec2 texCoord;

void main()
{
  float depth = texture(depths, texCoord).r;
  if (depth >= 1.0)
  {
    discard;
  }
  gl_FragData[0] = texture(image, texCoord);
  gl_FragDepth = depth;
}
