// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurfaces/IsosurfaceScene.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "Files/GeneratedGrid.h"
#include "Files/ReadMesh.h"
#include "Generate/GeneratedMeshes.h"
#include "Intake/TetrahedraIntake.h"
#include "Setup/Arrays.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataSet.h"
#include "vtkCompositeDataSetRange.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

namespace tetralux
{
namespace
{

constexpr int NumberOfSteps = 3;

/// Between two steps, in periods of a generator: a surface moves by some of its cells.
constexpr double TimeBetweenSteps = 0.02;

/// Between two isovalues, and between two steps of a file, as a share of the scalars' range.
constexpr double ScalarShift = 0.01;

using Parameters = std::map<std::string, double>;

const Generator* FindGenerator(const std::string& name)
{
  for (const Generator& generator : GetGenerators())
  {
    if (generator.Name == name)
    {
      return &generator;
    }
  }
  return nullptr;
}

bool HasTime(const Generator& generator)
{
  return std::any_of(generator.Parameters.begin(), generator.Parameters.end(),
    [](const GeneratorParameter& parameter) { return parameter.Name == "time"; });
}

Parameters ReadParameters(const std::string& text)
{
  Parameters parameters;
  std::istringstream stream(text);
  for (std::string assignment; std::getline(stream, assignment, ',');)
  {
    const auto [name, value] = ParseAssignment("MESH", assignment);
    parameters[name] = ParseNumber(name, value);
  }
  return parameters;
}

GeneratedMesh Generate(const std::string& name, const Parameters& parameters)
{
  try
  {
    return GenerateMesh(name, parameters);
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(error.what());
  }
}

vtkSmartPointer<vtkDoubleArray> MakeScalars(const std::vector<double>& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("Field");
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

/// The only data set of what was read.
vtkDataSet* GetDataSet(vtkDataObject* data, const std::string& name)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return vtkDataSet::SafeDownCast(data);
  }
  const auto blocks = vtk::Range(composite, vtk::CompositeDataSetOptions::SkipEmptyNodes);
  if (std::distance(blocks.begin(), blocks.end()) != 1)
  {
    throw WorkError("'" + name + "': it has more than one block");
  }
  return vtkDataSet::SafeDownCast((*blocks.begin()).GetDataObject());
}

/// The tetrahedra of a file, with the scalars of their points.
GeneratedMesh ReadTetrahedra(const std::string& name, const std::string& array)
{
  InputFile file;
  file.Name = name;
  const MeshData read = ReadMesh(file);
  vtkDataSet* data = GetDataSet(read.Data, name);
  const ArrayChoice choice = ChooseArray(data, array, "");
  vtkDataArray* scalars = data->GetPointData()->GetArray(choice.Array.Name.c_str());
  TetrahedraIntake intake = TakeInTetrahedra(data);
  if (choice.Array.CellData || choice.Array.Components != 1 || !intake.Error.empty() ||
    !intake.Mesh.AddedPoints.Offsets.empty())
  {
    throw WorkError(
      "'" + name + "': it needs scalars at points, and cells that are split without new points");
  }
  GeneratedMesh result;
  result.Mesh = std::move(intake.Mesh);
  for (vtkIdType p = 0; p < scalars->GetNumberOfTuples(); ++p)
  {
    result.Scalars.push_back(scalars->GetComponent(p, 0));
  }
  return result;
}

} // namespace

IsosurfaceScene MakeIsosurfaceScene(
  const std::string& mesh, const std::string& array, double isovalue)
{
  const std::size_t colon = mesh.find(':');
  const Generator* generator = FindGenerator(mesh.substr(0, colon));
  const Parameters parameters =
    generator && colon != std::string::npos ? ReadParameters(mesh.substr(colon + 1)) : Parameters();
  const GeneratedMesh first =
    generator ? Generate(generator->Name, parameters) : ReadTetrahedra(mesh, array);
  const auto [lowest, highest] = std::minmax_element(first.Scalars.begin(), first.Scalars.end());
  const double shift = ScalarShift * (*highest - *lowest);

  IsosurfaceScene scene;
  scene.Grid = MakeGrid(first);
  // What VTK's own readers make. With ids of 32 bits, threads that build VTK's scalar tree share
  // the memory of a cell's points: cells are lost.
  scene.Grid->GetCells()->ConvertTo64BitStorage();
  scene.Isovalues = { isovalue, isovalue + shift, isovalue - shift };
  scene.Steps = { MakeScalars(first.Scalars) };
  scene.Grid->GetPointData()->SetScalars(scene.Steps.front());
  for (int step = 1; step < NumberOfSteps; ++step)
  {
    if (generator && HasTime(*generator))
    {
      Parameters moment = parameters;
      moment["time"] += step * TimeBetweenSteps;
      scene.Steps.push_back(MakeScalars(Generate(generator->Name, moment).Scalars));
      continue;
    }
    std::vector<double> moved = first.Scalars;
    std::for_each(moved.begin(), moved.end(), [&](double& scalar) { scalar += step * shift; });
    scene.Steps.push_back(MakeScalars(moved));
  }
  return scene;
}

} // namespace tetralux
