// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchFeatures_h
#define BenchFeatures_h

#include <string>
#include <vector>

struct SceneOptions;

/// What a feature costs: best times of frames, in seconds, measured in turns.
struct BenchFeature
{
  std::string Name;
  std::string Plain;  ///< the scene that does not use it
  std::string Forced; ///< how it is computed although it changes nothing; empty: not possible
  std::string Used;   ///< the scene that uses it

  std::string LeftOut; ///< what the mapper left out of the plain frame only, and why

  double PlainSeconds;
  double ForcedSeconds; ///< not a number if not possible
  double UsedSeconds;

  /// Largest difference between the forced picture and the plain one, 0..1.
  double ForcedDifference;
};

/// Measures each feature in three cases: the scene does not use it, the feature is forced, the
/// scene uses it. view: size and threads. frames: number for each case. quick: with small meshes.
std::vector<BenchFeature> MeasureFeatures(const SceneOptions& view, int frames, bool quick);

#endif
