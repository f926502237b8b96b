// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImageObstacles.h"

#include "ImagePreparation/ImageFunctions.h"
#include "TriangleCaster/ImageVolume.h"

#include "vtkImageData.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

namespace tetralux
{
namespace
{

constexpr int DisabledVectorMode = -1; ///< of ScalarSelection

} // namespace

std::string FindObstacle(vtkDataObject* data, const ScalarSelection& selection)
{
  if (!data)
  {
    return "there is no input";
  }
  auto* image = vtkImageData::SafeDownCast(data);
  if (!image)
  {
    return std::string("the triangle caster renders vtkImageData; this is a ") +
      data->GetClassName();
  }
  int size[3];
  image->GetDimensions(size);
  if (*std::min_element(size, size + 3) < 2)
  {
    return "the image data have " + std::to_string(size[0]) + " x " + std::to_string(size[1]) +
      " x " + std::to_string(size[2]) + " points; a volume has at least 2 along each axis";
  }
  const SelectedArray selected = FindSelectedArray(image, selection);
  if (!selected.Error.empty())
  {
    return selected.Error;
  }
  if (selected.CellData)
  {
    return "the triangle caster renders scalars at points; these are at cells";
  }
  return "";
}

std::string FindObstacle(vtkVolumeProperty* property, ImageBlend blend)
{
  if (property->GetTransferFunctionMode() == vtkVolumeProperty::TF_2D &&
    blend != ImageBlend::Composite)
  {
    return "the property's TransferFunctionMode is TF_2D, which composite blending has only";
  }
  return "";
}

std::string DescribeUnused(vtkVolumeProperty* property, ImageBlend blend, int arrayComponents,
  int vectorMode, bool hasLabels)
{
  std::string unused;
  const auto add = [&unused](bool isUnused, const char* text)
  { unused += isUnused ? (unused.empty() ? "" : "; ") + std::string(text) : ""; };
  add(blend != ImageBlend::Composite && blend != ImageBlend::Isosurfaces &&
      property->GetShade(0) != 0,
    "Shade is not used: there is light with composite and isosurface blending only");
  add(blend != ImageBlend::Composite && HasGradientOpacity(property, 0),
    "gradient opacity is not used: composite blending has it only");
  add(property->GetNumberOfLabels() > 0 && !hasLabels,
    "functions of labels are not used: they need a MaskInput, and MaskType label-map");
  add(arrayComponents > ImageVolume::MostComponents && vectorMode == DisabledVectorMode,
    "components are not used but the first one, since there are more than 4; VectorMode chooses "
    "another");
  return unused;
}

} // namespace tetralux
