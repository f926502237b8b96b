// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/MapperFrame.h"

#include "View/ViewKey.h"

#include "vtkAbstractMapper.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// Frames that are to take less than this belong to an interaction, seconds.
constexpr double InteractiveSeconds = 1;

/// The inverse of a volume's matrix.
void SetMeshFromWorld(vtkVolume* volume, double meshFromWorld[3][4])
{
  const double* rows = volume->GetMatrix()->GetData();
  if (rows[12] != 0 || rows[13] != 0 || rows[14] != 0 || rows[15] == 0)
  {
    throw std::invalid_argument("the volume's matrix is not affine: its last row must be 0 0 0 1");
  }
  const double determinant = vtkMatrix4x4::Determinant(rows);
  double inverse[16];
  if (determinant != 0)
  {
    vtkMatrix4x4::Invert(rows, inverse);
  }
  const auto isFinite = [](double x) { return std::isfinite(x); };
  if (determinant == 0 || !std::all_of(inverse, inverse + 16, isFinite))
  {
    throw std::invalid_argument(
      "the volume's matrix has no inverse: is a scale of the volume 0, or not a number?");
  }
  std::copy_n(inverse, 12, &meshFromWorld[0][0]);
}

Span<float> GetArray(vtkImageData* image, const char* name, int components)
{
  vtkPointData* pointData = image->GetPointData();
  const vtkIdType size = image->GetNumberOfPoints();
  auto* array = vtkFloatArray::SafeDownCast(pointData->GetArray(name));
  if (!array || array->GetNumberOfTuples() != size)
  {
    vtkNew<vtkFloatArray> fresh;
    fresh->SetName(name);
    fresh->SetNumberOfComponents(components);
    fresh->SetNumberOfTuples(size);
    fresh->FillValue(0); // an observer may look at it before it is drawn
    pointData->AddArray(fresh);
    array = fresh;
  }
  array->Modified();
  return { array->GetPointer(0), static_cast<std::size_t>(array->GetNumberOfValues()) };
}

} // namespace

void MapperFrame::ReportOmission(bool omitted, const char* feature, const char* reason)
{
  if (omitted)
  {
    this->LeftOut[feature] = reason;
  }
}

RayGrid MapperFrame::MakeGrid(const CameraRays& rays) const
{
  RayGrid grid = rays.GetGrid();
  SetMeshFromWorld(this->Volume, grid.MeshFromWorld);
  return grid;
}

RayLimits MapperFrame::MakeLimits(const CameraRays& rays) const
{
  RayLimits limits;
  rays.AddClippingRange(limits);
  limits.Planes.insert(limits.Planes.end(), this->Settings.ClippingPlanes.begin(),
    this->Settings.ClippingPlanes.end());
  limits.Cropping = this->Settings.Cropping;
  std::copy_n(this->Settings.CroppingRegionPlanes, 6, limits.CroppingPlanes);
  limits.CroppingFlags = this->Settings.CroppingRegionFlags;
  return limits;
}

void MapperFrame::AddViewToKey(const CameraRays& rays, const RayGrid& grid, const RayLimits& limits)
{
  const PixelRectangle& visible = rays.GetVisible();
  const DepthMap depths = rays.GetDepthMap();
  AddNumbersTo(
    this->Key, std::array<int, 4>{ visible.X, visible.Y, visible.Width, visible.Height });
  AddRaysTo(this->Key, grid);
  AddLimitsTo(this->Key, limits);
  AddNumbersTo(this->Key, depths.Depth);
  AddNumbersTo(this->Key, depths.Divisor);
  // How long a frame may take decides how right it is.
  this->Key.Add(this->IsInteractive());
}

bool MapperFrame::IsInteractive() const
{
  return this->Volume->GetAllocatedRenderTime() < InteractiveSeconds;
}

bool MapperFrame::HasOpaqueGeometry() const
{
  // Nothing opaque was drawn before, unless by a render pass, which counts elsewhere, or by another
  // renderer of which this one keeps the depths.
  return this->Settings.IntermixIntersectingGeometry &&
    (this->Renderer->GetNumberOfPropsRendered() > 0 || this->Renderer->GetPass() ||
      this->Renderer->GetPreserveDepthBuffer());
}

void MapperFrame::MakeEmptyPicture(const CameraRays& rays) const
{
  const PixelRectangle& visible = rays.GetVisible();
  if (visible.Width == 0)
  {
    this->Image->Initialize();
    return;
  }
  constexpr float NoDistance = -1;
  Span<float> colors, depths;
  PrepareImage(this->Image, visible.Width, visible.Height, colors, depths);
  std::fill(colors.begin(), colors.end(), 0.f);
  std::fill(depths.begin(), depths.end(), NoDistance);
}

void MapperFrame::PrepareImage(
  vtkImageData* image, int width, int height, Span<float>& colors, Span<float>& depths)
{
  image->SetDimensions(width, height, 1);
  colors = GetArray(image, "RGBA", 4);
  depths = GetArray(image, "Depth", 1);
  image->GetPointData()->SetActiveScalars("RGBA");
}

std::vector<std::array<double, 4>> GetClippingPlanes(vtkAbstractMapper* mapper)
{
  std::vector<std::array<double, 4>> result;
  vtkPlaneCollection* planes = mapper->GetClippingPlanes();
  for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
  {
    vtkPlane* plane = planes->GetItem(i);
    const double* normal = plane->GetNormal();
    result.push_back(
      { normal[0], normal[1], normal[2], -vtkMath::Dot(normal, plane->GetOrigin()) });
  }
  return result;
}

} // namespace tetralux
