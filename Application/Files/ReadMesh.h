// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReadMesh_h
#define ReadMesh_h

#include "Files/InputFile.h"

#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <vector>

/// What was read.
struct MeshData
{
  vtkSmartPointer<vtkDataObject> Data;
  std::vector<double> Times; ///< of all time steps of the file; empty: it has no time
  std::size_t TimeStep = 0;  ///< which of them Data is
};

/// Reads a file with all its arrays. Its extension chooses the reader; see GetInputHelp. Files in
/// pieces become one composite data set. Throws WorkError with the file's name, also where the data
/// lack what they say they have.
MeshData ReadMesh(const InputFile& input);

/// Says in one line on standard error that a file has more time steps, if no option chose one.
void NoteTimeSteps(const InputFile& input, const MeshData& mesh);

#endif
