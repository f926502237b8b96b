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
};

/// Fills layout where a data set is a structured grid.
bool GetStructuredLayout(vtkDataSet* dataSet, StructuredLayout& layout);

/// The tetrahedra that a structured grid without blanking gives, else 0: known before any work.
std::int64_t CountStructuredTetrahedra(vtkDataSet* dataSet);

} // namespace tetralux

#endif
