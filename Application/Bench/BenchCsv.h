// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchCsv_h
#define BenchCsv_h

#include <nlohmann/json_fwd.hpp>

#include <string>

/// Returns the results of MakeResults as comma-separated values (RFC 4180): a line of names, then
/// one line for each setting in each scene. A missing value is empty.
std::string MakeCsv(const nlohmann::ordered_json& results);

#endif
