// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/InfoCommand.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "CommandLine/ProgressLine.h"
#include "CommandLine/StandardStreams.h"
#include "Files/ReadMesh.h"
#include "Intake/LeftOutCells.h"
#include "Intake/PointExtraction.h"
#include "Intake/TetrahedraIntake.h"
#include "Mesh/CellVolumes.h"
#include "Mesh/CoincidentPoints.h"
#include "Setup/Arrays.h"
#include "Setup/MethodCosts.h"
#include "Setup/SceneOptionGroups.h"
#include "Walk/WalkMesh.h"
#include "vtkTriangleCasterMapper.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>

namespace
{

/// Width of the column of labels.
constexpr int LabelWidth = 28;

template <class ValueT>
void PrintRow(const std::string& label, const ValueT& value)
{
  std::ostringstream row;
  row << std::left << std::setw(LabelWidth) << label << " " << value;
  std::cout << EscapeControls(row.str()) << "\n"; // names may have line breaks
}

/// Prints a row only if the count is above 0: for defects and for cells left out.
void PrintCount(const std::string& label, std::int64_t count)
{
  if (count > 0)
  {
    PrintRow(label, count);
  }
}

std::string FormatMegabytes(std::size_t bytes)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << static_cast<double>(bytes) / 1e6 << " MB";
  return text.str();
}

std::string FormatSeconds(double seconds)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << seconds << " s";
  return text.str();
}

template <class FunctionT>
double MeasureSeconds(FunctionT&& function)
{
  const auto start = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string FormatRange(const std::array<double, 2>& range)
{
  return range[0] > range[1] ? "no finite value"
                             : FormatNumber(range[0]) + " .. " + FormatNumber(range[1]);
}

void PrintArrays(vtkDataObject* data)
{
  const std::vector<ArraySummary> arrays = ListArrays(data);
  if (arrays.empty())
  {
    PrintRow("arrays", "none");
  }
  for (const ArraySummary& array : arrays)
  {
    std::string text = std::string(vtkImageScalarTypeNameMacro(array.DataType)) + ", ";
    if (array.Components == 1)
    {
      text += FormatRange(array.Ranges[0]);
    }
    else
    {
      text += std::to_string(array.Components) + " components, magnitude " +
        FormatRange(array.MagnitudeRange);
      for (int component = 0; component < array.Components; ++component)
      {
        text += "; " + std::to_string(component) + ": " + FormatRange(array.Ranges[component]);
      }
    }
    if (array.NonFiniteValues > 0)
    {
      text += ", " + std::to_string(array.NonFiniteValues) + " values not finite";
    }
    PrintRow(std::string(array.CellData ? "cell" : "point") + " array " + array.Name, text);
  }
}

void PrintIntake(const tetralux::TetrahedraIntakeReport& report)
{
  if (report.Blocks != 1)
  {
    PrintRow("data sets", report.Blocks);
  }
  PrintCount("blocks without cells", report.SkippedBlocks);
  PrintRow("points", report.NumberOfPoints);
  PrintRow("cells", report.NumberOfCells);
  for (const auto& [type, count] : report.CellsByType)
  {
    PrintRow("  " + tetralux::GetCellTypeName(type), count);
  }
  PrintCount("ghost cells", report.GhostCells);
  PrintCount("blanked cells", report.BlankedCells);
  PrintCount("cells below 3 dimensions", report.LowerDimensionalCells);
}

void PrintBounds(const std::vector<double>& points)
{
  if (points.empty())
  {
    return;
  }
  const double infinity = std::numeric_limits<double>::infinity();
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<double, 2> range = { infinity, -infinity };
    for (std::size_t i = axis; i < points.size(); i += 3)
    {
      range = { std::min(range[0], points[i]), std::max(range[1], points[i]) };
    }
    text += (axis ? ", " : "") + std::string(1, "xyz"[axis]) + " " + FormatRange(range);
  }
  PrintRow("bounds", text);
}

/// Points that MergePoints may take as one with others: inside of the mesh there are none but where
/// cells have points of their own.
std::int64_t CountCoincidentPoints(vtkDataObject* data, const tetralux::TetrahedralMesh& mesh)
{
  std::vector<std::int32_t> points(mesh.GetNumberOfPoints());
  std::iota(points.begin(), points.end(), 0);
  return static_cast<std::int64_t>(
    tetralux::FindCoincidentPoints(mesh, points, tetralux::GetPointTolerance(data)).Points.size());
}

/// Prints what it takes to make the mesh convex, or why it can't be made convex. coincident: points
/// that render may merge.
void PrintConvexification(tetralux::WalkMesh& walk, std::int64_t coincident)
{
  {
    ProgressLine progress("convexifying");
    walk.MakeConvex(
      [&progress](double fraction)
      {
        progress.Show(fraction);
        return true;
      });
  }
  const tetralux::Convexification& convex = *walk.GetConvexification();
  const std::string seconds = FormatSeconds(convex.GetSeconds());
  if (convex.Convex)
  {
    PrintRow("convexification", "none needed: the mesh is convex, " + seconds + " to find out");
    return;
  }
  if (!convex.Refusal.empty())
  {
    PrintRow("convexification",
      "not possible: " + convex.Refusal + ", " + seconds +
        (coincident > 0 ? "; where render merges points it may be" : ""));
    return;
  }
  const double cells = static_cast<double>(walk.GetNumberOfCells());
  PrintRow("convexification",
    std::to_string(convex.GetNumberOfCells()) + " imaginary cells (" +
      FormatNumber(100 * static_cast<double>(convex.GetNumberOfCells()) / cells) + " %), " +
      std::to_string(convex.GetNumberOfSteinerPoints()) + " Steiner points, " + seconds);
}

/// The steps are on one line, as there may be thousands.
void PrintTimeSteps(const MeshData& mesh)
{
  if (mesh.Times.empty())
  {
    return;
  }
  std::string text;
  for (double time : mesh.Times)
  {
    text += (text.empty() ? "" : ", ") + FormatNumber(time);
  }
  PrintRow("time steps", std::to_string(mesh.Times.size()) + ": " + text);
  PrintRow("time step read",
    std::to_string(mesh.TimeStep) + ", time " + FormatNumber(mesh.Times[mesh.TimeStep]));
}

std::string FormatVector(const double vector[3])
{
  return FormatNumber(vector[0]) + ", " + FormatNumber(vector[1]) + ", " + FormatNumber(vector[2]);
}

/// The input as image data that are rendered without splitting their voxels; nullptr if there is
/// something in them that takes that.
vtkImageData* GetImage(vtkDataObject* data)
{
  auto* image = vtkImageData::SafeDownCast(data);
  const std::vector<ArraySummary> arrays = image ? ListArrays(image) : std::vector<ArraySummary>();
  if (arrays.empty())
  {
    return nullptr;
  }
  vtkNew<vtkTriangleCasterMapper> mapper;
  mapper->SetInputData(image);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectScalarArray(arrays.front().Name.c_str());
  return mapper->GetObstacle().empty() ? image : nullptr;
}

void PrintImage(vtkImageData* image)
{
  const int* size = image->GetDimensions();
  const int* extent = image->GetExtent();
  PrintRow("points",
    std::to_string(image->GetNumberOfPoints()) + ": " + std::to_string(size[0]) + " x " +
      std::to_string(size[1]) + " x " + std::to_string(size[2]));
  PrintRow("cells", image->GetNumberOfCells());
  PrintRow("spacing", FormatVector(image->GetSpacing()));
  PrintRow("origin", FormatVector(image->GetOrigin()));
  if (extent[0] != 0 || extent[2] != 0 || extent[4] != 0)
  {
    PrintRow("extent from",
      std::to_string(extent[0]) + ", " + std::to_string(extent[2]) + ", " +
        std::to_string(extent[4]));
  }
  if (!image->GetDirectionMatrix()->IsIdentity())
  {
    const double* direction = image->GetDirectionMatrix()->GetData();
    PrintRow("direction matrix",
      FormatVector(direction) + "; " + FormatVector(direction + 3) + "; " +
        FormatVector(direction + 6));
  }
  const double* bounds = image->GetBounds();
  PrintRow("bounds",
    "x " + FormatRange({ bounds[0], bounds[1] }) + ", y " + FormatRange({ bounds[2], bounds[3] }) +
      ", z " + FormatRange({ bounds[4], bounds[5] }));
  PrintArrays(image);
  PrintRow("tetrahedra", std::to_string(EstimateTetrahedra(image)) + " if its cells were split");
}

void PrintInfo(const InputFile& input)
{
  const MeshData mesh = ReadMesh(input);
  vtkDataObject* data = mesh.Data;
  if (vtkImageData* image = GetImage(data))
  {
    PrintRow("file", input.Name);
    PrintRow("type", data->GetClassName());
    PrintTimeSteps(mesh);
    PrintImage(image);
    return;
  }

  tetralux::TetrahedraIntake intake;
  const double splitSeconds = MeasureSeconds(
    [&]
    {
      ProgressLine progress("splitting cells");
      intake = tetralux::TakeInTetrahedra(data,
        [&progress](double fraction)
        {
          progress.Show(fraction);
          return true;
        });
    });
  if (!intake.Error.empty())
  {
    throw WorkError("'" + input.Name + "': " + intake.Error);
  }

  PrintRow("file", input.Name);
  PrintRow("type", data->GetClassName());
  PrintTimeSteps(mesh);
  PrintIntake(intake.Report);
  PrintBounds(intake.Mesh.Points);
  PrintArrays(data);

  const std::int64_t coincident = CountCoincidentPoints(data, intake.Mesh);
  PrintCount("points at others' places", coincident);

  const std::size_t tetrahedra = intake.Mesh.GetNumberOfCells();
  PrintRow("tetrahedra", tetrahedra);
  PrintCount("points added by splitting",
    static_cast<std::int64_t>(intake.Mesh.GetNumberOfPoints()) - intake.Report.NumberOfPoints);
  const tetralux::CellVolumes volumes = tetralux::MeasureCells(intake.Mesh);
  PrintRow("volume", FormatNumber(volumes.Total));
  PrintRow(
    "edges", FormatNumber(volumes.ShortestEdge) + " .. " + FormatNumber(volumes.LongestEdge));

  std::unique_ptr<tetralux::WalkMesh> walk;
  const double tablesSeconds = MeasureSeconds(
    [&]
    {
      const ProgressLine progress("making tables");
      walk = std::make_unique<tetralux::WalkMesh>(std::move(intake.Mesh));
    });
  PrintRow("boundary faces", walk->GetNumberOfBoundaryFaces());
  PrintRow("components", walk->GetNumberOfComponents());

  const std::vector<tetralux::LeftOutCells> leftOut =
    tetralux::ListLeftOutCells(intake.Report, walk->GetRemovedCells());
  PrintRow("defects",
    leftOut.empty() &&
        volumes.NumberOfZero + volumes.NumberOfInverted + walk->GetNumberOfNonManifoldFaces() == 0
      ? "none"
      : "");
  PrintCount("  zero volume", volumes.NumberOfZero);
  PrintCount("  inverted", volumes.NumberOfInverted);
  PrintCount("  faces of three or more", walk->GetNumberOfNonManifoldFaces());
  for (const tetralux::LeftOutCells& cells : leftOut)
  {
    PrintRow("  left out: " + cells.Reason, cells.Count);
  }

  PrintRow("memory of the tables", FormatMegabytes(walk->GetTableSize()));
  std::string time =
    FormatSeconds(splitSeconds) + " to split, " + FormatSeconds(tablesSeconds) + " for the tables";
  if (tetrahedra > 0)
  {
    time += ", " +
      FormatNumber(1e6 * (splitSeconds + tablesSeconds) / static_cast<double>(tetrahedra)) +
      " microseconds a tetrahedron";
  }
  PrintRow("time to prepare", time);
  PrintConvexification(*walk, coincident);
}

} // namespace

void AddInfoCommand(CLI::App& app)
{
  CLI::App* command =
    app.add_subcommand("info", "Print what is in a file, its defects, and what it takes to render");
  const auto input = std::make_shared<InputFile>();
  AddInputOptions(command, *input)->required();
  command->final_callback([input] { PrintInfo(*input); });
}
