// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImagePlacement.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

constexpr int Regions = 3; ///< that two planes cut an axis into

/// The flags of the 27 regions with the order along one axis turned around.
std::uint32_t Flip(std::uint32_t flags, int axis)
{
  std::uint32_t flipped = 0;
  for (int region = 0; region < Regions * Regions * Regions; ++region)
  {
    int place[3] = { region % Regions, region / Regions % Regions, region / (Regions * Regions) };
    place[axis] = Regions - 1 - place[axis];
    const int other = place[0] + Regions * (place[1] + Regions * place[2]);
    flipped |= (flags >> region & 1U) << other;
  }
  return flipped;
}

} // namespace

ImagePlacement PlaceImage(vtkImageData* image)
{
  const double* direction = image->GetDirectionMatrix()->GetData();
  const double* spacing = image->GetSpacing();
  const double* origin = image->GetOrigin();
  const int* extent = image->GetExtent();
  double rows[16] = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1 };
  for (int a = 0; a < 3; ++a)
  {
    rows[4 * a + 3] = origin[a];
    for (int b = 0; b < 3; ++b)
    {
      rows[4 * a + b] = direction[3 * a + b] * spacing[b];
      rows[4 * a + 3] += rows[4 * a + b] * extent[2 * b];
    }
  }
  double inverse[16];
  const double determinant = vtkMatrix4x4::Determinant(rows);
  if (determinant != 0)
  {
    vtkMatrix4x4::Invert(rows, inverse);
  }
  if (determinant == 0 ||
    !std::all_of(inverse, inverse + 16, [](double x) { return std::isfinite(x); }))
  {
    throw std::invalid_argument("the points of the image data do not span a space: is a spacing "
                                "0, or the direction matrix singular?");
  }
  ImagePlacement placement;
  std::copy_n(rows, 12, &placement.DataFromIndex[0][0]);
  std::copy_n(inverse, 12, &placement.IndexFromData[0][0]);
  return placement;
}

void MeasureSteps(const ImagePlacement& placement, vtkMatrix4x4* worldFromData, double steps[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    double step[3] = { 0, 0, 0 };
    for (int a = 0; a < 3; ++a)
    {
      for (int b = 0; b < 3; ++b)
      {
        step[a] += worldFromData->GetElement(a, b) * placement.DataFromIndex[b][axis];
      }
    }
    steps[axis] = std::hypot(step[0], step[1], step[2]);
  }
}

RayGrid ToIndices(const ImagePlacement& placement, const RayGrid& grid)
{
  RayGrid result = grid;
  for (int a = 0; a < 3; ++a)
  {
    const double* row = placement.IndexFromData[a];
    for (int c = 0; c < 4; ++c)
    {
      result.MeshFromWorld[a][c] = c == 3 ? row[3] : 0;
      for (int b = 0; b < 3; ++b)
      {
        result.MeshFromWorld[a][c] += row[b] * grid.MeshFromWorld[b][c];
      }
    }
  }
  return result;
}

RayLimits ToIndices(const ImagePlacement& placement, const RayLimits& limits)
{
  RayLimits result = limits;
  if (!limits.Cropping)
  {
    return result;
  }
  for (int a = 0; a < 3; ++a)
  {
    const double* row = placement.IndexFromData[a];
    for (int b = 0; b < 3; ++b)
    {
      if (b != a && row[b] != 0)
      {
        throw std::invalid_argument("cropping is along the axes of the data, which the image's "
                                    "direction matrix turns: clipping planes may be oblique");
      }
    }
    double* planes = result.CroppingPlanes + 2 * a;
    for (int side = 0; side < 2; ++side)
    {
      planes[side] = row[a] * planes[side] + row[3];
    }
    if (row[a] < 0)
    {
      std::swap(planes[0], planes[1]);
      result.CroppingFlags = Flip(result.CroppingFlags, a);
    }
  }
  return result;
}

} // namespace tetralux
