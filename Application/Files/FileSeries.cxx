// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileSeries.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "Files/FileChecks.h"

#include "vtkSmartPointer.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLUtilities.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

namespace
{

/// Files by time.
using Steps = std::map<double, std::vector<std::string>>;

/// The name of a listed file, which is relative to the folder of the list.
std::string Resolve(const std::string& list, const std::string& file)
{
  return (std::filesystem::path(list).parent_path() / file).string();
}

Steps ReadCollection(const std::string& fileName)
{
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
    vtkXMLUtilities::ReadElementFromFile(fileName.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
  {
    throw WorkError("cannot read '" + fileName + "': it has no Collection element");
  }
  Steps steps;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    const char* file = entry->GetAttribute("file");
    if (std::strcmp(entry->GetName(), "DataSet") == 0 && file)
    {
      double time = 0; // that of a file without
      if (const char* text = entry->GetAttribute("timestep"))
      {
        const char* end = text + std::strlen(text);
        const std::from_chars_result result = std::from_chars(text, end, time);
        if (result.ec != std::errc() || result.ptr != end || !std::isfinite(time))
        {
          throw WorkError(
            "cannot read '" + fileName + "': timestep '" + text + "' of '" + file + "' is no time");
        }
      }
      steps[time].push_back(Resolve(fileName, file));
    }
  }
  return steps;
}

Steps ReadJsonSeries(const std::string& fileName)
{
  Steps steps;
  try
  {
    std::ifstream stream(fileName);
    const nlohmann::json list = nlohmann::json::parse(stream);
    for (const nlohmann::json& file : list.at("files"))
    {
      steps[file.at("time").get<double>()].push_back(
        Resolve(fileName, file.at("name").get<std::string>()));
    }
  }
  catch (const nlohmann::json::exception&)
  {
    throw WorkError("cannot read '" + fileName +
      "': it is not JSON with a list \"files\" of objects with \"name\" and \"time\"");
  }
  return steps;
}

/// Groups: all before the numbers of pieces, the extension, the number of a restart, the number of
/// pieces, the number of this one.
const std::regex& GetExodusName()
{
  static const std::regex name(
    R"((.*(\.(?:e|g|gen|exo|exo2|ex2|exii))(-s\d+)?)(?:\.(\d+)\.(\d+))?)", std::regex::icase);
  return name;
}

} // namespace

bool IsSeries(const std::string& fileName)
{
  const std::vector<std::string>& extensions = GetSeriesExtensions();
  return std::find(extensions.begin(), extensions.end(), GetExtension(fileName)) !=
    extensions.end();
}

const std::vector<std::string>& GetSeriesExtensions()
{
  static const std::vector<std::string> extensions = { ".pvd", ".series" };
  return extensions;
}

std::vector<SeriesStep> ReadSeries(const std::string& fileName)
{
  CheckReadable(fileName);
  std::vector<SeriesStep> series;
  for (const auto& [time, files] :
    GetExtension(fileName) == ".pvd" ? ReadCollection(fileName) : ReadJsonSeries(fileName))
  {
    series.push_back({ time, files });
  }
  if (series.empty())
  {
    throw WorkError("cannot read '" + fileName + "': it lists no files");
  }
  return series;
}

std::vector<std::string> ListPieces(const std::string& fileName)
{
  std::smatch match;
  if (!std::regex_match(fileName, match, GetExodusName()) || !match[4].matched)
  {
    return { fileName };
  }
  // Numbers have as many digits as the number of pieces.
  const std::string digits = match[4].str();
  const std::size_t width = match[5].length();
  std::vector<std::string> pieces;
  for (int piece = 0; piece < std::atoi(digits.c_str()); ++piece)
  {
    std::string number = std::to_string(piece);
    number.insert(0, width > number.size() ? width - number.size() : 0, '0');
    pieces.push_back(match[1].str() + "." + digits + "." + number);
    CheckReadable(pieces.back());
  }
  return pieces;
}

std::string GetFormatExtension(const std::string& fileName)
{
  std::smatch match;
  // A name that is nothing but an extension has none.
  return GetExtension(
    std::regex_match(fileName, match, GetExodusName()) ? "name" + match[2].str() : fileName);
}
