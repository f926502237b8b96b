// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GeneratedMesh_h
#define tetralux_GeneratedMesh_h

#include "Mesh/TetrahedralMesh.h"

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

} // namespace tetralux

#endif
