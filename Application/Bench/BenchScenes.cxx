// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchScenes.h"

#include "Bench/BenchOptions.h"
#include "Bench/BenchTransferFunctions.h"
#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "Files/GeneratedGrid.h"
#include "Files/ReadMesh.h"
#include "Files/TransferFunctionFile.h"
#include "Generate/GeneratedMeshes.h"
#include "Setup/Arrays.h"
#include "vtkTetrahedralizeCells.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkCellIterator.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace
{

constexpr const char* ScalarName = "Scalar";

/// Cells along an edge of a quick run's balls.
constexpr int QuickCells = 8;

double GetDiagonal(vtkUnstructuredGrid* mesh)
{
  return vtkBoundingBox(mesh->GetBounds()).GetDiagonalLength();
}

/// Returns the range of the scene's scalars.
std::array<double, 2> GetRange(const BenchScene& scene)
{
  std::array<double, 2> range;
  vtkDataSetAttributes* attributes = scene.CellData
    ? static_cast<vtkDataSetAttributes*>(scene.Mesh->GetCellData())
    : scene.Mesh->GetPointData();
  attributes->GetScalars()->GetFiniteRange(range.data());
  return range;
}

/// Sets the tetrahedra of any data as the mesh. It keeps only the chosen scalars, as an array of
/// one component, since not every method can choose an array or a component.
void SetMesh(
  BenchScene& scene, vtkDataObject* data, const std::string& array, const std::string& component)
{
  const ArrayChoice choice = ChooseArray(data, array, component);
  vtkNew<vtkTetrahedralizeCells> filter;
  filter->SetInputDataObject(data);
  filter->Update();
  vtkUnstructuredGrid* tetrahedra = filter->GetOutput();
  if (tetrahedra->GetNumberOfCells() == 0)
  {
    throw WorkError("'" + scene.Name + "': none of its cells can be rendered as a volume");
  }
  vtkDataSetAttributes* attributes = choice.Array.CellData
    ? static_cast<vtkDataSetAttributes*>(tetrahedra->GetCellData())
    : tetrahedra->GetPointData();
  vtkDataArray* values = attributes->GetArray(choice.Array.Name.c_str());

  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  scalars->SetNumberOfValues(values->GetNumberOfTuples());
  std::vector<double> tuple(values->GetNumberOfComponents());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    values->GetTuple(i, tuple.data());
    double value = tuple[choice.Component];
    if (choice.Magnitude)
    {
      value = 0;
      for (const double x : tuple)
      {
        value = std::hypot(value, x);
      }
    }
    scalars->SetValue(i, value);
  }
  scene.Mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  scene.Mesh->CopyStructure(tetrahedra);
  scene.CellData = choice.Array.CellData;
  if (scene.CellData)
  {
    scene.Mesh->GetCellData()->SetScalars(scalars);
  }
  else
  {
    scene.Mesh->GetPointData()->SetScalars(scalars);
  }
}

void SetTransferFunction(BenchScene& scene, const std::string& name)
{
  scene.Property = GetBenchTransferFunction(name).Make(
    GetRange(scene).data(), DefaultUnitDistanceFraction * GetDiagonal(scene.Mesh));
}

/// Replaces the scalars of points by scalars of cells: each cell gets the mean of its points.
void MakeCellData(BenchScene& scene)
{
  vtkDataArray* values = scene.Mesh->GetPointData()->GetScalars();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  scalars->SetNumberOfValues(scene.Mesh->GetNumberOfCells());
  auto cell = vtkSmartPointer<vtkCellIterator>::Take(scene.Mesh->NewCellIterator());
  for (cell->InitTraversal(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdList* points = cell->GetPointIds();
    double sum = 0;
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      sum += values->GetTuple1(points->GetId(i));
    }
    scalars->SetValue(cell->GetCellId(), sum / points->GetNumberOfIds());
  }
  scene.Mesh->GetPointData()->Initialize();
  scene.Mesh->GetCellData()->SetScalars(scalars);
  scene.CellData = true;
}

BenchScene MakeGenerated(
  const std::string& generator, const std::map<std::string, double>& parameters, bool cellData)
{
  BenchScene scene;
  scene.Name = generator;
  SetMesh(scene, MakeGrid(tetralux::GenerateMesh(generator, parameters)), "", "");
  if (cellData)
  {
    MakeCellData(scene);
  }
  SetTransferFunction(scene, "smooth");
  return scene;
}

std::string DescribeMesh(const std::string& what, const BenchScene& scene)
{
  return what + ", " + std::to_string(scene.Mesh->GetNumberOfCells()) + " tetrahedra";
}

/// A generated scene with one of the transfer functions.
BenchSceneMaker MakeMaker(const std::string& name, const std::string& generator,
  const std::map<std::string, double>& parameters, const std::string& function, bool cellData)
{
  return { name,
    [=]
    {
      BenchScene scene = MakeGenerated(generator, parameters, cellData);
      scene.Name = name;
      scene.Description =
        DescribeMesh("generated " + generator + (cellData ? " with cell data" : ""), scene) + "; " +
        GetBenchTransferFunction(function).Description;
      SetTransferFunction(scene, function);
      return scene;
    } };
}

/// A scene of a file of the real data.
BenchSceneMaker MakeFileMaker(const std::string& name, const std::string& title,
  const std::string& fileName, const std::string& solution, const std::string& array,
  const std::string& function)
{
  return { name,
    [=]
    {
      BenchScene scene;
      scene.Name = name;
      SetMesh(scene, ReadMesh({ fileName, solution, {}, {} }).Data, array, "");
      scene.Description = DescribeMesh(title + ", " + array, scene) + "; " +
        GetBenchTransferFunction(function).Description;
      SetTransferFunction(scene, function);
      return scene;
    } };
}

BenchSceneMaker MakeUserMaker(const SceneOptions& options)
{
  const std::string name = std::filesystem::path(options.Input.Name).stem().string();
  return { name,
    [options, name]
    {
      BenchScene scene;
      scene.Name = name;
      const MeshData mesh = ReadMesh(options.Input);
      NoteTimeSteps(options.Input, mesh);
      SetMesh(scene, mesh.Data, options.Array, options.Component);
      ColorAndOpacity functions;
      if (options.TransferFile.empty())
      {
        MakeDefaultTransferFunction(GetRange(scene).data(), functions);
      }
      else
      {
        ReadTransferFunction(options.TransferFile, functions);
      }
      scene.Description = DescribeMesh(name, scene);
      scene.Property = vtkSmartPointer<vtkVolumeProperty>::New();
      scene.Property->SetColor(functions.Color);
      scene.Property->SetScalarOpacity(functions.Opacity);
      scene.Property->SetInterpolationTypeToLinear();
      scene.Property->SetScalarOpacityUnitDistance(options.OpacityUnitDistance.value_or(
        DefaultUnitDistanceFraction * GetDiagonal(scene.Mesh)));
      return scene;
    } };
}

std::vector<BenchSceneMaker> ListDataScenes(const std::string& folder)
{
  const auto file = [&folder](const char* name)
  { return (std::filesystem::path(folder) / name).string(); };
  std::vector<BenchSceneMaker> makers;
  for (const BenchTransferFunction& function : GetBenchTransferFunctions())
  {
    makers.push_back(MakeFileMaker("blunt-fin-" + function.Name, "NASA blunt fin",
      file("bluntfinxyz.bin"), file("bluntfinq.bin"), "Density", function.Name));
  }
  makers.push_back(
    MakeFileMaker("can-cells", "crushed can, cell data", file("can.vtu"), "", "EQPS", "smooth"));
  return makers;
}

std::vector<BenchSceneMaker> ListAllScenes(const BenchOptions& options)
{
  if (!options.Scene.Input.Name.empty())
  {
    return { MakeUserMaker(options.Scene) };
  }
  if (options.Quick)
  {
    const std::map<std::string, double> small = { { "cells", QuickCells } };
    return { MakeMaker("ball-smooth", "ball", small, "smooth", false),
      MakeMaker("ball-needle", "ball", small, "needle", false),
      MakeMaker("ball-cells", "ball", small, "steps", true) };
  }
  std::vector<BenchSceneMaker> makers;
  if (!options.DataFolder.empty())
  {
    makers = ListDataScenes(options.DataFolder);
  }
  for (const BenchTransferFunction& function : GetBenchTransferFunctions())
  {
    makers.push_back(MakeMaker("ring-" + function.Name, "ring", {}, function.Name, false));
  }
  makers.push_back(MakeMaker("gear-smooth", "gear", {}, "smooth", false));
  makers.push_back(MakeMaker("ball-cells", "ball", {}, "steps", true));
  return makers;
}

} // namespace

std::vector<BenchSceneMaker> ListScenes(const BenchOptions& options)
{
  std::vector<BenchSceneMaker> all = ListAllScenes(options);
  if (options.Scenes.empty())
  {
    return all;
  }
  std::vector<BenchSceneMaker> chosen;
  for (const std::string& name : options.Scenes)
  {
    const auto found = std::find_if(
      all.begin(), all.end(), [&name](const BenchSceneMaker& maker) { return maker.Name == name; });
    if (found == all.end())
    {
      std::vector<std::string> names;
      names.reserve(all.size());
      for (const BenchSceneMaker& maker : all)
      {
        names.push_back(maker.Name);
      }
      throw UsageError("--scene: there is no scene '" + name + "'; there are " + JoinNames(names));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

BenchScene MakeBallScene(int cells, bool cellData)
{
  return MakeGenerated("ball", { { "cells", cells } }, cellData);
}

BenchScene MakeGeneratedScene(
  const std::string& generator, const std::map<std::string, double>& parameters)
{
  return MakeGenerated(generator, parameters, false);
}
