// SPDX-License-Identifier: BSD-3-Clause
#ifndef Arrays_h
#define Arrays_h

#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkDataObject;

/// A point or cell array of a data set, or of all blocks of a composite data set that have it.
struct ArraySummary
{
  std::string Name;
  bool CellData = false;
  int DataType = VTK_VOID;
  int Components = 0;
  bool Active = false; ///< the active scalars
  vtkIdType Values = 0;

  /// Range of the finite values of each component; minimum above maximum: no finite value.
  std::vector<std::array<double, 2>> Ranges;
  std::array<double, 2> MagnitudeRange = { 1, -1 };

  vtkIdType NonFiniteValues = 0;
};

/// Lists the numeric arrays of all blocks, point arrays first. Skips arrays without a name and
/// marks of ghosts.
std::vector<ArraySummary> ListArrays(vtkDataObject* data);

/// The scalars that colours are for.
struct ArrayChoice
{
  ArraySummary Array;
  bool Magnitude = false;
  int Component = 0;
  std::array<double, 2> Range; ///< of the finite values chosen
};

/// Chooses by the options --array and --component. If name is empty, it takes the active scalars,
/// else the first array of floating point numbers, else the first array; point arrays come before
/// cell arrays. If component is empty, it takes the only one, else the magnitude. Throws WorkError
/// that lists the arrays. option: that gave the name, for errors.
ArrayChoice ChooseArray(vtkDataObject* data, const std::string& name, const std::string& component,
  const std::string& option = "--array");

#endif
