// SPDX-License-Identifier: BSD-3-Clause
#include "Setup/MapperProperties.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "MapperPropertyAccess.h"

#include "vtkAbstractVolumeMapper.h"

#include <algorithm>
#include <cmath>
#include <optional>

using tetralux::MapperProperty;
using tetralux::NamedValue;
using tetralux::PropertyType;

namespace
{

/// --array and --component choose them.
constexpr const char* ChosenElsewhere[] = { "VectorMode", "VectorComponent" };

const std::vector<NamedValue> Switch = { { "on", 1, "" }, { "true", 1, "" }, { "off", 0, "" },
  { "false", 0, "" } };

/// The number that a text stands for; nothing if it is no value of the property.
std::optional<double> ReadValue(
  const MapperProperty& property, unsigned kinds, const std::string& text)
{
  const std::vector<NamedValue> values =
    property.Type == PropertyType::Boolean ? Switch : GetNamedValues(property, kinds);
  if (const NamedValue* value = FindNamedValue(values, text))
  {
    return value->Number;
  }
  double number;
  try
  {
    number = ParseNumber("", text);
  }
  catch (const UsageError&)
  {
    return {};
  }
  const bool named = std::any_of(values.begin(), values.end(),
    [number](const NamedValue& value) { return value.Number == number; });
  const bool inRange = property.Type != PropertyType::Enumeration && property.Minimum <= number &&
    number <= property.Maximum;
  const bool whole = property.Type == PropertyType::Real || number == std::floor(number);
  return named || (inRange && whole) ? std::optional<double>(number) : std::nullopt;
}

std::vector<double> ReadValues(const MapperProperty& property, unsigned kinds,
  const std::string& option, const std::string& text)
{
  if (property.Default.size() > 1)
  {
    return ParseNumbers(option, text, property.Default.size(), property.Elements);
  }
  const std::optional<double> value = ReadValue(property, kinds, text);
  if (!value)
  {
    throw UsageError(option + ": '" + text + "' is not " + DescribeValues(property, kinds));
  }
  return { *value };
}

std::vector<std::string> GetNames(unsigned kinds)
{
  std::vector<std::string> names;
  for (const MapperProperty* property : GetSettableProperties())
  {
    if ((property->Kinds & kinds) != 0)
    {
      names.push_back(property->Name);
    }
  }
  return names;
}

} // namespace

std::vector<const MapperProperty*> GetSettableProperties()
{
  std::vector<const MapperProperty*> properties;
  for (const MapperProperty& property : tetralux::GetMapperProperties())
  {
    if (std::find(std::begin(ChosenElsewhere), std::end(ChosenElsewhere),
          std::string(property.Name)) == std::end(ChosenElsewhere))
    {
      properties.push_back(&property);
    }
  }
  std::sort(properties.begin(), properties.end(),
    [](const MapperProperty* a, const MapperProperty* b)
    { return std::string(a->Name) < b->Name; });
  return properties;
}

std::vector<std::string> GetPropertyNames(vtkAbstractVolumeMapper* mapper)
{
  return GetNames(tetralux::GetKind(mapper));
}

std::vector<std::string> GetPropertyNames() { return GetNames(tetralux::AllKinds); }

bool HasProperty(vtkAbstractVolumeMapper* mapper, const std::string& name)
{
  const std::vector<std::string> names = GetPropertyNames(mapper);
  return std::find(names.begin(), names.end(), name) != names.end();
}

void SetProperty(vtkAbstractVolumeMapper* mapper, const std::string& assignment)
{
  const auto [name, value] = ParseAssignment("--set", assignment);
  if (!HasProperty(mapper, name))
  {
    throw UsageError("--set: " + std::string(mapper->GetClassName()) + " has no property '" + name +
      "'; it has " + JoinNames(GetPropertyNames(mapper)));
  }
  const MapperProperty& property = tetralux::GetMapperProperty(name);
  SetPropertyValues(
    mapper, property, ReadValues(property, tetralux::GetKind(mapper), "--set " + name, value));
}
