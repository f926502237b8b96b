// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchSettings_h
#define BenchSettings_h

#include "Bench/BenchSetting.h"

#include <vector>

struct BenchOptions;

/// Name of the setting that all others are compared with: all defaults.
constexpr const char* DefaultSettingName = "default";

/// Name of the setting that counts as right.
constexpr const char* ReferenceSettingName = "reference";

/// The most exact setting: closed form, double precision, rays to their ends.
BenchSetting GetReferenceSetting();

/// The settings of a run, the default one first. Throws UsageError if one of the user's is wrong.
std::vector<BenchSetting> ListSettings(const BenchOptions& options);

#endif
