// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraOpenGLMapper.h"

//------------------------------------------------------------------------------------------------
vtkTetrahedraOpenGLMapper::vtkTetrahedraOpenGLMapper() = default;

//------------------------------------------------------------------------------------------------
vtkTetrahedraOpenGLMapper::~vtkTetrahedraOpenGLMapper() = default;
