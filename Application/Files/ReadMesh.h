// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReadMesh_h
#define ReadMesh_h

#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <string>

/// Reads a file. Its extension chooses the reader; see GetInputHelp. Reads all arrays, and of a
/// time series the first step. Throws WorkError with the file's name.
///
/// A PLOT3D grid is one file with the coordinates and one with the solution. fileName may be both
/// with a comma between, or plot3dSolution is the second; it is empty for all other files.
vtkSmartPointer<vtkDataObject> ReadMesh(
  const std::string& fileName, const std::string& plot3dSolution);

/// Lists the extensions and formats that can be read, for the help texts.
std::string GetInputHelp();

#endif
