// SPDX-License-Identifier: BSD-3-Clause
#ifndef MapperProperties_h
#define MapperProperties_h

#include <string>
#include <vector>

class vtkTetrahedraVolumeMapper;

/// Properties of a mapper that --set takes: all but those that --array and --component choose.
std::vector<std::string> GetPropertyNames(vtkTetrahedraVolumeMapper* mapper);

/// Those of all mappers.
std::vector<std::string> GetPropertyNames();

bool HasProperty(vtkTetrahedraVolumeMapper* mapper, const std::string& name);

/// Sets a property of the mapper as --set asks for: "Name=Value". Throws UsageError that names the
/// properties there are, or the values that the property takes.
void SetProperty(vtkTetrahedraVolumeMapper* mapper, const std::string& assignment);

#endif
