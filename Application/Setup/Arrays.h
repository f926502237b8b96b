// SPDX-License-Identifier: BSD-3-Clause
#ifndef Arrays_h
#define Arrays_h

#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkDataObject;

/// A point or cell array of a data set, or of all blocks of a composite that have it.
struct ArraySummary
{
  std::string Name;
  bool CellData = false;
  int DataType = VTK_VOID;
  int Components = 0;
  bool Active = false; ///< the active scalars
  vtkIdType Values = 0;

  /// Range of the finite values of each component; minimum above maximum where there is none.
  std::vector<std::array<double, 2>> Ranges;
  std::array<double, 2> MagnitudeRange = { 1, -1 };

  vtkIdType NonFiniteValues = 0;
};

/// The numeric arrays of all blocks, point arrays first, in the order in which they are met. Arrays
/// without a name and marks of ghosts are not among them.
std::vector<ArraySummary> ListArrays(vtkDataObject* data);

/// What is coloured by.
struct ArrayChoice
{
  ArraySummary Array;
  bool Magnitude = false;
  int Component = 0;
  std::array<double, 2> Range; ///< of the finite values chosen

  /// "Temp (point)", "V (point, magnitude)"
  std::string Describe() const;
};

/// Chooses by the options --array and --component. Where name is empty: the active scalars, else the
/// first array of floating point numbers, else the first one; point arrays before cell arrays. Where
/// component is empty: the only one, else the magnitude. A name that is both is the point array's.
/// Throws WorkError, which names the arrays there are.
ArrayChoice ChooseArray(vtkDataObject* data, const std::string& name, const std::string& component);

#endif
