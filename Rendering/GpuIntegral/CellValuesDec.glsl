// SPDX-License-Identifier: BSD-3-Clause
// Cells of constant scalar: attenuation and colour, as CellValue has them; where the largest scalar
// is looked for, the mapped scalar in place of the attenuation.

uniform samplerBuffer cellValues;

vec4 GetCellValue(int cell)
{
  return texelFetch(cellValues, cell);
}

// Attenuation of a cell times a length in it, 0..LargestDepth.
float GetCellDepth(vec4 cellValue, float len)
{
  return clamp(cellValue.x * len, 0.0, LargestDepth);
}

// Where the largest scalar is looked for; not a number where the cell has none.
float GetCellScalar(int cell)
{
  return GetCellValue(cell).x;
}
