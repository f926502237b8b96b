// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchSettings_h
#define BenchSettings_h

#include "Bench/BenchSetting.h"

#include <vector>

struct BenchOptions;
struct BenchScene;

/// Name of the setting that all others are compared with: all defaults.
constexpr const char* DefaultSettingName = "default";

/// Name of the setting that counts as right.
constexpr const char* ReferenceSettingName = "reference";

/// What a scene's settings are measured against: the integral along rays, which is no mapper's.
BenchSetting GetReferenceSetting(const BenchScene& scene);

/// What the user's settings render.
enum class BenchData
{
  Any, ///< there are none
  Cells,
  Images
};

/// Throws UsageError if one of the user's settings is wrong, or if there are some of both kinds.
BenchData FindBenchData(const BenchOptions& options);

/// The settings of a scene, the default one first. The user's must be right.
std::vector<BenchSetting> ListSettings(const BenchOptions& options, const BenchScene& scene);

#endif
