// SPDX-License-Identifier: BSD-3-Clause
#ifndef WriteData_h
#define WriteData_h

#include <string>

class vtkDataSet;
class vtkImageData;

/// Each writes all of a file and throws WorkError where that fails; name is what the error calls the
/// file.
///@{
/// An image of 8-bit scalars as PNG.
void WritePng(vtkImageData* image, const std::string& path, const std::string& name);

/// Any data set in VTK's XML format of its kind (.vti, .vtu), appended and binary.
void WriteXml(vtkDataSet* data, const std::string& path, const std::string& name);
///@}

#endif
