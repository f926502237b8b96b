// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Render.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/MessageCapture.h"
#include "CommandLine/OptionValues.h"
#include "CommandLine/ProgressLine.h"
#include "CommandLine/StandardStreams.h"
#include "Commands/PictureFile.h"
#include "Files/AtomicOutput.h"
#include "Files/ReadMesh.h"
#include "Files/TransferFunctionFile.h"
#include "Files/WriteBytes.h"
#include "Setup/Arrays.h"
#include "Setup/MapperProperties.h"
#include "Setup/MethodCosts.h"
#include "Setup/Methods.h"
#include "Setup/SceneCamera.h"
#include "Setup/VisitMapper.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraVolumeMapper.h"
#include "vtkTriangleCasterMapper.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkCullerCollection.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <optional>
#include <vector>

namespace
{

/// Throws UsageError for what is wrong whatever the input is.
void CheckOptions(const RenderOptions& options)
{
  if (!HasExtension(options.Output, { ".png", ".vti" }))
  {
    throw UsageError("--output: '" + options.Output +
      "' must end in .png or .vti, or be -, a pipe or a device, which get a .png");
  }
  if (!options.StatisticsFile.empty() && !HasExtension(options.StatisticsFile, { ".json" }))
  {
    throw UsageError("--stats: '" + options.StatisticsFile + "' must end in .json");
  }
  if (options.Output == "-" && (options.PrintStatistics || options.StatisticsFile == "-"))
  {
    throw UsageError("--stats: standard output gets the picture, by --output -; name a FILE.json");
  }
  CheckCamera(options.Scene);
}

constexpr const char* ImageMethod = "triangle-caster";

/// Makes a mapper show isosurfaces if there are isovalues. Throws UsageError if other options do
/// not allow it, or ask for isosurfaces without values.
template <class MapperT>
void SetBlendMode(const std::string& method, const RenderOptions& options, MapperT* mapper)
{
  const bool isosurfaces = mapper->GetBlendMode() == MapperT::ISOSURFACE_BLEND;
  if (isosurfaces && options.Isovalues.empty())
  {
    throw UsageError((method == "isosurface" ? "--method isosurface" : "BlendMode=isosurface") +
      std::string(" needs --isovalues A,B,..."));
  }
  if (!options.ColorArray.empty() && !vtkTetrahedraIsosurfaceMapper::SafeDownCast(mapper))
  {
    throw UsageError("--color-array needs --isovalues A,B,... and --method isosurface or auto");
  }
  if (!isosurfaces && !options.Isovalues.empty())
  {
    if (mapper->GetBlendMode() != MapperT::COMPOSITE_BLEND)
    {
      throw UsageError("--isovalues A,B,... and BlendMode=isosurface belong together");
    }
    mapper->SetBlendModeToIsoSurface();
  }
}

/// Throws UsageError if there is a plane without slices, or the other way round.
void CheckSlicePlane(const RenderOptions& options, vtkAbstractVolumeMapper* mapper)
{
  auto* caster = vtkTriangleCasterMapper::SafeDownCast(mapper);
  const bool slices = caster && caster->GetBlendMode() == vtkTriangleCasterMapper::SLICE_BLEND;
  if (slices != !options.SlicePlane.empty())
  {
    throw UsageError("--slice-plane X,Y,Z,NX,NY,NZ and BlendMode=slice belong together");
  }
}

vtkSmartPointer<vtkAbstractVolumeMapper> MakeConfiguredMapper(
  const std::string& method, const RenderOptions& options)
{
  vtkSmartPointer<vtkAbstractVolumeMapper> made =
    MakeMapper(method, options.Scene.NumberOfThreads, options.Settings);
  if (options.MaximumError)
  {
    VisitMapper(made, [&](auto* mapper) { mapper->SetMaximumError(*options.MaximumError); });
  }
  VisitMapper(made, [&](auto* mapper) { SetBlendMode(method, options, mapper); });
  CheckSlicePlane(options, made);
  return made;
}

/// Whether image data are rendered as they are, if no method is named.
bool MayRenderImages(const RenderOptions& options)
{
  return options.Method == "auto" && options.Isovalues.empty() && options.ColorArray.empty() &&
    TakesSettings(ImageMethod, options.Scene.NumberOfThreads, options.Settings);
}

std::vector<MethodChoice> ListMethodsFor(const RenderOptions& options, vtkRenderWindow* window)
{
  // The window may fail to make an OpenGL context.
  const MessageCapture messages;
  std::vector<MethodChoice> methods = ListMethods(options.Method, window,
    options.Scene.NumberOfThreads, options.Settings, !options.Isovalues.empty());
  if (!messages.GetError().empty())
  {
    throw WorkError(messages.GetError());
  }
  return methods;
}

/// What is rendered: the data, the scalars that are shown, their colour and opacity.
struct RenderInput
{
  vtkSmartPointer<vtkDataObject> Data;
  ArrayChoice Scalars;
  std::string ColorArray; ///< empty: coloured by the scalars
  ColorAndOpacity Functions;
};

RenderInput ReadInput(const SceneOptions& options, const std::string& colorArray)
{
  RenderInput input;
  input.ColorArray = colorArray;
  if (!options.TransferFile.empty())
  {
    ReadTransferFunction(options.TransferFile, input.Functions);
  }
  const MeshData mesh = ReadMesh(options.Input);
  NoteTimeSteps(options.Input, mesh);
  input.Data = mesh.Data;
  input.Scalars = ChooseArray(input.Data, options.Array, options.Component);
  if (options.TransferFile.empty())
  {
    MakeDefaultTransferFunction(
      (colorArray.empty() ? input.Scalars
                          : ChooseArray(input.Data, colorArray, "", "--color-array"))
        .Range.data(),
      input.Functions);
  }
  return input;
}

void SetInputData(const RenderInput& input, vtkTetrahedraVolumeMapper* mapper)
{
  if (auto* tracer = vtkTetrahedraIsosurfaceMapper::SafeDownCast(mapper))
  {
    tracer->SetColorArrayName(input.ColorArray.empty() ? nullptr : input.ColorArray.c_str());
  }
  mapper->SetInputData(input.Data.GetPointer());
}

void SetInputData(const RenderInput& input, vtkTriangleCasterMapper* mapper)
{
  auto* image = vtkImageData::SafeDownCast(input.Data);
  if (!image)
  {
    throw WorkError("--method: '" + std::string(ImageMethod) +
      "' renders image data; these are a " + input.Data->GetClassName());
  }
  mapper->SetInputData(image);
}

void SetInput(const RenderInput& input, vtkAbstractVolumeMapper* mapper)
{
  const ArrayChoice& scalars = input.Scalars;
  mapper->SetScalarMode(scalars.Array.CellData ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA
                                               : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  mapper->SelectScalarArray(scalars.Array.Name.c_str());
  VisitMapper(mapper,
    [&](auto* visited)
    {
      visited->SetVectorMode(scalars.Magnitude ? visited->MAGNITUDE_MODE : visited->COMPONENT_MODE);
      visited->SetVectorComponent(scalars.Component);
      SetInputData(input, visited);
    });
}

/// Whether the input is an image that the method for them can render.
bool IsImage(const RenderInput& input)
{
  if (!vtkImageData::SafeDownCast(input.Data))
  {
    return false;
  }
  vtkNew<vtkTriangleCasterMapper> mapper;
  SetInput(input, mapper);
  return mapper->GetObstacle().empty();
}

vtkSmartPointer<vtkVolumeProperty> MakeProperty(
  const RenderOptions& options, const ColorAndOpacity& functions, const double bounds[6])
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(functions.Color);
  property->SetScalarOpacity(functions.Opacity);
  property->SetScalarOpacityUnitDistance(options.Scene.OpacityUnitDistance.value_or(
    DefaultUnitDistanceFraction * vtkBoundingBox(bounds).GetDiagonalLength()));
  for (std::size_t i = 0; i < options.Isovalues.size(); ++i)
  {
    property->GetIsoSurfaceValues()->SetValue(static_cast<int>(i), options.Isovalues[i]);
  }
  if (!options.SlicePlane.empty())
  {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(options.SlicePlane.data());
    plane->SetNormal(options.SlicePlane.data() + 3);
    property->SetSliceFunction(plane);
  }
  // Without light, surfaces show no shape.
  property->SetShade(options.Shade || !options.Isovalues.empty());
  return property;
}

/// Shows a volume in a window, from the camera of the options.
void ShowVolume(const RenderOptions& options, const RenderInput& input, vtkVolume* volume,
  vtkRenderWindow* window)
{
  double bounds[6];
  volume->GetMapper()->GetBounds(bounds);
  if (!vtkBoundingBox(bounds).IsValid())
  {
    throw WorkError("'" + options.Scene.Input.Name + "': it has no points");
  }
  volume->SetProperty(MakeProperty(options, input.Functions, bounds));
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(options.Background.data());
  renderer->AddVolume(volume);
  renderer->GetCullers()->RemoveAllItems(); // a volume out of sight gives an empty picture
  window->AddRenderer(renderer);
  PlaceCamera(options.Scene, bounds, renderer);
}

/// Returns the mapper's picture. OpenGL may still be drawing it.
vtkImageData* GetPicture(vtkAbstractVolumeMapper* mapper)
{
  const ProgressLine progress("finishing the picture");
  return VisitMapper(mapper, [](auto* visited) { return visited->GetOutputImage(); });
}

bool IsEmpty(vtkImageData* image)
{
  vtkDataArray* depths = image->GetPointData()->GetArray("Depth");
  if (!depths)
  {
    return true;
  }
  const auto pixels = vtk::DataArrayValueRange<1>(depths);
  return std::all_of(pixels.begin(), pixels.end(), [](double depth) { return depth == -1; });
}

/// Throws WorkError if the input has no cell that can be rendered.
void CheckRendered(const std::string& input, const nlohmann::ordered_json& statistics)
{
  const auto tables = statistics.find("tables"); // of cells
  if (tables != statistics.end() && tables->at("tetrahedra") == 0)
  {
    const auto leftOut = statistics.at("input").at("left_out").get<std::string>();
    throw WorkError("'" + input + "': none of its " + statistics.at("input").at("cells").dump() +
      " cells can be rendered as a volume" + (leftOut.empty() ? "" : "; ") + leftOut);
  }
}

void PrintStatistics(const nlohmann::ordered_json& value, const std::string& indent)
{
  for (const auto& [name, member] : value.items())
  {
    if (member.is_object())
    {
      std::cout << indent << name << "\n";
      PrintStatistics(member, indent + "  ");
    }
    else
    {
      std::cout << indent << name << ": "
                << (member.is_string() ? EscapeControls(member.get<std::string>()) : member.dump())
                << "\n";
    }
  }
}

void WriteStatistics(const nlohmann::ordered_json& statistics, const AtomicOutput& file)
{
  WriteText(statistics.dump(2) + "\n", file.GetTemporaryName(), file.GetName());
}

/// Returns what is wrong with a picture for which another method may be taken, or an empty text.
std::string FindFault(vtkAbstractVolumeMapper* mapper, const nlohmann::ordered_json& statistics)
{
  if (!VisitMapper(mapper, [](auto* visited) { return visited->IsMaximumErrorKept(); }))
  {
    return "its error is estimated to be larger than MaximumError";
  }
  // What cells that overlap do to the picture is in no estimate. They have no exact order.
  const auto projection = statistics.find("projection");
  if (projection != statistics.end() && projection->at("order") != "none" &&
    projection->at("order") != "meshed polyhedra")
  {
    return "its order of cells is not known to be exact";
  }
  return "";
}

nlohmann::ordered_json ParseStatistics(vtkAbstractVolumeMapper* mapper)
{
  return nlohmann::ordered_json::parse(
    VisitMapper(mapper, [](auto* visited) { return visited->GetStatistics(); }));
}

/// Renders the volume of an input once. Returns VTK's first error. Without an error, returns an
/// empty text and prints the warnings. mayChange: another method is taken if this one's picture is
/// not right enough; what is wrong is returned as an error.
std::string Draw(const std::string& input, vtkAbstractVolumeMapper* mapper, vtkRenderWindow* window,
  bool mayChange)
{
  const MessageCapture messages;
  ProgressLine progress("rendering");
  progress.Observe(mapper, vtkCommand::ProgressEvent);
  progress.Observe(mapper, vtkCommand::VolumeMapperRenderProgressEvent);
  auto* projection = vtkTetrahedraProjectionMapper::SafeDownCast(mapper);
  if (mayChange && projection &&
    projection->GetOrder() == vtkMeshedPolyhedraVisibilitySort::AUTOMATIC_ORDER)
  {
    projection->SetOrderToExact(); // which finds out whether cells overlap
  }
  window->Render();
  if (messages.GetError().empty())
  {
    const auto statistics = ParseStatistics(mapper);
    CheckRendered(input, statistics);
    std::string fault = mayChange ? FindFault(mapper, statistics) : "";
    if (!fault.empty())
    {
      return fault;
    }
    messages.PrintWarnings();
  }
  return messages.GetError();
}

/// Returns the statistics, with the reason for the method if --method did not name it.
nlohmann::ordered_json ReadStatistics(vtkAbstractVolumeMapper* mapper, const MethodChoice& method)
{
  const auto ofMapper = ParseStatistics(mapper);
  nlohmann::ordered_json statistics;
  for (const auto& [name, member] : ofMapper.items())
  {
    statistics[name] = member;
    if (name == "method" && !method.Reason.empty())
    {
      statistics["method_reason"] = method.Reason;
    }
  }
  return statistics;
}

} // namespace

void RenderPicture(const RenderOptions& options)
{
  CheckOptions(options);
  vtkNew<vtkHeadlessRenderWindow> window;
  window->SetSize(options.Scene.Width, options.Scene.Height);
  window->SetMultiSamples(0);
  std::vector<MethodChoice> methods = ListMethodsFor(options, window);
  // Before a large file is read: wrong settings are an error.
  if (!MayRenderImages(options))
  {
    MakeConfiguredMapper(methods.front().Method, options);
  }

  AtomicOutput output(options.Output);
  std::optional<AtomicOutput> statisticsOutput;
  if (!options.StatisticsFile.empty())
  {
    statisticsOutput.emplace(options.StatisticsFile);
  }
  const RenderInput input = ReadInput(options.Scene, options.ColorArray);
  if (MayRenderImages(options) && IsImage(input))
  {
    methods = { { ImageMethod, "image data are rendered without cells" } };
  }
  RankMethods(
    { EstimateTetrahedra(input.Data), options.Scene.Width, options.Scene.Height }, methods);
  vtkNew<vtkVolume> volume;
  vtkSmartPointer<vtkAbstractVolumeMapper> mapper;
  std::string error;
  std::size_t used = 0;
  for (; used < methods.size(); ++used)
  {
    mapper = MakeConfiguredMapper(methods[used].Method, options);
    SetInput(input, mapper);
    volume->SetMapper(mapper);
    if (used == 0)
    {
      ShowVolume(options, input, volume, window);
    }
    const bool mayChange = used + 1 < methods.size();
    error = Draw(options.Scene.Input.Name, mapper, window, mayChange);
    if (error.empty() || !mayChange)
    {
      break;
    }
    // No room for the mesh, or too few digits, say: the last one, a processor, has both.
    methods[used + 1].Reason = methods[used].Method + " failed: " + error;
  }
  if (!error.empty())
  {
    throw WorkError("'" + options.Scene.Input.Name + "': " + error);
  }
  const nlohmann::ordered_json statistics = ReadStatistics(mapper, methods[used]);
  vtkImageData* image = GetPicture(mapper);
  if (IsEmpty(image))
  {
    PrintMessage("warning: the picture is empty: no ray meets anything that is not transparent");
  }

  WritePicture(output, image, window, options.Background);
  if (statisticsOutput)
  {
    WriteStatistics(statistics, *statisticsOutput);
    statisticsOutput->Commit();
  }
  output.Commit();
  if (options.PrintStatistics)
  {
    PrintStatistics(statistics, "");
  }
}
