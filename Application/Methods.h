// SPDX-License-Identifier: BSD-3-Clause
#ifndef Methods_h
#define Methods_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkTetrahedraRayCastMapper;

/// Names that --method takes, "auto" first.
std::vector<std::string> GetMethodNames();

/// The method that a name stands for: for auto the best one there is. Throws UsageError.
std::string ResolveMethod(const std::string& name);

/// Properties of the mapper that --set takes: all but those that --array and --component choose.
std::vector<std::string> GetPropertyNames();

/// Sets a property of the mapper as --set asks for: "Name=Value". Throws UsageError that names the
/// properties there are, or the values that the property takes.
void SetProperty(vtkTetrahedraRayCastMapper* mapper, const std::string& assignment);

#endif
