// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ScalarExtraction_h
#define tetralux_ScalarExtraction_h

#include "Mesh/TetrahedralMesh.h"
#include "TetraluxFiltersModule.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;

namespace tetralux
{

/// Which array to colour by, as every VTK mapper is told.
struct ScalarSelection
{
  /// VTK_SCALAR_MODE_DEFAULT: the active point scalars, else the active cell scalars.
  /// ..._USE_POINT_DATA, ..._USE_CELL_DATA: the active scalars of that kind.
  /// ..._USE_POINT_FIELD_DATA, ..._USE_CELL_FIELD_DATA: the array of that kind that ArrayId or
  /// ArrayName selects. ..._USE_FIELD_DATA is refused: field data belongs to no point or cell.
  int ScalarMode = 0;

  /// VTK_GET_ARRAY_BY_ID or VTK_GET_ARRAY_BY_NAME; used with the two field modes.
  int ArrayAccessMode = 0;
  int ArrayId = -1;
  std::string ArrayName;

  /// How an array of several components becomes one number, as vtkSmartVolumeMapper's VectorMode:
  /// -1 disabled (the first component), 0 magnitude, 1 component VectorComponent.
  int VectorMode = -1;
  int VectorComponent = 0;
  /// Components of the magnitude, from VectorComponent on; 0: all.
  int VectorSize = 0;
};

/// The result of ExtractScalars. Where Error is not empty, Values is empty.
struct ExtractedScalars
{
  std::vector<double> Values; ///< one for each point, or each tetrahedron, of the mesh
  bool CellData = false;      ///< whether Values are of the tetrahedra
  std::string ArrayName;      ///< may be empty: arrays need no name
  double Rounding = 0;        ///< of a value as the arrays have it, relative; 0 of integers
  std::string Error;          ///< one line that says what is missing and what there is
};

/// The selected array as one number for each point or tetrahedron of a mesh that TakeInTetrahedra
/// made of the same input, also after cells were removed or points and cells reordered. Added
/// points have the weighted mean of their sources. Numeric arrays of any type; 64-bit integers
/// are rounded to double.
///
/// In a composite, a block that lacks the array has not-a-number values; if all lack it, that is an
/// error. Whether it is point or cell data is decided by the first block that has it.
TETRALUXFILTERS_EXPORT ExtractedScalars ExtractScalars(
  vtkDataObject* input, const TetrahedralMesh& mesh, const ScalarSelection& selection);

/// The selected array of one data set, as it is. Where Error is not empty, it can't be used.
struct SelectedArray
{
  vtkDataArray* Array = nullptr; ///< of the data set
  bool CellData = false;
  bool Magnitude = false; ///< of all components is the scalar; else Component
  int Component = 0;
  std::string Error; ///< one line that says what is missing and what there is
};

TETRALUXFILTERS_EXPORT SelectedArray FindSelectedArray(
  vtkDataSet* dataSet, const ScalarSelection& selection);

/// "point arrays: Density, Momentum (3 components); cell arrays: none" of all blocks together, in
/// the order in which they are met.
TETRALUXFILTERS_EXPORT std::string DescribeArrays(vtkDataObject* input);

} // namespace tetralux

#endif
