// SPDX-License-Identifier: BSD-3-Clause
// A cell of constant scalar where all that attenuates has one colour, and absorption alone.

uniform vec3 constantColor; // 0 for absorption alone

vec4 IntegrateCell(int cell, float len)
{
  return GetOpacity(GetCellDepth(GetCellValue(cell), len)) * vec4(constantColor, 1.0);
}
