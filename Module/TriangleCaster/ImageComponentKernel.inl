// SPDX-License-Identifier: BSD-3-Clause

// The triangle caster for one instruction set: several components, or labels.

#include "TriangleCaster/ComponentsModel.h"
#include "TriangleCaster/DependentModel.h"
#include "TriangleCaster/LabelModel.h"
#include "TriangleCaster/TileCasting.h"

#include <algorithm>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

template <class Value, class Gradients>
ImageKernel ChooseComponents(const ImageKernelInput& in)
{
  if (in.Labels)
  {
    return &CastTile<Value, LabelModel<Value, Gradients>>;
  }
  switch (in.Components)
  {
    case 2:
      return in.Dependent ? &CastTile<Value, DependentModel<Value, 2, Gradients>>
                          : &CastTile<Value, ComponentsModel<Value, 2, Gradients>>;
    case 3:
      return &CastTile<Value, ComponentsModel<Value, 3, Gradients>>;
    default:
      return in.Dependent ? &CastTile<Value, DependentModel<Value, 4, Gradients>>
                          : &CastTile<Value, ComponentsModel<Value, 4, Gradients>>;
  }
}

/// Whether anything depends on gradients.
inline bool UsesGradients(const ImageKernelInput& in)
{
  const auto usesThem = [](const ComponentLookup& part)
  { return part.Lighting || part.GradientTransfer.Count > 0; };
  return in.Lighting || in.GradientTransfer.Count > 0 ||
    (in.Labels && in.Labels->GradientTransfer.Count > 0) ||
    (in.Parts && std::any_of(in.Parts, in.Parts + in.Components, usesThem));
}

ImageKernel ChooseComponentKernel(const ImageKernelInput& in)
{
  return ChooseType(in,
    [&](auto value)
    {
      using Value = decltype(value);
      return UsesGradients(in) ? ChooseComponents<Value, GradientModel<false>>(in)
                               : ChooseComponents<Value, NoGradients>(in);
    });
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
