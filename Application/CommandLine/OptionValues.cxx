// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine/OptionValues.h"

#include "CommandLine/CommandErrors.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>

namespace
{

/// Reads all of a text as a number, in any locale the same: decimal, or a hexadecimal integer that
/// begins with 0x, as masks are written.
template <class NumberT>
bool ReadNumber(const std::string& text, NumberT& value)
{
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X'))
  {
    std::uint32_t digits = 0; // any of them is exact in a double
    const std::from_chars_result result = std::from_chars(begin + 2, end, digits, 16);
    value = static_cast<NumberT>(digits);
    return result.ec == std::errc() && result.ptr == end && value >= 0;
  }
  if (begin != end && *begin == '+')
  {
    ++begin;
  }
  const std::from_chars_result result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end;
}

bool ReadFinite(const std::string& text, double& value)
{
  return ReadNumber(text, value) && std::isfinite(value);
}

} // namespace

double ParseNumber(const std::string& option, const std::string& text)
{
  double value;
  if (!ReadFinite(text, value))
  {
    throw UsageError(option + ": '" + text + "' is not a number");
  }
  return value;
}

double ParsePositive(const std::string& option, const std::string& text)
{
  double value;
  if (!ReadFinite(text, value) || value <= 0)
  {
    throw UsageError(option + ": '" + text + "' is not a number above 0");
  }
  return value;
}

int ParseInteger(const std::string& option, const std::string& text, int minimum, int maximum)
{
  int value;
  if (!ReadNumber(text, value) || value < minimum || value > maximum)
  {
    throw UsageError(option + ": '" + text + "' is not an integer from " + std::to_string(minimum) +
      " to " + std::to_string(maximum));
  }
  return value;
}

std::vector<double> ParseNumbers(const std::string& option, const std::string& text)
{
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    double value;
    if (!ReadFinite(text.substr(begin, end - begin), value))
    {
      throw UsageError(option + ": '" + text + "' is not a list of numbers with commas between");
    }
    values.push_back(value);
    begin = end + 1;
  }
  return values;
}

std::vector<double> ParseNumbers(
  const std::string& option, const std::string& text, std::size_t count, const std::string& shape)
{
  std::vector<double> values;
  try
  {
    values = ParseNumbers(option, text);
  }
  catch (const UsageError&)
  {
  }
  if (values.size() != count)
  {
    throw UsageError(option + ": '" + text + "' is not " + shape + ", " + std::to_string(count) +
      " numbers with commas between");
  }
  return values;
}

std::pair<std::string, std::string> ParseAssignment(
  const std::string& option, const std::string& text)
{
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
  {
    throw UsageError(option + ": '" + text + "' is not Property=Value");
  }
  return { text.substr(0, equals), text.substr(equals + 1) };
}

std::string GetExtension(const std::string& fileName)
{
  std::string extension = std::filesystem::path(fileName).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string FormatNumber(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

std::string JoinNames(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}
