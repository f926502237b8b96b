// SPDX-License-Identifier: BSD-3-Clause
#include "Compositing/ProcessOrder.h"

#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkIceTCompositePass.h"
#include "vtkImageProcessingPass.h"
#include "vtkMatrix4x4.h"
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
  vtkIceTCompositePass* pass = FindCompositePass(renderer);
  if (!pass || !pass->GetUseOrderedCompositing() || !pass->GetOrderedCompositingHelper())
  {
    return {};
  }
  const int* tiles = pass->GetTileDimensions();
  if (tiles[0] != 1 || tiles[1] != 1)
  {
    return {};
  }
  return pass->GetOrderedCompositingHelper()->ComputeSortOrder(renderer->GetActiveCamera());
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
