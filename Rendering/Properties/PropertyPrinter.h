// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PropertyPrinter_h
#define tetralux_PropertyPrinter_h

#include "Properties/PropertyTable.h"

#include "vtkIndent.h"

#include <ostream>

namespace tetralux
{

/// Prints properties for PrintSelf, one a line, as FormatValues has them. Skips those that mappers
/// of these kinds do not have.
class PropertyPrinter
{
public:
  PropertyPrinter(std::ostream& os, vtkIndent indent, unsigned kinds)
    : Stream(os)
    , Indent(indent)
    , Kinds(kinds)
  {
  }

  template <class... NumberT>
  void Print(const char* name, NumberT... values)
  {
    const MapperProperty& property = GetMapperProperty(name);
    if ((property.Kinds & this->Kinds) != 0)
    {
      this->Stream << this->Indent << name << ": "
                   << FormatValues(property, { static_cast<double>(values)... }) << "\n";
    }
  }

private:
  std::ostream& Stream;
  vtkIndent Indent;
  unsigned Kinds;
};

} // namespace tetralux

#endif
