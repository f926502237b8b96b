// SPDX-License-Identifier: BSD-3-Clause
#include "Compositing/ProcessOrder.h"

#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkIceTCompositePass.h"
#include "vtkImageProcessingPass.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOrderedCompositingHelper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

namespace tetralux
{

namespace
{

/// The one inside of the passes that a view puts around it.
vtkIceTCompositePass* FindCompositePass(vtkRenderer* renderer)
{
  vtkRenderPass* pass = renderer->GetPass();
  while (pass)
  {
    if (auto* found = vtkIceTCompositePass::SafeDownCast(pass))
    {
      return found;
    }
    if (auto* camera = vtkCameraPass::SafeDownCast(pass))
    {
      pass = camera->GetDelegatePass();
    }
    else if (auto* image = vtkImageProcessingPass::SafeDownCast(pass))
    {
      pass = image->GetDelegatePass();
    }
    else
    {
      return nullptr;
    }
  }
  return nullptr;
}

/// What orders processes, if ParaView composites them in order and for one display.
vtkOrderedCompositingHelper* FindOrderingHelper(vtkRenderer* renderer)
{
  vtkIceTCompositePass* pass = FindCompositePass(renderer);
  if (!pass || !pass->GetUseOrderedCompositing())
  {
    return nullptr;
  }
  const int* tiles = pass->GetTileDimensions();
  return tiles[0] == 1 && tiles[1] == 1 ? pass->GetOrderedCompositingHelper() : nullptr;
}

} // namespace

void LetAllProcessesDraw(vtkRenderer* renderer)
{
  // The view's own key for this has no effect where a representation asks for an order, too.
  if (vtkIceTCompositePass* pass = FindCompositePass(renderer))
  {
    pass->SetRenderEmptyImages(true);
  }
}

std::vector<int> FindProcessOrder(vtkRenderer* renderer)
{
  vtkOrderedCompositingHelper* helper = FindOrderingHelper(renderer);
  return helper ? helper->ComputeSortOrder(renderer->GetActiveCamera()) : std::vector<int>();
}

std::vector<int> FindProcessOrder(vtkRenderer* renderer, vtkMatrix4x4* toWorld)
{
  vtkOrderedCompositingHelper* helper = FindOrderingHelper(renderer);
  if (!helper)
  {
    return {};
  }
  const std::array<double, 4> eye = FindEye(renderer, toWorld);
  if (eye[3] == 0)
  {
    const double away[3] = { -eye[0], -eye[1], -eye[2] };
    return helper->ComputeSortOrderInViewDirection(away);
  }
  return helper->ComputeSortOrderFromPosition(eye.data());
}

std::array<double, 4> FindEye(vtkRenderer* renderer, vtkMatrix4x4* toWorld)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  std::array<double, 4> eye{};
  if (camera->GetParallelProjection())
  {
    const double* away = camera->GetDirectionOfProjection();
    eye = { -away[0], -away[1], -away[2], 0 };
  }
  else
  {
    camera->GetPosition(eye.data());
    eye[3] = 1;
  }
  vtkNew<vtkMatrix4x4> toData;
  vtkMatrix4x4::Invert(toWorld, toData);
  toData->MultiplyPoint(eye.data(), eye.data());
  return eye;
}

std::array<double, 2> FindPictureOrigin(vtkRenderer* renderer)
{
  vtkMatrix4x4* projection = renderer->GetActiveCamera()->GetExplicitProjectionTransformMatrix();
  if (!projection)
  {
    return { 0, 0 };
  }
  // Moving a picture adds a multiple of the last row to the first ones.
  const double* last = projection->Element[3];
  const int* size = renderer->GetRenderWindow()->GetActualSize();
  std::array<double, 2> origin;
  for (int axis = 0; axis < 2; ++axis)
  {
    double along = 0, square = 0;
    for (int i = 0; i < 4; ++i)
    {
      along += projection->Element[axis][i] * last[i];
      square += last[i] * last[i];
    }
    origin[axis] = -0.5 * size[axis] * along / square; // of 2, which the window is wide
  }
  return origin;
}

} // namespace tetralux
