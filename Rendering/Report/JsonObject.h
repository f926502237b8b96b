// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_JsonObject_h
#define tetralux_JsonObject_h

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace tetralux
{

/// Writes one object of JSON: members in the order in which they are set.
class JsonObject
{
public:
  void Set(const std::string& name, const std::string& value);
  void Set(const std::string& name, const char* value) { this->Set(name, std::string(value)); }
  void Set(const std::string& name, bool value);
  void Set(const std::string& name, double value); ///< null where it is not finite

  template <class Integer, std::enable_if_t<std::is_integral<Integer>::value, bool> = true>
  void Set(const std::string& name, Integer value)
  {
    this->Members.push_back({ name, std::to_string(value), {} });
  }

  void Set(const std::string& name, const std::vector<std::string>& values);
  void Set(const std::string& name, const std::vector<std::int64_t>& values);
  void Set(const std::string& name, const JsonObject& value);

  /// In several lines, without a newline at the end.
  std::string ToString(int indent = 0) const;

private:
  struct Member
  {
    std::string Name;
    std::string Text;               ///< already JSON, unless it is an object
    std::vector<JsonObject> Object; ///< one or none
  };
  std::vector<Member> Members;
};

} // namespace tetralux

#endif
