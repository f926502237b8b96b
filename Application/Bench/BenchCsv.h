// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchCsv_h
#define BenchCsv_h

#include "Bench/BenchResults.h"

#include <string>
#include <vector>

/// The results as comma-separated values: a line of names, then one line for each setting in each
/// scene. Times in milliseconds; errors absolute, 0..1; what there is not is empty.
std::string MakeCsv(const std::vector<BenchSceneResult>& results);

#endif
