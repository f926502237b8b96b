// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PropertyTable_h
#define tetralux_PropertyTable_h

#include "TetraluxRenderingModule.h" // For export macro

#include <string>
#include <vector>

namespace tetralux
{

/// The properties of the mappers, in one table: what setters accept, what PrintSelf prints, what
/// `tetralux render --set` reads, and what a panel has to show. The texts in the class headers say
/// the same at more length; a test compares the table with the classes.

/// Kinds of mappers, as bits.
enum MapperKind : unsigned
{
  RayCastKind = 1,         ///< vtkTetrahedraRayCastMapper
  GPURayCastKind = 2,      ///< vtkTetrahedraGPURayCastMapper
  ProjectionKind = 4,      ///< vtkTetrahedraProjectionMapper
  IsosurfaceKind = 8,      ///< vtkTetrahedraIsosurfaceMapper
  TriangleCasterKind = 16, ///< vtkTriangleCasterMapper
  VolumeKinds = 7,         ///< those that integrate along rays through cells
  CellKinds = 15,          ///< vtkTetrahedraVolumeMapper, the base class of mappers of cells
  ProcessorKinds = 25,     ///< those that make their pictures on the processor
  AllKinds = 31
};

enum class PropertyType
{
  Boolean,    ///< vtkTypeBool
  Integer,    ///< int
  Size,       ///< vtkIdType
  Real,       ///< double or float, or several of them
  Enumeration ///< int, one of the named values
};

/// A value with a name of its own. An Enumeration takes only these; a number may have some, as
/// "automatic" for 0.
struct NamedValue
{
  const char* Name; ///< "closed-form": Set...ToClosedForm sets it
  int Number;
  const char* Meaning;
  unsigned Kinds = AllKinds; ///< of the mappers that honour it
};

struct MapperProperty
{
  const char* Name; ///< "MaximumError": SetMaximumError sets it
  PropertyType Type;
  unsigned Kinds;    ///< of the mappers that have it
  const char* Group; ///< for panels: "Quality", "Pre-integration table"
  bool Advanced;     ///< whether panels hide it at first
  std::vector<NamedValue> Values;
  double Minimum; ///< of a number; setters clamp to Minimum..Maximum, but for named values
  double Maximum;
  std::vector<double> Default; ///< as many numbers as the property has
  const char* Elements;        ///< names of the numbers, "XMIN,XMAX"; empty if there is one number
  const char* Unit;            ///< empty if there is none
  const char* Meaning;         ///< one sentence
};

/// All properties, those of the base class of mappers of cells first.
TETRALUXRENDERING_EXPORT const std::vector<MapperProperty>& GetMapperProperties();

/// nullptr if no mapper has a property of that name.
TETRALUXRENDERING_EXPORT const MapperProperty* FindMapperProperty(const std::string& name);

/// The same, for names that are known to be there. Throws std::out_of_range for others.
TETRALUXRENDERING_EXPORT const MapperProperty& GetMapperProperty(const std::string& name);

/// The named values that mappers of any of these kinds honour.
TETRALUXRENDERING_EXPORT std::vector<NamedValue> GetNamedValues(
  const MapperProperty& property, unsigned kinds);

/// The name of a value of an Enumeration, or "unknown".
TETRALUXRENDERING_EXPORT const char* GetValueName(const char* property, int number);

/// The value with that name, or nullptr. Case, '-' and '_' do not matter.
TETRALUXRENDERING_EXPORT const NamedValue* FindNamedValue(
  const std::vector<NamedValue>& values, const std::string& name);

/// What mappers of these kinds accept, in a few words: "0 to 1", "on or off",
/// "automatic (0), single (1) or double (2)".
TETRALUXRENDERING_EXPORT std::string DescribeValues(const MapperProperty& property, unsigned kinds);

/// The same for named values alone.
TETRALUXRENDERING_EXPORT std::string DescribeValues(const std::vector<NamedValue>& values);

/// Numbers of a property as text, by name if there is one: "On", "closed-form", "0.0001",
/// "0, 1, 0, 1, 0, 1".
TETRALUXRENDERING_EXPORT std::string FormatValues(
  const MapperProperty& property, const std::vector<double>& values);

} // namespace tetralux

#endif
