// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GeneratedMeshes_h
#define tetralux_GeneratedMeshes_h

#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"

#include <map>
#include <string>
#include <vector>

namespace tetralux
{

/// A mesh made from a formula, for demonstrations, tests and benchmarks.
struct GeneratedMesh
{
  TetrahedralMesh Mesh;
  std::vector<double> Scalars; ///< one for each point; a smooth field worth looking at
};

/// One numeric parameter of a generator.
struct GeneratorParameter
{
  std::string Name;
  double Default;
  double Minimum;
  double Maximum;
  std::string Description; ///< meaning and unit
};

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
