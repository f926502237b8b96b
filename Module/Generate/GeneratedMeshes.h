// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GeneratedMeshes_h
#define tetralux_GeneratedMeshes_h

#include "Generate/GeneratedMesh.h"
#include "TetraluxCoreModule.h"

#include <map>
#include <string>
#include <vector>

namespace tetralux
{

struct Generator
{
  std::string Name;
  std::string Description;
  std::vector<GeneratorParameter> Parameters;
};

/// Every generator there is, in the order in which they are listed to a user.
TETRALUXCORE_EXPORT const std::vector<Generator>& GetGenerators();

/// Runs a generator; parameters that are not given have their defaults.
/// Throws std::invalid_argument with one line that says what is wrong and what would be right: an
/// unknown name, an unknown parameter, a value out of range.
TETRALUXCORE_EXPORT GeneratedMesh GenerateMesh(
  const std::string& name, const std::map<std::string, double>& parameters = {});

} // namespace tetralux

#endif
