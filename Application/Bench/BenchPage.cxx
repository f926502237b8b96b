// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchPage.h"

#include "BenchPageTemplate.h"

#include <nlohmann/json.hpp>

#include <map>

namespace
{

/// Where the template takes the JSON.
constexpr const char* Placeholder = "@RESULTS@";

/// JSON that no browser takes for the end of the script that it is in, or for a comment.
std::string Escape(const std::string& json)
{
  std::string escaped;
  for (const char c : json)
  {
    escaped += c == '<' ? "\\u003c" : std::string(1, c);
  }
  return escaped;
}

} // namespace

std::string MakePage(
  const nlohmann::ordered_json& results, const std::vector<BenchSceneResult>& scenes)
{
  std::map<std::string, std::string> images;
  for (const BenchSceneResult& scene : scenes)
  {
    for (const BenchRow& row : scene.Rows)
    {
      images[row.PictureFile] = row.PictureUri;
      images[row.DifferenceFile] = row.DifferenceUri;
    }
  }
  nlohmann::ordered_json shown = results;
  for (const auto& [file, uri] : images)
  {
    if (!uri.empty())
    {
      shown["images"][file] = uri;
    }
  }
  std::string page = BenchPageTemplate;
  return page.replace(
    page.find(Placeholder), std::string(Placeholder).size(), Escape(shown.dump()));
}
