// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchScenes_h
#define BenchScenes_h

#include "vtkSmartPointer.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

struct BenchOptions;
class vtkUnstructuredGrid;
class vtkVolumeProperty;

/// What is rendered: the same tetrahedra, with the same scalars, by every method.
struct BenchScene
{
  std::string Name;        ///< of files and of --scene, as "blunt-fin-needle"
  std::string Description; ///< one line

  /// Tetrahedra with one active array of one component, of the points or of the cells.
  vtkSmartPointer<vtkUnstructuredGrid> Mesh;
  bool CellData = false;
  vtkSmartPointer<vtkVolumeProperty> Property;
};

/// A scene that is made when it is its turn: meshes and their tables are large.
struct BenchSceneMaker
{
  std::string Name;
  std::function<BenchScene()> Make;
};

/// The scenes of a run: that of the user's file; else those of the real data, where its folder is
/// known, and the generated ones; small ones for a quick run. Throws UsageError for a name that is
/// none of theirs.
std::vector<BenchSceneMaker> ListScenes(const BenchOptions& options);

/// A ball, or with cellData one of which each cell has a scalar, of 2.5 cells^3 tetrahedra, for
/// comparisons that need a mesh of no particular kind. It is convex but for its facets.
BenchScene MakeBallScene(int cells, bool cellData);

/// A generated mesh by its name and parameters.
BenchScene MakeGeneratedScene(
  const std::string& generator, const std::map<std::string, double>& parameters);

#endif
