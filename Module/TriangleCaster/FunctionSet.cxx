// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/FunctionSet.h"

#include "TriangleCaster/TransferTableEvaluation.h"

#include <algorithm>
#include <utility>

namespace tetralux
{
namespace
{

/// Gradient opacities without nodes are 1 instead; none at all if all are without.
std::vector<TransferFunction> CompleteGradientOpacities(std::vector<TransferFunction> functions)
{
  const auto isNone = [](const TransferFunction& function) { return function.Nodes.empty(); };
  const auto some = std::find_if_not(functions.begin(), functions.end(), isNone);
  if (some == functions.end())
  {
    return {};
  }
  const TransferFunction::Value one = { { 0, 0, 0 }, 1 };
  const TransferFunction constant = { { { some->Nodes.front().Scalar, one, one } } };
  std::replace_if(functions.begin(), functions.end(), isNone, constant);
  return functions;
}

PartFunctions MakePartFunctions(
  const TransferFunction& function, const TransferFunction& gradientOpacity)
{
  PartFunctions part;
  part.Function.Set(function);
  if (!gradientOpacity.Nodes.empty())
  {
    part.GradientFunction.Set(gradientOpacity);
  }
  return part;
}

} // namespace

FunctionSet MakeFunctionSet(const ImageOptics& optics)
{
  FunctionSet set;
  if (HasTable(optics))
  {
    CheckTable(optics.Table);
    set.Parts.push_back(
      MakePartFunctions(FindVisibleScalars(optics.Table), optics.GradientOpacity));
  }
  else
  {
    set.Parts.push_back(MakePartFunctions(optics.Function, optics.GradientOpacity));
  }
  for (const ComponentOptics& other : optics.OtherComponents)
  {
    set.Parts.push_back(MakePartFunctions(other.Function, other.GradientOpacity));
  }
  if (!optics.Labels.empty())
  {
    std::vector<TransferFunction> functions{ optics.Function };
    std::vector<TransferFunction> gradientOpacities{ optics.GradientOpacity };
    for (const LabelOptics& label : optics.Labels)
    {
      functions.push_back(label.Function);
      gradientOpacities.push_back(label.GradientOpacity);
    }
    set.LabelFunctions.Set(std::move(functions));
    set.LabelGradientFunctions.Set(CompleteGradientOpacities(std::move(gradientOpacities)));
  }
  return set;
}

} // namespace tetralux
