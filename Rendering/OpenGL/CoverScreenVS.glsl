//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// One triangle that covers the viewport, behind all: three vertices without attributes.

void main()
{
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 1.0, 1.0);
}
