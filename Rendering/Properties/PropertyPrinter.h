// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PropertyPrinter_h
#define tetralux_PropertyPrinter_h

#include "Properties/PropertyTable.h"

#include "vtkIndent.h"

#include <ostream>

namespace tetralux
{

/// Prints properties for PrintSelf, one a line, as FormatValues has them.
class PropertyPrinter
{
public:
  PropertyPrinter(std::ostream& os, vtkIndent indent)
    : Stream(os)
    , Indent(indent)
  {
  }

  template <class... NumberT>
  void Print(const char* name, NumberT... values)
  {
    this->Stream << this->Indent << name << ": "
                 << FormatValues(GetMapperProperty(name), { static_cast<double>(values)... })
                 << "\n";
  }

private:
  std::ostream& Stream;
  vtkIndent Indent;
};

} // namespace tetralux

#endif
