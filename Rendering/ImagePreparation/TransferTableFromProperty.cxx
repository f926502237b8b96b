// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/TransferTableFromProperty.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkVolumeProperty.h"

#include <stdexcept>

namespace tetralux
{
namespace
{

/// Gradients up to this share of the range of the scalars, over the mean spacing, have rows.
constexpr double LargestGradient = 0.25;

constexpr int Channels = 4; ///< red, green, blue and opacity

/// First and last of n texels, at their centres, over 0 to size.
void PlaceTexels(int n, double size, double& first, double& last)
{
  first = 0.5 / n * size;
  last = (n - 0.5) / n * size;
}

} // namespace

TransferTable TransferTableFromProperty(
  vtkVolumeProperty* property, const std::array<double, 2>& scalars)
{
  TransferTable table;
  if (property->GetTransferFunctionMode() != vtkVolumeProperty::TF_2D)
  {
    return table;
  }
  vtkImageData* image = property->GetTransferFunction2D();
  vtkDataArray* array = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!array || array->GetNumberOfComponents() != Channels)
  {
    throw std::invalid_argument("the property's TransferFunctionMode is TF_2D, but it has no "
                                "TransferFunction2D with scalars of 4 components");
  }
  table.Columns = image->GetDimensions()[0];
  table.Rows = image->GetDimensions()[1];
  const double width = scalars[1] - scalars[0];
  PlaceTexels(table.Columns, width, table.FirstScalar, table.LastScalar);
  table.FirstScalar += scalars[0];
  table.LastScalar += scalars[0];
  PlaceTexels(table.Rows, LargestGradient * width, table.FirstLength, table.LastLength);
  table.Entries.resize(static_cast<std::size_t>(table.Columns) * table.Rows);
  for (std::size_t i = 0; i < table.Entries.size(); ++i)
  {
    double tuple[Channels];
    array->GetTuple(static_cast<vtkIdType>(i), tuple);
    for (int c = 0; c < 3; ++c)
    {
      table.Entries[i].Color[c] = static_cast<float>(tuple[c]);
    }
    table.Entries[i].Opacity = static_cast<float>(tuple[3]);
  }
  return table;
}

} // namespace tetralux
