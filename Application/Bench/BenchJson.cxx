// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchJson.h"

#include <cmath>

namespace
{

using Json = nlohmann::ordered_json;

Json MakeInteger(double value) { return std::isnan(value) ? Json() : Json(std::llround(value)); }

std::string JoinWithBlanks(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

Json DescribeRow(const BenchRow& row)
{
  Json json = { { "setting", row.Setting.Name }, { "group", row.Setting.Group },
    { "description", row.Setting.Description }, { "method", row.Setting.Method },
    { "properties", JoinWithBlanks(row.Setting.Assignments) } };
  if (!row.Failure.empty())
  {
    json["failure"] = row.Failure;
    return json;
  }
  json["largest_error"] = row.Errors.Maximum;
  json["rms_error"] = row.Errors.RootMeanSquare;
  json["error_99.9"] = row.Errors.Quantile999;
  json["share_above_1/255"] = row.Errors.ShareAbove1Of255;
  json["error_estimate"] = row.ErrorEstimate;
  json["best_ms"] = 1e3 * row.BestSeconds;
  json["median_ms"] = 1e3 * row.MedianSeconds;
  json["frames"] = row.Frames;
  json["prepare_ms"] = 1e3 * row.PrepareSeconds;
  json["bytes"] = MakeInteger(row.Bytes);
  json["bits"] = row.EightBit ? 8 : 32;
  json["pareto"] = row.OnFront;
  json["picture"] = row.PictureFile;
  if (!row.DifferenceFile.empty())
  {
    json["difference"] = row.DifferenceFile;
    json["amplification"] = row.Amplification;
  }
  return json;
}

Json DescribeScene(const BenchSceneResult& scene)
{
  Json rows = Json::array();
  for (const BenchRow& row : scene.Rows)
  {
    rows.push_back(DescribeRow(row));
  }
  return { { "name", scene.Name }, { "description", scene.Description }, { "width", scene.Width },
    { "height", scene.Height }, { "settings", rows } };
}

Json DescribeFeature(const BenchFeature& feature)
{
  const auto describe = [](const std::string& description, double seconds) {
    return Json{ { "description", description }, { "best_ms", 1e3 * seconds } };
  };
  Json forced;
  if (!feature.Forced.empty())
  {
    forced = describe(feature.Forced, feature.ForcedSeconds);
    forced["difference"] = feature.ForcedDifference;
  }
  return { { "feature", feature.Name }, { "plain", describe(feature.Plain, feature.PlainSeconds) },
    { "forced", forced }, { "used", describe(feature.Used, feature.UsedSeconds) },
    { "left_out", feature.LeftOut } };
}

} // namespace

Json MakeResults(const std::vector<BenchSceneResult>& results,
  const std::vector<BenchFeature>& features,
  const std::vector<std::pair<std::string, std::string>>& machine, const std::string& command)
{
  Json json = { { "title", "Error against run time" }, { "command", command } };
  for (const auto& [label, value] : machine)
  {
    json["machine"][label] = value;
  }
  json["scenes"] = Json::array();
  for (const BenchSceneResult& scene : results)
  {
    json["scenes"].push_back(DescribeScene(scene));
  }
  json["features"] = Json::array();
  for (const BenchFeature& feature : features)
  {
    json["features"].push_back(DescribeFeature(feature));
  }
  return json;
}
