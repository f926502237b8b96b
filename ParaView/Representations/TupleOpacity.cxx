// SPDX-License-Identifier: BSD-3-Clause
#include "TupleOpacity.h"

#include "vtkColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <cmath>
#include <numeric>

namespace tetralux
{

std::function<double(const double*)> MakeTupleOpacity(vtkVolumeProperty* property, int components)
{
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction(0);
  const bool byComponent =
    components == 1 || colors->GetVectorMode() == vtkScalarsToColors::COMPONENT;
  const int component = components == 1 ? 0 : colors->GetVectorComponent();
  return [=](const double* tuple)
  {
    // The magnitude of a scalar would lose its sign.
    const double value = byComponent
      ? tuple[component]
      : std::sqrt(std::inner_product(tuple, tuple + components, tuple, 0.));
    return opacity->GetValue(value);
  };
}

} // namespace tetralux
