// SPDX-License-Identifier: BSD-3-Clause
// Writes the XML of the panels: TetraluxPanelWriter TEMPLATE OUTPUT. In place of comments of the
// template there are the properties of mappers, from the one table of them:
//
//   <!-- properties of KIND -->         definitions of all that mappers of the kind have
//   <!-- basic properties of KIND -->   their names, for a panel
//   <!-- advanced properties of KIND -->
//
// KIND is volumes, isosurfaces or images; names are also those of cells, which volumes and
// isosurfaces have in common, and then not among theirs.

#include "Properties/PropertyTable.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>

using tetralux::MapperProperty;
using tetralux::PropertyType;

namespace
{

/// A slider has about a hundred steps; finer defaults than that have a field alone.
constexpr double SliderSteps = 100;

/// What the colour map of ParaView chooses.
constexpr const char* ChosenElsewhere[] = { "VectorMode", "VectorComponent",
  "ColorArrayComponent" };

/// What masks need can't be given in a panel: a second input.
constexpr const char* LeftOut[] = { "MaskType", "MaskBlendFactor" };

template <std::size_t Size>
bool Contains(const char* const (&names)[Size], const std::string& name)
{
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool IsShown(const MapperProperty& property)
{
  return !Contains(ChosenElsewhere, property.Name) && !Contains(LeftOut, property.Name);
}

unsigned FindKinds(const std::string& name)
{
  if (name == "volumes")
  {
    return tetralux::VolumeKinds;
  }
  if (name == "isosurfaces")
  {
    return tetralux::IsosurfaceKind;
  }
  if (name == "images")
  {
    return tetralux::TriangleCasterKind;
  }
  throw std::invalid_argument("there are no properties of " + name);
}

/// Whether a panel's group has a property.
bool IsInGroup(const MapperProperty& property, const std::string& group)
{
  const bool ofVolumes = (property.Kinds & tetralux::VolumeKinds) != 0;
  const bool ofIsosurfaces = (property.Kinds & tetralux::IsosurfaceKind) != 0;
  if (group == "cells")
  {
    return ofVolumes && ofIsosurfaces;
  }
  if (group == "volumes" || group == "isosurfaces")
  {
    return (group == "volumes" ? ofVolumes : ofIsosurfaces) && ofVolumes != ofIsosurfaces;
  }
  return (property.Kinds & FindKinds(group)) != 0;
}

std::string Escape(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    switch (c)
    {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// "MaximumError" becomes "Maximum Error", "AverageIPScalarRange" "Average IP Scalar Range".
std::string MakeLabel(const std::string& name)
{
  std::string label;
  for (std::size_t i = 0; i < name.size(); ++i)
  {
    const bool upper = std::isupper(static_cast<unsigned char>(name[i])) != 0;
    const bool afterLower = i > 0 && std::islower(static_cast<unsigned char>(name[i - 1])) != 0;
    const bool beforeLower =
      i + 1 < name.size() && std::islower(static_cast<unsigned char>(name[i + 1])) != 0;
    if (i > 0 && upper && (afterLower || beforeLower))
    {
      label += ' ';
    }
    label += name[i];
  }
  return label;
}

/// "maximum-intensity" becomes "Maximum intensity".
std::string MakeEntry(std::string name)
{
  std::replace(name.begin(), name.end(), '-', ' ');
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return name;
}

std::string FormatNumber(PropertyType type, double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), type == PropertyType::Real ? "%.9g" : "%.0f", value);
  return text;
}

/// Whether a panel sets it to the bounds of the data at first.
bool HasBounds(const MapperProperty& property)
{
  return std::string(property.Elements) == "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX";
}

const char* GetElement(PropertyType type)
{
  switch (type)
  {
    case PropertyType::Real:
      return "DoubleVectorProperty";
    case PropertyType::Size:
      return "IdTypeVectorProperty";
    default:
      return "IntVectorProperty";
  }
}

void WriteRange(const MapperProperty& property, std::ostream& xml)
{
  double minimum = property.Minimum;
  for (const tetralux::NamedValue& value : property.Values)
  {
    minimum = std::min(minimum, static_cast<double>(value.Number));
  }
  const double first = property.Default.front();
  const bool slides = first == minimum || first >= property.Maximum / SliderSteps;
  xml << "        <" << (property.Type == PropertyType::Real ? "Double" : "Int")
      << "RangeDomain name=\"range\" min=\"" << FormatNumber(property.Type, minimum) << "\"";
  if (slides)
  {
    xml << " max=\"" << FormatNumber(property.Type, property.Maximum) << "\"";
  }
  xml << "/>\n";
}

void WriteDomain(const MapperProperty& property, unsigned kinds, std::ostream& xml)
{
  constexpr double Unbounded = 1e300; // less than the table has for it
  const bool single = property.Default.size() == 1;
  if (property.Type == PropertyType::Boolean)
  {
    xml << "        <BooleanDomain name=\"bool\"/>\n";
  }
  else if (property.Type == PropertyType::Enumeration)
  {
    xml << "        <EnumerationDomain name=\"enum\">\n";
    for (const tetralux::NamedValue& value : GetNamedValues(property, kinds))
    {
      xml << "          <Entry text=\"" << MakeEntry(value.Name) << "\" value=\"" << value.Number
          << "\"/>\n";
    }
    xml << "        </EnumerationDomain>\n";
  }
  else if (HasBounds(property))
  {
    xml << "        <BoundsDomain name=\"range\" mode=\"data_bounds\">\n"
           "          <RequiredProperties>\n"
           "            <Property function=\"Input\" name=\"Input\"/>\n"
           "          </RequiredProperties>\n"
           "        </BoundsDomain>\n";
  }
  else if (property.Maximum < Unbounded && property.Type != PropertyType::Size && single)
  {
    WriteRange(property, xml);
  }
}

/// The methods of volumes, as the panel names them, with the mappers that they may be of.
struct Method
{
  const char* Name;
  int Number;
  unsigned Kinds;
};
constexpr Method Methods[] = {
  { "automatic", 0, tetralux::RayCastKind | tetralux::GPURayCastKind },
  { "ray casting", 1, tetralux::RayCastKind },
  { "graphics card", 2, tetralux::GPURayCastKind },
  { "projection", 3, tetralux::ProjectionKind },
};

/// Whether some of the mappers of volumes are among kinds, but not all.
bool IsOfSomeMethods(unsigned kinds)
{
  const unsigned ofVolumes = kinds & tetralux::VolumeKinds;
  return ofVolumes != 0 && ofVolumes != tetralux::VolumeKinds;
}

/// " Ray casting and projection only.", or nothing where it is of all methods.
std::string NameMethods(unsigned kinds)
{
  std::string names;
  for (const Method& method : Methods)
  {
    const bool single = (method.Kinds & (method.Kinds - 1)) == 0;
    if (IsOfSomeMethods(kinds) && single && (kinds & method.Kinds) != 0)
    {
      names += (names.empty() ? "" : " and ") + std::string(method.Name);
    }
  }
  return names.empty() ? "" : " " + MakeEntry(names) + " only.";
}

void WriteDocumentation(const MapperProperty& property, unsigned kinds, std::ostream& xml)
{
  xml << "        <Documentation>" << Escape(property.Meaning);
  if (property.Type != PropertyType::Enumeration && property.Type != PropertyType::Boolean)
  {
    constexpr unsigned WithoutNames = 0;
    const std::string unit = property.Unit;
    xml << " " << Escape(MakeEntry(DescribeValues(property, WithoutNames)))
        << (unit.empty() ? "" : ", in " + Escape(unit)) << ".";
  }
  for (const tetralux::NamedValue& value : GetNamedValues(property, kinds))
  {
    xml << " " << MakeEntry(value.Name)
        << (property.Type == PropertyType::Enumeration ? ""
                                                       : " (" + std::to_string(value.Number) + ")")
        << ": " << Escape(value.Meaning) << "."
        << (value.Kinds == tetralux::AllKinds ? "" : NameMethods(value.Kinds));
  }
  xml << NameMethods(property.Kinds & kinds) << "</Documentation>\n";
}

/// What a switch of the same group turns on is shown only then.
void WriteSwitch(const MapperProperty& property, std::ostream& xml)
{
  const std::string group = property.Group;
  const MapperProperty* groupSwitch = tetralux::FindMapperProperty(group);
  if (groupSwitch && groupSwitch != &property)
  {
    xml << "          <PropertyWidgetDecorator type=\"ShowWidgetDecorator\">\n"
           "            <Property name=\"Tetralux"
        << group
        << "\" function=\"boolean\"/>\n"
           "          </PropertyWidgetDecorator>\n";
  }
}

/// What the chosen method does not use is greyed out.
void WriteMethods(const MapperProperty& property, std::ostream& xml)
{
  if (!IsOfSomeMethods(property.Kinds))
  {
    return;
  }
  const char* decorator = "              <PropertyWidgetDecorator type=\"GenericDecorator\""
                          " mode=\"enabled_state\" property=";
  xml << "          <PropertyWidgetDecorator type=\"CompositeDecorator\">\n"
         "            <Expression type=\"or\">\n";
  for (const Method& method : Methods)
  {
    if ((property.Kinds & method.Kinds) != 0)
    {
      xml << decorator << "\"TetraluxMethod\" value=\"" << method.Number << "\"/>\n";
    }
  }
  if ((property.Kinds & tetralux::IsosurfaceKind) != 0)
  {
    xml << decorator << "\"Representation\" value=\"Tetralux Isosurface\"/>\n";
  }
  xml << "            </Expression>\n"
         "          </PropertyWidgetDecorator>\n";
}

void WriteHints(const MapperProperty& property, unsigned kinds, std::ostream& xml)
{
  std::ostringstream hints;
  WriteSwitch(property, hints);
  if ((kinds & tetralux::VolumeKinds) != 0)
  {
    WriteMethods(property, hints);
  }
  if (!hints.str().empty())
  {
    xml << "        <Hints>\n" << hints.str() << "        </Hints>\n";
  }
}

std::string MakeDefinitions(const std::string& group)
{
  const unsigned kinds = FindKinds(group);
  std::ostringstream xml;
  for (const MapperProperty& property : tetralux::GetMapperProperties())
  {
    if ((property.Kinds & kinds) == 0 || !IsShown(property))
    {
      continue;
    }
    xml << "      <" << GetElement(property.Type) << " name=\"Tetralux" << property.Name
        << "\" label=\"" << MakeLabel(property.Name)
        << "\" command=\"SetMapperProperty\" initial_string=\"" << property.Name
        << "\" number_of_elements=\"" << property.Default.size() << "\" default_values=\"";
    for (std::size_t i = 0; i < property.Default.size(); ++i)
    {
      // A state leaves out what is the default. What the data sets is never that.
      xml << (i == 0 ? "" : " ")
          << (HasBounds(property) ? "0" : FormatNumber(property.Type, property.Default[i]));
    }
    xml << "\">\n";
    WriteDomain(property, kinds, xml);
    WriteDocumentation(property, kinds, xml);
    WriteHints(property, kinds, xml);
    xml << "      </" << GetElement(property.Type) << ">\n";
  }
  return xml.str();
}

std::string MakeNames(const std::string& group, bool advanced)
{
  std::ostringstream xml;
  for (const MapperProperty& property : tetralux::GetMapperProperties())
  {
    if (IsInGroup(property, group) && property.Advanced == advanced && IsShown(property))
    {
      xml << "            <Property name=\"Tetralux" << property.Name << "\""
          << (advanced ? " panel_visibility=\"advanced\"" : "") << "/>\n";
    }
  }
  return xml.str();
}

void Write(std::istream& input, std::ostream& output)
{
  const std::regex comment(R"(\s*<!-- (|basic |advanced )properties of (\w+) -->)");
  std::string line;
  while (std::getline(input, line))
  {
    std::smatch match;
    if (!std::regex_match(line, match, comment))
    {
      output << line << "\n";
    }
    else if (match[1].length() == 0)
    {
      output << MakeDefinitions(match[2]);
    }
    else
    {
      output << MakeNames(match[2], match[1] == "advanced ");
    }
  }
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::cerr << "usage: TetraluxPanelWriter TEMPLATE OUTPUT\n";
    return 2;
  }
  try
  {
    std::ifstream input(argv[1]);
    std::ofstream output(argv[2]);
    Write(input, output);
    output.close();
    if (!input.eof() || !output)
    {
      throw std::runtime_error(
        std::string(argv[1]) + " can't be read or " + argv[2] + " can't be written");
    }
  }
  catch (const std::exception& error)
  {
    std::cerr << "TetraluxPanelWriter: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
