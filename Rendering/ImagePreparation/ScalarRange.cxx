// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ScalarRange.h"

#include "Intake/ScalarExtraction.h"

#include "vtkDataArray.h"

namespace tetralux
{

std::array<double, 2> FindScalarRange(const SelectedArray& scalars)
{
  std::array<double, 2> range{};
  scalars.Array->GetFiniteRange(range.data(), scalars.Magnitude ? -1 : scalars.Component);
  const double least = range[0] <= range[1] ? range[0] : 0;
  return { least, range[0] < range[1] ? range[1] : least + 1 };
}

} // namespace tetralux
