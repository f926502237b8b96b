// SPDX-License-Identifier: BSD-3-Clause
#include "Files/ReadMesh.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/MessageCapture.h"
#include "CommandLine/OptionValues.h"
#include "CommandLine/ProgressLine.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExodusIIReader.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkMultiBlockPLOT3DReader.h"
#include "vtkNew.h"
#include "vtkNrrdReader.h"
#include "vtkSLCReader.h"
#include "vtkXMLGenericDataObjectReader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <vector>

namespace
{

using Reader = vtkSmartPointer<vtkAlgorithm>;

template <class ReaderT>
Reader MakeReader(const std::string& fileName)
{
  auto reader = vtkSmartPointer<ReaderT>::New();
  reader->SetFileName(fileName.c_str());
  return reader;
}

Reader MakeLegacyReader(const std::string& fileName)
{
  auto reader = vtkSmartPointer<vtkGenericDataObjectReader>::New();
  reader->SetFileName(fileName.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllFieldsOn();
  return reader;
}

Reader MakeExodusReader(const std::string& fileName)
{
  // Exodus files are NetCDF, in its classic form or over HDF5. For any other file, the library
  // prints many lines of its own.
  char magic[4] = {};
  std::ifstream(fileName, std::ios::binary).read(magic, sizeof(magic));
  const std::string begin(magic, sizeof(magic));
  if (begin.compare(0, 3, "CDF") != 0 && begin != "\x89HDF")
  {
    throw WorkError("cannot read '" + fileName + "': it is no Exodus file");
  }
  auto reader = vtkSmartPointer<vtkExodusIIReader>::New();
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  for (int type : { vtkExodusIIReader::NODAL, vtkExodusIIReader::ELEM_BLOCK })
  {
    reader->SetAllArrayStatus(type, 1);
  }
  return reader;
}

struct Format
{
  std::vector<std::string> Extensions;
  std::string Description;
  std::function<Reader(const std::string&)> Make;
};

const std::vector<Format>& GetFormats()
{
  static const std::vector<Format> formats = {
    { { ".vtu", ".pvtu", ".vti", ".pvti", ".vts", ".pvts", ".vtr", ".pvtr", ".vtm", ".vtmb" },
      "VTK XML", MakeReader<vtkXMLGenericDataObjectReader> },
    { { ".vtk" }, "VTK legacy", MakeLegacyReader },
    { { ".ex2", ".e", ".exo", ".exii" }, "Exodus II", MakeExodusReader },
    { { ".slc" }, "SLC volume", MakeReader<vtkSLCReader> },
    { { ".nrrd", ".nhdr" }, "NRRD volume", MakeReader<vtkNrrdReader> },
  };
  return formats;
}

const std::vector<std::string>& GetPlot3dExtensions()
{
  static const std::vector<std::string> extensions = { ".bin", ".xyz", ".x", ".p3d" };
  return extensions;
}

bool Contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

void CheckReadable(const std::string& fileName)
{
  if (std::filesystem::is_directory(fileName))
  {
    throw WorkError("cannot read '" + fileName + "': it is a folder");
  }
  if (!std::ifstream(fileName))
  {
    throw WorkError("cannot read '" + fileName + "': " + std::strerror(errno));
  }
}

Reader MakePlot3dReader(const std::string& coordinates, const std::string& solution)
{
  auto reader = vtkSmartPointer<vtkMultiBlockPLOT3DReader>::New();
  reader->SetXYZFileName(coordinates.c_str());
  reader->AutoDetectFormatOn();
  if (!solution.empty())
  {
    CheckReadable(solution);
    reader->SetQFileName(solution.c_str());
    // Density, stagnation energy and momentum are in the file. These are computed: pressure,
    // temperature, velocity.
    for (int function : { 110, 120, 200 })
    {
      reader->AddFunction(function);
    }
  }
  return reader;
}

Reader MakeReaderOf(const std::string& fileName, const std::string& solution)
{
  const std::string extension = GetExtension(fileName);
  if (!solution.empty() || Contains(GetPlot3dExtensions(), extension))
  {
    return MakePlot3dReader(fileName, solution);
  }
  for (const Format& format : GetFormats())
  {
    if (Contains(format.Extensions, extension))
    {
      return format.Make(fileName);
    }
  }
  throw WorkError("cannot read '" + fileName + "': its extension is none of " + GetInputHelp());
}

} // namespace

std::string GetInputHelp()
{
  std::string text;
  const auto append = [&text](const std::vector<std::string>& extensions, const std::string& name)
  {
    for (const std::string& extension : extensions)
    {
      text += extension + " ";
    }
    text += "(" + name + ")";
  };
  for (const Format& format : GetFormats())
  {
    append(format.Extensions, format.Description);
    text += ", ";
  }
  append(GetPlot3dExtensions(), "PLOT3D coordinates");
  return text;
}

vtkSmartPointer<vtkDataObject> ReadMesh(
  const std::string& fileName, const std::string& plot3dSolution)
{
  std::string name = fileName;
  std::string solution = plot3dSolution;
  const std::size_t comma = fileName.find(',');
  if (solution.empty() && comma != std::string::npos && !std::filesystem::exists(fileName))
  {
    name = fileName.substr(0, comma);
    solution = fileName.substr(comma + 1);
  }
  CheckReadable(name);

  const MessageCapture messages;
  vtkSmartPointer<vtkDataObject> data;
  try
  {
    const Reader reader = MakeReaderOf(name, solution);
    ProgressLine progress("reading " + name);
    progress.Observe(reader, vtkCommand::ProgressEvent);
    reader->Update();
    data = reader->GetOutputDataObject(0);
  }
  catch (const std::bad_alloc&)
  {
    throw WorkError("cannot read '" + name + "': there is not enough memory, or it is damaged");
  }
  if (!messages.GetError().empty())
  {
    throw WorkError("cannot read '" + name + "': " + messages.GetError());
  }
  if (!data)
  {
    throw WorkError("cannot read '" + name + "': there is nothing in it");
  }
  messages.PrintWarnings();
  return data;
}
