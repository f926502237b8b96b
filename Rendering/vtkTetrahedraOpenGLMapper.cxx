// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraOpenGLMapper.h"

namespace
{

constexpr const char* EveryPixel = "every pixel is drawn; vtkTetrahedraRayCastMapper has it";

} // namespace

//------------------------------------------------------------------------------------------------
vtkTetrahedraOpenGLMapper::vtkTetrahedraOpenGLMapper() = default;

//------------------------------------------------------------------------------------------------
vtkTetrahedraOpenGLMapper::~vtkTetrahedraOpenGLMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraOpenGLMapper::SetImageSampleDistance(float distance)
{
  if (distance != 1)
  {
    this->WarnOfCall("ImageSampleDistance", EveryPixel);
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraOpenGLMapper::SetMinimumImageSampleDistance(float distance)
{
  if (distance != 1)
  {
    this->WarnOfCall("MinimumImageSampleDistance", EveryPixel);
  }
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraOpenGLMapper::SetAutoAdjustSampleDistances(vtkTypeBool adjust)
{
  if (adjust)
  {
    this->WarnOfCall("AutoAdjustSampleDistances", EveryPixel);
  }
}
