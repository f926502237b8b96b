// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WriteSeries.h"

#include "Files/WriteBytes.h"

#include "vtkIndent.h"
#include "vtkNew.h"
#include "vtkXMLDataElement.h"

#include <sstream>

void WritePvd(
  const std::vector<SeriesStep>& steps, const std::string& path, const std::string& name)
{
  vtkNew<vtkXMLDataElement> root;
  root->SetName("VTKFile");
  root->SetAttribute("type", "Collection");
  root->SetAttribute("version", "0.1");
  vtkNew<vtkXMLDataElement> collection;
  collection->SetName("Collection");
  root->AddNestedElement(collection);
  for (const SeriesStep& step : steps)
  {
    for (std::size_t part = 0; part < step.Files.size(); ++part)
    {
      vtkNew<vtkXMLDataElement> file;
      file->SetName("DataSet");
      file->SetDoubleAttribute("timestep", step.Time);
      file->SetIntAttribute("part", static_cast<int>(part));
      file->SetAttribute("file", step.Files[part].c_str());
      collection->AddNestedElement(file);
    }
  }
  std::ostringstream stream;
  root->PrintXML(stream, vtkIndent());
  WriteText(stream.str(), path, name);
}
