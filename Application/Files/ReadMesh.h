// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReadMesh_h
#define ReadMesh_h

#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <string>

/// Reads a file that VTK has a reader for, by its extension: see GetInputHelp.
///
/// A PLOT3D grid is one file with the coordinates and one with the solution. Both may be given as
/// fileName with a comma between, or the second as plot3dSolution, which else is empty.
///
/// All arrays are read; of a time series, the first step. Throws WorkError with the file's name.
vtkSmartPointer<vtkDataObject> ReadMesh(
  const std::string& fileName, const std::string& plot3dSolution);

/// What can be read, for the help texts.
std::string GetInputHelp();

#endif
