// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FunctionSet_h
#define tetralux_FunctionSet_h

#include "TriangleCaster/FunctionLookup.h"
#include "TriangleCaster/ImageOptics.h"

#include <vector>

namespace tetralux
{

/// The functions of one component.
struct PartFunctions
{
  FunctionLookup Function;
  FunctionLookup GradientFunction; ///< of no intervals if there is none
};

/// All functions of ImageOptics. What lookups point to moves with them.
struct FunctionSet
{
  /// Of all components. Where the optics have a table, the first one tells where that has anything.
  std::vector<PartFunctions> Parts;
  FunctionsLookup LabelFunctions;         ///< of label 0, 1 and so on
  FunctionsLookup LabelGradientFunctions; ///< as many, or none

  const PartFunctions& GetFirst() const { return this->Parts.front(); }
};

/// Whether a table takes the place of the function.
inline bool HasTable(const ImageOptics& optics)
{
  return optics.Blend == ImageBlend::Composite && !optics.Table.Entries.empty();
}

/// Throws as MakeIntervalTable and CheckTable.
FunctionSet MakeFunctionSet(const ImageOptics& optics);

} // namespace tetralux

#endif
