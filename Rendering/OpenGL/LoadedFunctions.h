// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LoadedFunctions_h
#define tetralux_LoadedFunctions_h

/// OpenGL's functions, as VTK loads them: by GLAD since VTK 9.4, by GLEW before.
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
