// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchFeatures_h
#define BenchFeatures_h

#include <string>
#include <vector>

struct SceneOptions;

/// What a feature costs: times of frames, best of those measured in turns, seconds.
struct BenchFeature
{
  std::string Name;
  std::string Plain; ///< the scene that does not use it
  std::string
    Forced;         ///< how it is made to be computed though it changes nothing; empty: it can't be
  std::string Used; ///< the scene that uses it

  std::string LeftOut; ///< what the mapper left out of the plain frame only, and why

  double PlainSeconds;
  double ForcedSeconds; ///< not a number where it can't be
  double UsedSeconds;

  /// Largest difference of the forced picture to the plain one: what is forced changes nothing.
  double ForcedDifference;
};

/// Measures each feature: without it, with it though the scene does not need it, where that can be
/// had, and used. view: size and threads; frames: of each; quick: with small meshes.
std::vector<BenchFeature> MeasureFeatures(const SceneOptions& view, int frames, bool quick);

#endif
