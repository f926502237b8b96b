// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImagePlacement_h
#define tetralux_ImagePlacement_h

#include "TetraluxRenderingModule.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

class vtkImageData;
class vtkMatrix4x4;

namespace tetralux
{

/// Where the points of image data are, whatever their origin, spacing, direction and extent.
/// Indices count from the first point of the extent, as ImageVolume's do.
struct ImagePlacement
{
  double IndexFromData[3][4]; ///< rows of an affine map
  double DataFromIndex[3][4];
};

/// Throws std::invalid_argument, with one line, if the points do not span a space: a spacing is 0,
/// say.
TETRALUXRENDERING_EXPORT ImagePlacement PlaceImage(vtkImageData* image);

/// World lengths of the steps from point to point along each axis. worldFromData: of the volume.
TETRALUXRENDERING_EXPORT void MeasureSteps(
  const ImagePlacement& placement, vtkMatrix4x4* worldFromData, double steps[3]);

/// Rays whose mesh is the data, of which that is indices.
TETRALUXRENDERING_EXPORT RayGrid ToIndices(const ImagePlacement& placement, const RayGrid& grid);

/// Limits whose cropping planes are in coordinates of the data, of which they are indices. Throws
/// std::invalid_argument, with one line, if those are not along the axes of the image.
TETRALUXRENDERING_EXPORT RayLimits ToIndices(
  const ImagePlacement& placement, const RayLimits& limits);

} // namespace tetralux

#endif
