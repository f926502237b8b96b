// SPDX-License-Identifier: BSD-3-Clause
#include "ClippingPlanes.h"

#include "vtkAbstractTransform.h"
#include "vtkBox.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlane.h"

#include <algorithm>

namespace tetralux
{

namespace
{

/// A plane function is linear: its gradient and one value say all, whatever offsets and transforms
/// it has.
void AddPlane(vtkPlane* function, vtkPlaneCollection* planes)
{
  double origin[3] = { 0, 0, 0 };
  double normal[3];
  function->FunctionGradient(origin, normal);
  const double value = function->FunctionValue(origin);
  const double length = vtkMath::Norm(normal);
  if (!(length > 0))
  {
    return;
  }
  vtkNew<vtkPlane> plane;
  const double scale = value / (length * length);
  plane->SetOrigin(-scale * normal[0], -scale * normal[1], -scale * normal[2]);
  plane->SetNormal(-normal[0] / length, -normal[1] / length, -normal[2] / length);
  planes->AddItem(plane);
}

/// The six sides of a box, which the box's transform leads to from the world.
void AddSides(vtkBox* box, vtkPlaneCollection* planes)
{
  double bounds[6];
  box->GetBounds(bounds);
  vtkAbstractTransform* fromBox = box->GetTransform() ? box->GetTransform()->GetInverse() : nullptr;
  double center[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
  }
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    double corners[3][3];
    for (int i = 0; i < 3; ++i)
    {
      std::copy_n(center, 3, corners[i]);
      corners[i][axis] = bounds[side];
    }
    // Three points of the side span it in the world, too.
    corners[1][(axis + 1) % 3] = bounds[2 * ((axis + 1) % 3) + 1];
    corners[2][(axis + 2) % 3] = bounds[2 * ((axis + 2) % 3) + 1];
    double inside[3];
    std::copy_n(center, 3, inside);
    if (fromBox)
    {
      for (auto& corner : corners)
      {
        fromBox->TransformPoint(corner, corner);
      }
      fromBox->TransformPoint(inside, inside);
    }
    double u[3], v[3], inward[3], normal[3];
    vtkMath::Subtract(corners[1], corners[0], u);
    vtkMath::Subtract(corners[2], corners[0], v);
    vtkMath::Subtract(inside, corners[0], inward);
    vtkMath::Cross(u, v, normal);
    if (vtkMath::Normalize(normal) == 0)
    {
      continue;
    }
    if (vtkMath::Dot(normal, inward) < 0)
    {
      vtkMath::MultiplyScalar(normal, -1);
    }
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(corners[0]);
    plane->SetNormal(normal);
    planes->AddItem(plane);
  }
}

} // namespace

vtkSmartPointer<vtkPlaneCollection> MakeClippingPlanes(vtkImplicitFunction* function)
{
  auto planes = vtkSmartPointer<vtkPlaneCollection>::New();
  if (auto* plane = vtkPlane::SafeDownCast(function))
  {
    AddPlane(plane, planes);
  }
  else if (auto* box = vtkBox::SafeDownCast(function))
  {
    AddSides(box, planes);
  }
  return planes;
}

} // namespace tetralux
