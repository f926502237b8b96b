// SPDX-License-Identifier: BSD-3-Clause
// Emission alone of a cell of constant scalar.

vec4 IntegrateCell(int cell, float len)
{
  vec4 value = GetCellValue(cell);
  return vec4(GetCellDepth(value, len) * value.yzw, 0.0);
}
