//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// One texel of a premultiplied picture for each fragment; blending composites it.

//VTK::Output::Dec

uniform sampler2D image;
in vec2 texCoord;

void main()
{
  gl_FragData[0] = texture(image, texCoord);
}
