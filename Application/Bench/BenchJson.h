// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchJson_h
#define BenchJson_h

#include "Bench/BenchFeatures.h"
#include "Bench/BenchResults.h"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

/// Returns the results of a run as JSON: title, command, machine, scenes with their settings,
/// features. Times are in milliseconds, errors absolute from 0 to 1. A missing number is null. A
/// setting that failed has the member failure instead of numbers.
///
/// machine: from DescribeMachine. features: empty if they were not measured. command: what was run.
nlohmann::ordered_json MakeResults(const std::vector<BenchSceneResult>& results,
  const std::vector<BenchFeature>& features,
  const std::vector<std::pair<std::string, std::string>>& machine, const std::string& command);

#endif
