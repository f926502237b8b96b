// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImageObstacles.h"

#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkPiecewiseFunction.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

namespace tetralux
{
namespace
{

constexpr int DisabledVectorMode = -1; ///< of ScalarSelection

bool HasFlags(vtkUnsignedCharArray* ghosts)
{
  if (!ghosts)
  {
    return false;
  }
  const auto flags = vtk::DataArrayValueRange(ghosts);
  return std::any_of(flags.begin(), flags.end(), [](unsigned char flag) { return flag != 0; });
}

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
  if (HasFlags(image->GetPointGhostArray()) || HasFlags(image->GetCellGhostArray()))
  {
    return "the triangle caster does not know ghost, hidden and blanked points and cells; the "
           "image data have some";
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

bool HasGradientOpacity(vtkVolumeProperty* property)
{
  if (property->GetDisableGradientOpacity(0) != 0 || !property->HasGradientOpacity(0))
  {
    return false;
  }
  vtkPiecewiseFunction* function = property->GetGradientOpacity(0);
  double node[4];
  for (int i = 0; i < function->GetSize(); ++i)
  {
    function->GetNodeValue(i, node);
    if (node[1] != 1)
    {
      return true;
    }
  }
  return false;
}

std::string DescribeUnused(
  vtkVolumeProperty* property, ImageBlend blend, int numberOfComponents, int vectorMode)
{
  std::string unused;
  const auto add = [&unused](bool isUnused, const char* text)
  { unused += isUnused ? (unused.empty() ? "" : "; ") + std::string(text) : ""; };
  add(blend != ImageBlend::Composite && property->GetShade(0) != 0,
    "Shade is not used: there is light with composite blending only");
  add(blend != ImageBlend::Composite && HasGradientOpacity(property),
    "gradient opacity is not used: composite blending has it only");
  add(property->GetNumberOfLabels() > 0, "functions of labels are not used");
  add(numberOfComponents > 1 && vectorMode == DisabledVectorMode,
    property->GetIndependentComponents() != 0
      ? "independent components are not used but the first one; VectorMode chooses another"
      : "dependent components are not used but the first one; VectorMode chooses another");
  return unused;
}

} // namespace tetralux
