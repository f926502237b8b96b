// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellFieldValues_h
#define tetralux_CellFieldValues_h

// Makes and evaluates the fields of cells.

#include "Isosurface/CellField.h"
#include "Isosurface/Isopolygon.h"
#include "Mesh/Gradients.h"
#include "Simd/Lanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The field of a cell with values at its corners. In a flat cell it is constant, their mean.
template <int Components>
TETRALUX_INLINE void MakeCellField(const double (&corners)[4][3],
  const double (&values)[4][Components], CellField<Components>& field)
{
  double edges[3][3];
  for (int e = 0; e < 3; ++e)
  {
    for (int a = 0; a < 3; ++a)
    {
      edges[e][a] = corners[e + 1][a] - corners[0][a];
    }
  }
  double across[3][3]; // of the other two edges
  for (int e = 0; e < 3; ++e)
  {
    const double(&p)[3] = edges[(e + 1) % 3];
    const double(&q)[3] = edges[(e + 2) % 3];
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      across[e][a] = p[b] * q[c] - p[c] * q[b];
    }
  }
  const double volume =
    edges[0][0] * across[0][0] + edges[0][1] * across[0][1] + edges[0][2] * across[0][2];
  for (int a = 0; a < 3; ++a)
  {
    field.Origin[a] = corners[0][a];
  }
  for (int k = 0; k < Components; ++k)
  {
    field.Base[k] = volume != 0
      ? values[0][k]
      : 0.25 * (values[0][k] + values[1][k] + values[2][k] + values[3][k]);
    for (int a = 0; a < 3; ++a)
    {
      double slope = 0;
      for (int e = 0; e < 3; ++e)
      {
        slope += (values[e + 1][k] - values[0][k]) * across[e][a];
      }
      field.Slope[k][a] = volume != 0 ? slope / volume : 0;
    }
  }
}

/// The points of a cell in the mesh's frame.
TETRALUX_INLINE void GetCorners(
  const IsopolygonSource& source, std::int32_t cell, double (&corners)[4][3])
{
  for (int i = 0; i < 4; ++i)
  {
    const std::int32_t id = source.Cells[4 * static_cast<std::int64_t>(cell) + i];
    const double* point = source.Points + 3 * static_cast<std::int64_t>(id);
    for (int a = 0; a < 3; ++a)
    {
      corners[i][a] = (point[a] - source.Frame.Center[a]) / source.Frame.Radius;
    }
  }
}

/// The gradients of a cell, interpolated between its points.
TETRALUX_NOINLINE void MakeGradientField(const IsopolygonSource& source,
  const GradientRow* gradients, std::int32_t cell, CellField<3>& field)
{
  double corners[4][3], values[4][3];
  GetCorners(source, cell, corners);
  for (int i = 0; i < 4; ++i)
  {
    const GradientRow& row = gradients[source.Cells[4 * static_cast<std::int64_t>(cell) + i]];
    values[i][0] = row.X;
    values[i][1] = row.Y;
    values[i][2] = row.Z;
  }
  MakeCellField(corners, values, field);
}

/// A scalar of a cell, interpolated between its points.
TETRALUX_NOINLINE void MakeScalarField(
  const IsopolygonSource& source, const double* scalars, std::int32_t cell, CellField<1>& field)
{
  double corners[4][3], values[4][1];
  GetCorners(source, cell, corners);
  for (int i = 0; i < 4; ++i)
  {
    values[i][0] = scalars[source.Cells[4 * static_cast<std::int64_t>(cell) + i]];
  }
  MakeCellField(corners, values, field);
}

template <int Components>
TETRALUX_INLINE double EvaluateField(
  const CellField<Components>& field, int component, double x, double y, double z)
{
  const double(&slope)[3] = field.Slope[component];
  return field.Base[component] + slope[0] * (x - field.Origin[0]) +
    slope[1] * (y - field.Origin[1]) + slope[2] * (z - field.Origin[2]);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
