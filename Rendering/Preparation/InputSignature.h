// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_InputSignature_h
#define tetralux_InputSignature_h

#include "Base/Cached.h"
#include "Base/Digest.h"
#include "Intake/DataSetBlocks.h"
#include "Intake/ScalarExtraction.h"

#include "vtkType.h"

#include <vector>

class vtkDataObject;
class vtkVolumeProperty;

namespace tetralux
{

// What something was built from: objects and their modification times. Equal keys mean that nothing
// has changed. Pointers are never followed; a new object at an old address has a later time.

/// The latest time at which somebody said that an input was modified: of the input, of composites
/// in it and of its data sets, each by itself. What an array says is in the keys below. A change
/// means that anything may have changed in place, in arrays that say nothing, as VTK's mappers take
/// it.
vtkMTimeType GetInputTime(vtkDataObject* input, const std::vector<DataSetBlock>& blocks);

/// The same of the attributes of its data sets: a change means that their values may have changed.
/// A time step that brings other values says so here, so that cells and points need no comparison.
/// Ghost flags that change in place belong to the cells: their array or the data set has to say so.
vtkMTimeType GetAttributesTime(const std::vector<DataSetBlock>& blocks);

/// Of the cells that tetrahedra are made of: cells and ghost flags of each data set, but neither
/// points nor any other array. Data sets that are none of VTK's grids are changed by anything.
CacheKey GetCellsKey(const std::vector<DataSetBlock>& blocks);

/// Of the coordinates of the points.
CacheKey GetPointsKey(const std::vector<DataSetBlock>& blocks);

/// Of what GetCellsKey is of, by content: a reader of a time series makes new arrays of the same
/// cells in every step, and an input may have been modified elsewhere. Linear time, some five
/// milliseconds a million tetrahedra.
Digest DigestCells(const std::vector<DataSetBlock>& blocks);

/// Of what GetPointsKey is of, by content.
Digest DigestPoints(const std::vector<DataSetBlock>& blocks);

/// Of all that scalars depend on beside the mesh: the selected array of each data set.
CacheKey GetScalarsKey(const std::vector<DataSetBlock>& blocks, const ScalarSelection& selection);

/// The selected array of each data set, by content, with ghost flags.
Digest DigestScalars(const std::vector<DataSetBlock>& blocks, const ScalarSelection& selection);

/// Of all that TransferFunctionFromProperty reads, and of the values of isosurfaces.
CacheKey GetPropertyKey(vtkVolumeProperty* property);

} // namespace tetralux

#endif
