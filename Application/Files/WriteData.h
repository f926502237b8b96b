// SPDX-License-Identifier: BSD-3-Clause
#ifndef WriteData_h
#define WriteData_h

#include <string>

class vtkDataSet;
class vtkImageData;

/// Each function writes a file, or throws WorkError. path: where to write. name: what the error
/// calls the file.
///@{
/// Writes an image of 8-bit scalars as PNG.
void WritePng(vtkImageData* image, const std::string& path, const std::string& name);

/// Writes a data set in VTK's XML format of its kind (.vti, .vtu), appended and binary.
void WriteXml(vtkDataSet* data, const std::string& path, const std::string& name);
///@}

#endif
