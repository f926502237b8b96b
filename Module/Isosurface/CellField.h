// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellField_h
#define tetralux_CellField_h

// What is linear in a cell, at any point of it: gradients and scalars of its points. In double
// precision, since in a thin cell differences of points are small beside their factors.

namespace tetralux
{

/// Base + Slope (q - Origin) of some components, with q in the mesh's frame.
template <int Components>
struct CellField
{
  double Origin[3];
  double Base[Components];
  double Slope[Components][3];
};

} // namespace tetralux

#endif
