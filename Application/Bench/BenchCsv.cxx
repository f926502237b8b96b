// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchCsv.h"

#include "CommandLine/OptionValues.h"

#include <nlohmann/json.hpp>

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* LineEnd = "\r\n";

/// Members of a setting, in the order of the columns; the scene's name comes before them.
constexpr const char* Columns[] = { "method", "setting", "properties", "largest_error", "rms_error",
  "error_99.9", "share_above_1/255", "error_estimate", "best_ms", "median_ms", "frames",
  "prepare_ms", "bytes", "bits", "pareto", "failure" };

std::string Quote(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted += c;
    if (c == '"')
    {
      quoted += c; // a quote is written twice
    }
  }
  return quoted + "\"";
}

std::string Format(const Json& value)
{
  switch (value.type())
  {
    case Json::value_t::null:
      return "";
    case Json::value_t::string:
      return Quote(value.get<std::string>());
    case Json::value_t::boolean:
      return value.get<bool>() ? "1" : "0";
    case Json::value_t::number_float:
    {
      const auto number = value.get<double>();
      return std::isnan(number) ? "" : FormatNumber(number);
    }
    default:
      return value.dump();
  }
}

} // namespace

std::string MakeCsv(const Json& results)
{
  std::string text = "scene";
  for (const char* column : Columns)
  {
    text += std::string(",") + column;
  }
  text += LineEnd;
  for (const Json& scene : results.at("scenes"))
  {
    for (const Json& row : scene.at("settings"))
    {
      text += Format(scene.at("name"));
      for (const char* column : Columns)
      {
        text += "," + Format(row.contains(column) ? row.at(column) : Json());
      }
      text += LineEnd;
    }
  }
  return text;
}
