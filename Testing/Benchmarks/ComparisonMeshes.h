// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ComparisonMeshes_h
#define tetralux_ComparisonMeshes_h

#include "Mesh/TetrahedralMesh.h"
#include "View/RayGrid.h"

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace tetralux
{

/// A mesh that a comparison runs on.
struct ComparisonMesh
{
  std::string Name;
  TetrahedralMesh Mesh;        ///< in the order of its source
  std::vector<double> Scalars; ///< one for each point, 0..1
};

/// One of the generators, with its number of tetrahedra in the name.
ComparisonMesh MakeComparisonMesh(
  const std::string& generator, const std::map<std::string, double>& parameters = {});

/// The blunt fin of the folder that the environment variable TETRALUX_DATA names; none, and a line
/// on standard error, where it is not set.
std::vector<ComparisonMesh> ReadBluntFin();

/// The scalars of a mesh's points after it was cleaned or reordered.
std::vector<double> MapScalars(const TetrahedralMesh& mesh, const std::vector<double>& original);

/// The rays of a perspective camera, 30 degrees wide, that sees the whole bounding sphere.
struct PerspectiveView
{
  PerspectiveView(const double center[3], double radius, int size);

  RayGrid Grid;
  std::array<double, 3> Position, Right, Up, Forward;
  double Pixel; ///< width of a pixel at distance 1
};

/// Processor time of this process, in seconds: on a machine that others use, too, it says more than
/// the clock.
double GetProcessorTime();

/// The least processor time of some runs: what was not disturbed.
template <class Function>
double MeasureBest(int runs, Function function)
{
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < runs; ++i)
  {
    const double begin = GetProcessorTime();
    function();
    const double seconds = GetProcessorTime() - begin;
    best = seconds < best ? seconds : best;
  }
  return best;
}

} // namespace tetralux

#endif
