// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchPage_h
#define BenchPage_h

#include "Bench/BenchResults.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

/// Returns the results as one page of HTML that needs no other file: page.html with the JSON of
/// MakeResults and the small pictures of the rows in it.
std::string MakePage(
  const nlohmann::ordered_json& results, const std::vector<BenchSceneResult>& scenes);

#endif
