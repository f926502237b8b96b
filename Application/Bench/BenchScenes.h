// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchScenes_h
#define BenchScenes_h

#include "Bench/BenchScene.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

struct BenchOptions;

/// Makes a scene in its turn: meshes and their tables are too large to be kept all at once.
struct BenchSceneMaker
{
  std::string Name;
  bool OfImages;
  std::function<BenchScene()> Make;
};

/// Lists the scenes of a run: that of the user's file, if there is one; small ones for a quick run;
/// else those of the real data, if its folder is known, and the generated ones. If the run is
/// limited to settings of image data, or of cells, so are its scenes. Throws UsageError if an
/// option names another scene, or FindBenchData does.
std::vector<BenchSceneMaker> ListScenes(const BenchOptions& options);

/// Makes a ball of 2.5 cells^3 tetrahedra, for comparisons that need no particular mesh. Its
/// scalars are those of the cells if cellData is set, else those of the points.
BenchScene MakeBallScene(int cells, bool cellData);

/// Makes a scene of a generated mesh, by its name and parameters.
BenchScene MakeGeneratedScene(
  const std::string& generator, const std::map<std::string, double>& parameters);

#endif
