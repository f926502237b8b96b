//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Colours for the largest scalars along rays.

//VTK::Output::Dec

//VTK::Segment::Dec

uniform sampler2D largestScalars;
in vec2 texCoord;

void main()
{
  gl_FragData[0] = ClassifyLargest(texture(largestScalars, texCoord).x);
}
