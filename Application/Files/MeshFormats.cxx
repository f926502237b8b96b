// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MeshFormats.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "Files/FileChecks.h"
#include "Files/FileSeries.h"

#include "vtkAVSucdReader.h"
#include "vtkCGNSReader.h"
#include "vtkExodusIIReader.h"
#include "vtkFLUENTReader.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkGenericEnSightReader.h"
#include "vtkHDFReader.h"
#include "vtkMultiBlockPLOT3DReader.h"
#include "vtkNrrdReader.h"
#include "vtkOpenFOAMReader.h"
#include "vtkSLCReader.h"
#include "vtkTecplotReader.h"
#include "vtkXMLGenericDataObjectReader.h"

#include <algorithm>
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

Reader MakeXmlReader(const std::string& fileName)
{
  CheckAmrLevels(fileName);
  return MakeReader<vtkXMLGenericDataObjectReader>(fileName);
}

/// How HDF5 files begin.
const std::string HdfBeginning = "\x89HDF";

Reader MakeExodusReader(const std::string& fileName)
{
  // Exodus files are NetCDF, in its classic form or over HDF5.
  CheckBeginning(fileName, { "CDF", HdfBeginning }, "an Exodus file");
  auto reader = vtkSmartPointer<vtkExodusIIReader>::New();
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  for (int type : { vtkExodusIIReader::NODAL, vtkExodusIIReader::ELEM_BLOCK })
  {
    reader->SetAllArrayStatus(type, 1);
  }
  return reader;
}

/// Throws WorkError if the reader itself refuses a file.
template <class ReaderT>
void CheckAccepted(ReaderT* reader, const std::string& fileName)
{
  if (!reader->CanReadFile(fileName.c_str()))
  {
    throw WorkError("cannot read '" + fileName + "': it is damaged, or of another format");
  }
}

Reader MakeHdfReader(const std::string& fileName)
{
  CheckBeginning(fileName, { HdfBeginning }, "an HDF5 file");
  auto reader = vtkSmartPointer<vtkHDFReader>::New();
  CheckAccepted(reader.Get(), fileName);
  reader->SetFileName(fileName.c_str());
  return reader;
}

Reader MakeCgnsReader(const std::string& fileName)
{
  CheckBeginning(fileName, { "@(#)ADF Database", HdfBeginning }, "a CGNS file");
  auto reader = vtkSmartPointer<vtkCGNSReader>::New();
  CheckAccepted(reader.Get(), fileName); // the library ends the program at some damaged files
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  reader->EnableAllBases();
  reader->EnableAllPointArrays();
  reader->EnableAllCellArrays();
  return reader;
}

Reader MakeEnSightReader(const std::string& fileName)
{
  CheckWords(fileName, { "FORMAT" }, "a case file of EnSight");
  auto reader = vtkSmartPointer<vtkGenericEnSightReader>::New();
  reader->SetCaseFileName(fileName.c_str());
  return reader;
}

Reader MakeUcdReader(const std::string& fileName)
{
  CheckUcd(fileName);
  return MakeReader<vtkAVSucdReader>(fileName);
}

Reader MakeFluentReader(const std::string& fileName)
{
  CheckBeginning(fileName, { "(" }, "a case file of Fluent");
  CheckParentheses(fileName);
  return MakeReader<vtkFLUENTReader>(fileName);
}

Reader MakeTecplotReader(const std::string& fileName)
{
  CheckWords(fileName, { "VARIABLES", "ZONE" }, "a Tecplot file in ASCII");
  return MakeReader<vtkTecplotReader>(fileName);
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
      "VTK XML", MakeXmlReader },
    { { ".vtk" }, "VTK legacy", MakeLegacyReader },
    { { ".vtkhdf" }, "VTK HDF", MakeHdfReader },
    { { ".ex2", ".e", ".exo", ".exo2", ".exii", ".g", ".gen" },
      "Exodus II, also in pieces as .e.4.0 and restarted as .e-s002", MakeExodusReader },
    { { ".cgns" }, "CGNS", MakeCgnsReader },
    { { ".case" }, "EnSight", MakeEnSightReader },
    { { ".foam" }, "OpenFOAM", MakeReader<vtkOpenFOAMReader> },
    { { ".cas" }, "Fluent", MakeFluentReader },
    { { ".tec", ".dat", ".plt" }, "Tecplot in ASCII", MakeTecplotReader },
    { { ".inp" }, "AVS UCD", MakeUcdReader },
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

/// A format that VTK has no reader for, and what makes a file that it reads.
struct ForeignFormat
{
  std::string Extension;
  std::string Description;
  std::string Converter; ///< its command is Converter IN Output
  std::string Output;
};

const std::vector<ForeignFormat>& GetForeignFormats()
{
  const std::string meshio = "meshio convert";
  static const std::vector<ForeignFormat> formats = {
    { ".msh", "Gmsh", meshio, "out.vtu" },
    { ".xdmf", "XDMF", meshio, "out.vtu" },
    { ".xmf", "XDMF", meshio, "out.vtu" },
    { ".med", "MED", meshio, "out.vtu" },
    { ".unv", "I-DEAS universal", "gmsh -save", "-o out.vtk" },
  };
  return formats;
}

void RefuseForeignFormat(const std::string& fileName, const std::string& extension)
{
  for (const ForeignFormat& format : GetForeignFormats())
  {
    if (format.Extension == extension)
    {
      throw WorkError("cannot read '" + fileName + "': no reader for the format " +
        format.Description + " is here; convert it, as by: " + format.Converter + " " + fileName +
        " " + format.Output);
    }
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

} // namespace

vtkSmartPointer<vtkAlgorithm> MakeMeshReader(
  const std::string& fileName, const std::string& extension, const std::string& plot3dSolution)
{
  CheckReadable(fileName);
  if (!plot3dSolution.empty() || Contains(GetPlot3dExtensions(), extension))
  {
    return MakePlot3dReader(fileName, plot3dSolution);
  }
  for (const Format& format : GetFormats())
  {
    if (Contains(format.Extensions, extension))
    {
      return format.Make(fileName);
    }
  }
  RefuseForeignFormat(fileName, extension);
  throw WorkError("cannot read '" + fileName + "': its extension is none of " + GetInputHelp());
}

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
  text += ", ";
  append(GetSeriesExtensions(), "lists of such files, with their times");
  return text;
}
