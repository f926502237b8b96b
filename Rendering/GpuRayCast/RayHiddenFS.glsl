//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Covers the pixels whose rays see nothing, before the first pass: those of depth 0.

//VTK::RayStates::Dec
//VTK::GetRay::Dec

out vec4 fragOutput0; // gl_FragData[0]

void main()
{
  if (texelFetch(opaqueDepth, ivec2(GetPixel() * opaquePixels), 0).x > 0.0)
  {
    discard;
  }
  gl_FragDepth = 0.0;
  fragOutput0 = vec4(0.0);
}
