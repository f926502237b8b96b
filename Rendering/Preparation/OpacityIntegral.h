// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_OpacityIntegral_h
#define tetralux_OpacityIntegral_h

#include "TetraluxRenderingModule.h"

#include <functional>

class vtkDataArray;
class vtkImageData;
class vtkUnstructuredGrid;

namespace tetralux
{

/// The integral of an opacity over the volume of data, in cubed units of the data. Opacity is a
/// function of tuples of the array, opacity(tuple, number of components); values that are not above
/// 0 count as 0. From it a unit distance follows that is neither too dense nor too thin, see
/// FindUnitDistance.
///@{
/// Of tetrahedra; other cells count nothing. ofCells: the array has one tuple a cell, else one a
/// point. Of a cell, four places are taken, by which quadratic functions are integrated exactly.
TETRALUXRENDERING_EXPORT double IntegrateOpacity(vtkUnstructuredGrid* tetrahedra,
  vtkDataArray* array, bool ofCells, const std::function<double(const double*)>& opacity);
/// Of an image: the mean of all tuples, times the volume.
TETRALUXRENDERING_EXPORT double IntegrateOpacity(
  vtkImageData* image, vtkDataArray* array, const std::function<double(const double*)>& opacity);
///@}

/// The unit distance with which rays through a box, in all directions alike, have a mean optical
/// depth of 1. bounds: of all data. 0 if the integral is 0 or the box is flat.
TETRALUXRENDERING_EXPORT double FindUnitDistance(double opacityIntegral, const double bounds[6]);

} // namespace tetralux

#endif
