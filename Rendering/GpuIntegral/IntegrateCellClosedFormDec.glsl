// SPDX-License-Identifier: BSD-3-Clause
// Emission and absorption in a cell of constant scalar: premultiplied colour and opacity.

vec4 IntegrateCell(int cell, float len)
{
  vec4 value = GetCellValue(cell);
  float opacity = GetOpacity(GetCellDepth(value, len));
  return opacity * vec4(value.yzw, 1.0);
}
