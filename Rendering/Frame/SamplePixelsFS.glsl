//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// The premultiplied colour of a sample, or with WRITE_DEPTH its depth, where it has one.

//VTK::Output::Dec

uniform samplerBuffer values;
uniform int firstValue; // of the sample

flat in int pixelVSOutput;

void main()
{
  vec4 value = texelFetch(values, firstValue + pixelVSOutput);
  gl_FragData[0] = value;
#ifdef WRITE_DEPTH
  if (value.r >= 1.0)
  {
    discard;
  }
  gl_FragDepth = value.r;
#endif
}
