// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_StructuredLayout_h
#define tetralux_StructuredLayout_h

#include <cstdint>

class vtkDataSet;

namespace tetralux
{

/// The layout of image data, rectilinear and structured grids.
struct StructuredLayout
{
  int Dimensions[3]; ///< points along each axis
  int Extent[6];
  int CellType;

  bool IsThreeDimensional() const;

  /// 0 or 1: whether i + j + k is odd. Of a point, or of a cell by its first point. Counted in the
  /// whole extent, so that neighbouring pieces cut their common face alike.
  int GetParity(int i, int j, int k) const;
  int GetParityOfPoint(std::int64_t point) const;
};

/// Fills layout where a data set is a structured grid.
bool GetStructuredLayout(vtkDataSet* dataSet, StructuredLayout& layout);

/// The tetrahedra that a structured grid without blanking gives, else 0: known before any work.
std::int64_t CountStructuredTetrahedra(vtkDataSet* dataSet);

} // namespace tetralux

#endif
