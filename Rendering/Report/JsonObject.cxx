// SPDX-License-Identifier: BSD-3-Clause
#include "Report/JsonObject.h"

#include <cmath>
#include <cstdio>
#include <locale>
#include <sstream>

namespace tetralux
{
namespace
{

std::string Quote(const std::string& text)
{
  std::string result = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      result += '\\';
      result += c;
    }
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      char escape[8];
      std::snprintf(escape, sizeof(escape), "\\u%04x", static_cast<unsigned char>(c));
      result += escape;
    }
    else
    {
      result += c;
    }
  }
  return result + '"';
}

} // namespace

void JsonObject::Set(const std::string& name, const std::string& value)
{
  this->Members.push_back({ name, Quote(value), {} });
}

void JsonObject::Set(const std::string& name, bool value)
{
  this->Members.push_back({ name, value ? "true" : "false", {} });
}

void JsonObject::Set(const std::string& name, double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic()); // a point, in every country
  text.precision(9);
  text << value;
  this->Members.push_back({ name, std::isfinite(value) ? text.str() : "null", {} });
}

void JsonObject::Set(const std::string& name, const std::vector<std::string>& values)
{
  std::string text;
  for (const std::string& value : values)
  {
    text += (text.empty() ? "[" : ", ") + Quote(value);
  }
  this->Members.push_back({ name, values.empty() ? "[]" : text + ']', {} });
}

void JsonObject::Set(const std::string& name, const std::vector<std::int64_t>& values)
{
  std::string text;
  for (const std::int64_t value : values)
  {
    text += (text.empty() ? "[" : ", ") + std::to_string(value);
  }
  this->Members.push_back({ name, values.empty() ? "[]" : text + ']', {} });
}

void JsonObject::Set(const std::string& name, const JsonObject& value)
{
  this->Members.push_back({ name, {}, { value } });
}

std::string JsonObject::ToString(int indent) const
{
  std::string result = "{";
  const char* separator = "\n";
  for (const Member& member : this->Members)
  {
    result += separator + std::string(indent + 2, ' ') + Quote(member.Name) + ": " +
      (member.Object.empty() ? member.Text : member.Object.front().ToString(indent + 2));
    separator = ",\n";
  }
  return this->Members.empty() ? "{}" : result + '\n' + std::string(indent, ' ') + '}';
}

} // namespace tetralux
