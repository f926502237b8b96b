// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchPage_h
#define BenchPage_h

#include "Bench/BenchFeatures.h"
#include "Bench/BenchResults.h"

#include <string>
#include <utility>
#include <vector>

/// The results as one page of HTML that needs nothing beside it: charts and small pictures are in
/// it, the names of the files in the folder too. machine: from DescribeMachine; features: empty where
/// they were not measured; command: what was run.
std::string MakePage(const std::vector<BenchSceneResult>& results,
  const std::vector<BenchFeature>& features,
  const std::vector<std::pair<std::string, std::string>>& machine, const std::string& command);

#endif
