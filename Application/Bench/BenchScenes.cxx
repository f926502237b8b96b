// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchScenes.h"

#include "Bench/BenchOptions.h"
#include "Bench/BenchSettings.h"
#include "Bench/BenchTransferFunctions.h"
#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "Files/GeneratedGrid.h"
#include "Files/ReadMesh.h"
#include "Files/TransferFunctionFile.h"
#include "Generate/GeneratedMeshes.h"
#include "Setup/Arrays.h"
#include "vtkTetrahedralizeCells.h"
#include "vtkTriangleCasterMapper.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkCellIterator.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
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

/// Points along an edge of the generated signal: as many for a period as in the paper, and as few.
constexpr int SignalPoints = 64;
constexpr int QuickSignalPoints = 24;

double GetDiagonal(const BenchScene& scene)
{
  return vtkBoundingBox(scene.GetData()->GetBounds()).GetDiagonalLength();
}

/// Returns the range of the scene's scalars.
std::array<double, 2> GetRange(const BenchScene& scene)
{
  std::array<double, 2> range;
  vtkDataSet* data = scene.GetData();
  vtkDataSetAttributes* attributes =
    scene.CellData ? static_cast<vtkDataSetAttributes*>(data->GetCellData()) : data->GetPointData();
  attributes->GetScalars()->GetFiniteRange(range.data());
  return range;
}

/// The chosen scalars as an array of one component, since not every method can choose an array or a
/// component. values: the array that was chosen.
vtkSmartPointer<vtkDoubleArray> MakeScalars(const ArrayChoice& choice, vtkDataArray* values)
{
  auto scalars = vtkSmartPointer<vtkDoubleArray>::New();
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
  return scalars;
}

/// Sets the tetrahedra of any data as the mesh. It keeps only the chosen scalars.
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
  const vtkSmartPointer<vtkDoubleArray> scalars =
    MakeScalars(choice, attributes->GetArray(choice.Array.Name.c_str()));
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

/// Why the method of image data can't render the chosen scalars; empty if it can.
std::string FindImageObstacle(vtkDataObject* data, const ArrayChoice& choice)
{
  vtkNew<vtkTriangleCasterMapper> mapper;
  mapper->SetInputDataObject(data);
  mapper->SetScalarMode(choice.Array.CellData ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA
                                              : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  mapper->SelectScalarArray(choice.Array.Name.c_str());
  mapper->SetVectorModeToMagnitude();
  return mapper->GetObstacle();
}

/// Sets image data with the chosen scalars alone. An array of one component keeps its type.
void SetImage(BenchScene& scene, vtkImageData* image, const ArrayChoice& choice)
{
  scene.Image = vtkSmartPointer<vtkImageData>::New();
  scene.Image->CopyStructure(image);
  vtkSmartPointer<vtkDataArray> scalars =
    image->GetPointData()->GetArray(choice.Array.Name.c_str());
  if (scalars->GetNumberOfComponents() > 1)
  {
    scalars = MakeScalars(choice, scalars);
  }
  scene.Image->GetPointData()->SetScalars(scalars);
}

/// Lowers opacities of image data to this at most. What has an opacity of 1 there is opaque in any
/// length, so that a picture would depend on how the scalar of such a node is rounded.
constexpr double LargestOpacity = 0.95;

void LimitOpacities(vtkPiecewiseFunction* opacities)
{
  for (int node = 0; node < opacities->GetSize(); ++node)
  {
    double values[4]; // scalar, opacity, midpoint, sharpness
    opacities->GetNodeValue(node, values);
    values[1] = std::min(values[1], LargestOpacity);
    opacities->SetNodeValue(node, values);
  }
}

void SetTransferFunction(BenchScene& scene, const std::string& name)
{
  scene.Property = GetBenchTransferFunction(name).Make(
    GetRange(scene).data(), DefaultUnitDistanceFraction * GetDiagonal(scene));
  if (scene.IsOfImages())
  {
    LimitOpacities(scene.Property->GetScalarOpacity());
  }
}

std::string DescribeImage(const std::string& what, const BenchScene& scene)
{
  const int* size = scene.Image->GetDimensions();
  return what + ", image data of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) +
    " x " + std::to_string(size[2]) + " points";
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
  return { name, false,
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
  return { name, false,
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

/// The test signal of Marschner and Lobb, An Evaluation of Reconstruction Filters for Volume
/// Rendering (1994), on its cube from -1 to 1: waves that become shorter outwards.
vtkSmartPointer<vtkImageData> MakeSignal(int points)
{
  constexpr double Pi = vtkMath::Pi();
  constexpr double Depth = 0.25;
  // There are 40 points for 6 periods in the paper.
  const double frequency = 6.0 / 40 * points;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(points, points, points);
  image->SetOrigin(-1, -1, -1);
  const double spacing = 2.0 / (points - 1);
  image->SetSpacing(spacing, spacing, spacing);
  vtkNew<vtkFloatArray> scalars;
  scalars->SetName(ScalarName);
  scalars->SetNumberOfValues(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    const double wave = std::cos(2 * Pi * frequency * std::cos(0.5 * Pi * std::hypot(x[0], x[1])));
    const double value = (1 - std::sin(0.5 * Pi * x[2]) + Depth * (1 + wave)) / (2 * (1 + Depth));
    scalars->SetValue(i, static_cast<float>(value));
  }
  image->GetPointData()->SetScalars(scalars);
  return image;
}

/// A scene of the signal with one of the transfer functions.
BenchSceneMaker MakeSignalMaker(int points, const std::string& function)
{
  const std::string name = "signal-" + function;
  return { name, true,
    [=]
    {
      BenchScene scene;
      scene.Name = name;
      scene.Image = MakeSignal(points);
      scene.Description = DescribeImage("signal of Marschner and Lobb", scene) + "; " +
        GetBenchTransferFunction(function).Description;
      SetTransferFunction(scene, function);
      return scene;
    } };
}

/// A scene of a file of real image data.
BenchSceneMaker MakeImageFileMaker(const std::string& name, const std::string& title,
  const std::string& fileName, const std::string& function)
{
  return { name, true,
    [=]
    {
      BenchScene scene;
      scene.Name = name;
      const vtkSmartPointer<vtkDataObject> data = ReadMesh({ fileName, {}, {}, {} }).Data;
      const ArrayChoice choice = ChooseArray(data, "", "");
      const std::string obstacle = FindImageObstacle(data, choice);
      if (!obstacle.empty())
      {
        throw WorkError("'" + fileName + "': " + obstacle);
      }
      SetImage(scene, vtkImageData::SafeDownCast(data), choice);
      scene.Description =
        DescribeImage(title, scene) + "; " + GetBenchTransferFunction(function).Description;
      SetTransferFunction(scene, function);
      return scene;
    } };
}

/// Sets what a user's file holds: image data if the settings do not ask for cells, and the method
/// for them can render it; else the tetrahedra.
void SetData(BenchScene& scene, const SceneOptions& options, BenchData data, const MeshData& mesh)
{
  const ArrayChoice choice = ChooseArray(mesh.Data, options.Array, options.Component);
  const std::string obstacle = FindImageObstacle(mesh.Data, choice);
  if (data == BenchData::Images && !obstacle.empty())
  {
    throw WorkError("'" + options.Input.Name + "': " + obstacle);
  }
  if (data != BenchData::Cells && obstacle.empty())
  {
    SetImage(scene, vtkImageData::SafeDownCast(mesh.Data), choice);
    scene.Description = DescribeImage(scene.Name, scene);
    return;
  }
  SetMesh(scene, mesh.Data, options.Array, options.Component);
  scene.Description = DescribeMesh(scene.Name, scene);
}

BenchSceneMaker MakeUserMaker(const SceneOptions& options, BenchData data)
{
  const std::string name = std::filesystem::path(options.Input.Name).stem().string();
  return { name, data == BenchData::Images,
    [options, name, data]
    {
      BenchScene scene;
      scene.Name = name;
      const MeshData mesh = ReadMesh(options.Input);
      NoteTimeSteps(options.Input, mesh);
      SetData(scene, options, data, mesh);
      ColorAndOpacity functions;
      if (options.TransferFile.empty())
      {
        MakeDefaultTransferFunction(GetRange(scene).data(), functions);
      }
      else
      {
        ReadTransferFunction(options.TransferFile, functions);
      }
      scene.Property = vtkSmartPointer<vtkVolumeProperty>::New();
      scene.Property->SetColor(functions.Color);
      scene.Property->SetScalarOpacity(functions.Opacity);
      scene.Property->SetInterpolationTypeToLinear();
      scene.Property->SetScalarOpacityUnitDistance(
        options.OpacityUnitDistance.value_or(DefaultUnitDistanceFraction * GetDiagonal(scene)));
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
  const std::string engine = file("engine.vti");
  if (std::filesystem::exists(engine))
  {
    makers.push_back(MakeImageFileMaker("engine-smooth", "engine", engine, "smooth"));
    makers.push_back(MakeImageFileMaker("engine-opaque", "engine", engine, "opaque"));
  }
  return makers;
}

std::vector<BenchSceneMaker> ListAllScenes(const BenchOptions& options)
{
  if (!options.Scene.Input.Name.empty())
  {
    return { MakeUserMaker(options.Scene, FindBenchData(options)) };
  }
  if (options.Quick)
  {
    const std::map<std::string, double> small = { { "cells", QuickCells } };
    return { MakeMaker("ball-smooth", "ball", small, "smooth", false),
      MakeMaker("ball-needle", "ball", small, "needle", false),
      MakeMaker("ball-cells", "ball", small, "steps", true),
      MakeSignalMaker(QuickSignalPoints, "smooth") };
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
  makers.push_back(MakeSignalMaker(SignalPoints, "smooth"));
  makers.push_back(MakeSignalMaker(SignalPoints, "needle"));
  return makers;
}

/// Leaves out the scenes of the other kind if the settings are of one kind.
void LimitToData(BenchData data, std::vector<BenchSceneMaker>& makers)
{
  makers.erase(std::remove_if(makers.begin(), makers.end(),
                 [data](const BenchSceneMaker& maker)
                 {
                   return (data == BenchData::Images && !maker.OfImages) ||
                     (data == BenchData::Cells && maker.OfImages);
                 }),
    makers.end());
}

} // namespace

std::vector<BenchSceneMaker> ListScenes(const BenchOptions& options)
{
  std::vector<BenchSceneMaker> all = ListAllScenes(options);
  LimitToData(FindBenchData(options), all);
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
