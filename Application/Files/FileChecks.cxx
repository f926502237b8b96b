// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileChecks.h"

#include "CommandLine/CommandErrors.h"

#include "vtkSmartPointer.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLUtilities.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace
{

/// Bytes at the beginning in which a format shows itself.
constexpr std::size_t BeginningSize = 4096;

std::string ReadBeginning(const std::string& fileName)
{
  std::string text(BeginningSize, '\0');
  std::ifstream stream(fileName, std::ios::binary);
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

bool Has(const std::string& text, const std::string& word)
{
  return text.find(word) != std::string::npos;
}

/// Whether numbers are 0, 1, ... and at least one.
bool IsCount(const std::set<int>& numbers)
{
  return !numbers.empty() && *numbers.begin() == 0 &&
    *numbers.rbegin() == static_cast<int>(numbers.size()) - 1;
}

int GetNumber(vtkXMLDataElement* element, const char* attribute)
{
  int number = -1;
  return element->GetScalarAttribute(attribute, number) ? number : -1;
}

bool HasNumberedLevels(vtkXMLDataElement* amr)
{
  std::set<int> levels;
  for (int i = 0; i < amr->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* level = amr->GetNestedElement(i);
    if (std::strcmp(level->GetName(), "Block") != 0)
    {
      continue;
    }
    levels.insert(GetNumber(level, "level"));
    std::set<int> dataSets;
    for (int j = 0; j < level->GetNumberOfNestedElements(); ++j)
    {
      dataSets.insert(GetNumber(level->GetNestedElement(j), "index"));
    }
    if (!IsCount(dataSets))
    {
      return false;
    }
  }
  return IsCount(levels);
}

} // namespace

void CheckReadable(const std::string& fileName)
{
  if (std::filesystem::is_directory(fileName))
  {
    throw WorkError("cannot read '" + fileName + "': it is a folder");
  }
  if (!std::ifstream(fileName))
  {
    throw WorkError("cannot read '" + fileName + "': " + std::strerror(errno));
  }
}

void CheckBeginning(const std::string& fileName, const std::vector<std::string>& beginnings,
  const std::string& format)
{
  const std::string text = ReadBeginning(fileName);
  if (std::none_of(beginnings.begin(), beginnings.end(),
        [&text](const std::string& beginning)
        { return text.compare(0, beginning.size(), beginning) == 0; }))
  {
    throw WorkError("cannot read '" + fileName + "': it is not " + format);
  }
}

void CheckWords(
  const std::string& fileName, const std::vector<std::string>& words, const std::string& format)
{
  std::string text = ReadBeginning(fileName);
  std::transform(
    text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  if (std::none_of(
        words.begin(), words.end(), [&text](const std::string& word) { return Has(text, word); }))
  {
    throw WorkError("cannot read '" + fileName + "': it is not " + format);
  }
}

void CheckParentheses(const std::string& fileName)
{
  std::ifstream stream(fileName, std::ios::binary);
  const std::string text{ std::istreambuf_iterator<char>(stream), {} };
  const bool isBinary = text.find('\0') != std::string::npos;
  if (!isBinary &&
    std::count(text.begin(), text.end(), '(') != std::count(text.begin(), text.end(), ')'))
  {
    throw WorkError("cannot read '" + fileName + "': its end is missing");
  }
}

void CheckUcd(const std::string& fileName)
{
  const std::string text = ReadBeginning(fileName);
  if (!text.empty() && text[0] == 7) // of a binary file
  {
    return;
  }
  std::istringstream stream(text);
  std::string line;
  while (std::getline(stream, line) && !line.empty() && line[0] == '#')
  {
  }
  if (!line.empty() && line[0] == '*')
  {
    throw WorkError("cannot read '" + fileName +
      "': it is not an AVS UCD file but one of Abaqus; " + "convert it, as by: meshio convert " +
      fileName + " out.vtu");
  }
  std::istringstream numbers(line);
  long long points = 0;
  long long cells = 0;
  long long further[3] = {};
  if (!(numbers >> points >> cells >> further[0] >> further[1] >> further[2]) || points < 1 ||
    cells < 0)
  {
    throw WorkError("cannot read '" + fileName + "': it is not an AVS UCD file");
  }
}

void CheckAmrLevels(const std::string& fileName)
{
  const std::string text = ReadBeginning(fileName);
  if (!Has(text, "OverlappingAMR") && !Has(text, "HierarchicalBoxDataSet"))
  {
    return;
  }
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
    vtkXMLUtilities::ReadElementFromFile(fileName.c_str()));
  if (!root || root->GetNumberOfNestedElements() == 0 ||
    !HasNumberedLevels(root->GetNestedElement(0)))
  {
    throw WorkError("cannot read '" + fileName +
      "': its refined grids are not in Block elements with a level from 0 on, each with DataSet "
      "elements with an index from 0 on");
  }
}
