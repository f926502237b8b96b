//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Colours for the largest scalars along rays.

//VTK::Segment::Dec

uniform sampler2D largestScalars;

out vec4 fragOutput0; // gl_FragData[0]

void main()
{
  fragOutput0 = ClassifyLargest(texelFetch(largestScalars, ivec2(gl_FragCoord.xy), 0).x);
}
