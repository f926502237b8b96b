//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Two triangles, six vertices, that are the square of a pixel, for each pixel of which samples are
// drawn.

uniform isamplerBuffer pixels;
uniform ivec2 pictureSize;

flat out int pixelVSOutput;

void main()
{
  pixelVSOutput = gl_VertexID / 6;
  int corner = gl_VertexID % 6;
  bool right = corner == 1 || corner == 2 || corner == 4;
  bool top = corner == 2 || corner == 4 || corner == 5;
  int pixel = texelFetch(pixels, pixelVSOutput).x;
  vec2 place = vec2(pixel % pictureSize.x + int(right), pixel / pictureSize.x + int(top));
  gl_Position = vec4(2.0 * place / vec2(pictureSize) - 1.0, 0.0, 1.0);
}
