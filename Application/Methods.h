// SPDX-License-Identifier: BSD-3-Clause
#ifndef Methods_h
#define Methods_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkTetrahedraVolumeMapper;

/// Names that --method takes, "auto" first.
std::vector<std::string> GetMethodNames();

/// The mapper of a method, for still pictures: one ray a pixel unless something else is set; for
/// "auto" that of the best method there is. numberOfThreads: 0 for as many as there are. Throws
/// UsageError where there is no such method, or where it has no threads to be set.
vtkSmartPointer<vtkTetrahedraVolumeMapper> MakeMapper(
  const std::string& method, int numberOfThreads);

#endif
