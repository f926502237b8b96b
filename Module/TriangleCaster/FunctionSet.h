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
  std::vector<PartFunctions> Parts;       ///< of all components
  FunctionsLookup LabelFunctions;         ///< of label 0, 1 and so on
  FunctionsLookup LabelGradientFunctions; ///< as many, or none

  const PartFunctions& GetFirst() const { return this->Parts.front(); }
};

/// Throws as MakeIntervalTable.
FunctionSet MakeFunctionSet(const ImageOptics& optics);

} // namespace tetralux

#endif
