// SPDX-License-Identifier: BSD-3-Clause
#ifndef MapperProperties_h
#define MapperProperties_h

#include "Properties/PropertyTable.h"

#include <string>
#include <vector>

class vtkAbstractVolumeMapper;

/// The properties that --set takes: all but those that --array and --component choose. In the order
/// of their names.
std::vector<const tetralux::MapperProperty*> GetSettableProperties();

/// Names of those that a mapper has.
std::vector<std::string> GetPropertyNames(vtkAbstractVolumeMapper* mapper);

/// Names of those of all mappers.
std::vector<std::string> GetPropertyNames();

bool HasProperty(vtkAbstractVolumeMapper* mapper, const std::string& name);

/// Sets a property of a mapper, "Name=Value". Value is a number or a name that the property table
/// has; case, '-' and '_' do not matter. Switches take on, off, true, false, 1 and 0. Throws
/// UsageError that names the mapper's properties, or the values that the property takes.
void SetProperty(vtkAbstractVolumeMapper* mapper, const std::string& assignment);

#endif
