// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshFormats_h
#define MeshFormats_h

#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h"

#include <string>

/// Makes VTK's reader of one file that reads all arrays. extension chooses it, as ".vtu".
/// plot3dSolution: as in InputFile. Throws WorkError with the file's name for a file of another
/// format, and for a format that VTK does not read: the line names a tool that converts it.
vtkSmartPointer<vtkAlgorithm> MakeMeshReader(
  const std::string& fileName, const std::string& extension, const std::string& plot3dSolution);

/// Lists the extensions and formats that can be read, for the help texts.
std::string GetInputHelp();

#endif
