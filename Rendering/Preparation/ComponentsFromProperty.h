// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ComponentsFromProperty_h
#define tetralux_ComponentsFromProperty_h

// What a volume property says of arrays of several components.

#include "Base/Cached.h"
#include "Intake/DataSetBlocks.h"
#include "Intake/ScalarExtraction.h"
#include "Optics/ComponentFunctions.h"

#include <string>
#include <vector>

class vtkVolumeProperty;

namespace tetralux
{

/// How the selected array is shown.
struct ComponentUse
{
  enum class Kind
  {
    One,         ///< one number of each tuple, that of Selection
    Independent, ///< all components, each by functions of its own
    Dependent    ///< two: colour by the first, opacity by the last; four: red, green and blue, and
                 ///< opacity by the last
  };

  Kind Shown = Kind::One;
  int Components = 1;        ///< that are shown
  int ValueType = 0;         ///< of VTK, of the array
  ScalarSelection Selection; ///< of the first component, or of the number that is shown
  std::string Warning;       ///< one line that says what is not used, or empty

  /// The selection of a component alone.
  ScalarSelection Select(int component) const;
};

/// What is shown of the selected array of the first block that has it, in this order:
///
/// - the number that the selection's VectorMode says, unless it is disabled;
/// - dependent components, if the property's IndependentComponents is off;
/// - the number that VectorMode, VectorComponent and VectorSize of the property's colour function
///   say, or else those of the array's lookup table, if they are not VTK's defaults;
/// - independent components, if there are at most MostComponents and one behind the first has
///   functions that the property did not make by itself;
/// - the first component.
///
/// Throws std::invalid_argument, with one line, if dependent components are not 2 or 4.
ComponentUse FindComponentUse(const std::vector<DataSetBlock>& blocks,
  const ScalarSelection& selection, vtkVolumeProperty* property);

/// Functions of all components that are shown. values: of each component, at all places.
/// maximumError and longestPath as of TransferFunctionFromProperty; error: receives what
/// approximating the functions adds. Throws as TransferFunctionFromProperty, and where a component
/// that is a colour is above LargestColor.
ComponentFunctions ComponentsFromProperty(vtkVolumeProperty* property, const ComponentUse& use,
  const std::vector<const std::vector<double>*>& values, double maximumError, double longestPath,
  double& error);

/// Adds to a key what ComponentsFromProperty reads of the property beyond GetPropertyKey.
void AddComponents(vtkVolumeProperty* property, const ComponentUse& use, CacheKey& key);

/// What a component that is red, green or blue is divided by: the largest value of an integer of 8
/// or 16 bits, as OpenGL's normalized formats have it; 1 of all other types.
double GetLargestChannel(int valueType);

} // namespace tetralux

#endif
