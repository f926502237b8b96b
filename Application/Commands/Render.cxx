// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Render.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/MessageCapture.h"
#include "CommandLine/OptionValues.h"
#include "CommandLine/ProgressLine.h"
#include "Files/AtomicFile.h"
#include "Files/ReadMesh.h"
#include "Files/TransferFunctionFile.h"
#include "Files/WriteData.h"
#include "Setup/Arrays.h"
#include "Setup/MapperProperties.h"
#include "Setup/Methods.h"
#include "Setup/SceneCamera.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkTetrahedraVolumeMapper.h"

#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkCullerCollection.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkWindowToImageFilter.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>

namespace
{

/// Everything of the command line that can be wrong by itself.
void CheckOptions(const RenderOptions& options)
{
  const std::string extension = GetExtension(options.Output);
  if (extension != ".png" && extension != ".vti")
  {
    throw UsageError("--output: '" + options.Output + "' must end in .png or .vti");
  }
  if (!options.StatisticsFile.empty() && GetExtension(options.StatisticsFile) != ".json")
  {
    throw UsageError("--stats: '" + options.StatisticsFile + "' must end in .json");
  }
  CheckCamera(options);
}

vtkSmartPointer<vtkTetrahedraVolumeMapper> MakeConfiguredMapper(
  const std::string& method, const RenderOptions& options)
{
  vtkSmartPointer<vtkTetrahedraVolumeMapper> mapper =
    MakeMapper(method, options.NumberOfThreads, options.Settings);
  if (options.MaximumError)
  {
    mapper->SetMaximumError(*options.MaximumError);
  }
  const bool isosurfaces = mapper->GetBlendMode() == vtkTetrahedraVolumeMapper::ISOSURFACE_BLEND;
  if (isosurfaces && options.Isovalues.empty())
  {
    throw UsageError("BlendMode=isosurface needs --isovalues A,B,...");
  }
  if (!isosurfaces && !options.Isovalues.empty())
  {
    if (mapper->GetBlendMode() != vtkTetrahedraVolumeMapper::COMPOSITE_BLEND)
    {
      throw UsageError("--isovalues A,B,... and BlendMode=isosurface belong together");
    }
    mapper->SetBlendModeToIsoSurface();
  }
  return mapper;
}

MethodChoice ChooseMethodFor(const RenderOptions& options, vtkRenderWindow* window)
{
  // The window may fail to make its context.
  const MessageCapture messages;
  const MethodChoice choice =
    ChooseMethod(options.Method, window, options.NumberOfThreads, options.Settings);
  if (!messages.GetError().empty())
  {
    throw WorkError(messages.GetError());
  }
  return choice;
}

void SelectScalars(const ArrayChoice& choice, vtkTetrahedraVolumeMapper* mapper)
{
  mapper->SetScalarMode(choice.Array.CellData ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA
                                              : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA);
  mapper->SelectScalarArray(choice.Array.Name.c_str());
  mapper->SetVectorMode(
    choice.Magnitude ? vtkTetrahedraVolumeMapper::MAGNITUDE : vtkTetrahedraVolumeMapper::COMPONENT);
  mapper->SetVectorComponent(choice.Component);
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

/// A picture of nothing, because there is nothing that can be rendered, is a failure.
void CheckRendered(const std::string& input, const nlohmann::ordered_json& statistics)
{
  if (statistics.at("tables").at("tetrahedra") == 0)
  {
    const auto skipped = statistics.at("input").at("skipped_cell_types").get<std::string>();
    throw WorkError("'" + input + "': none of its " + statistics.at("input").at("cells").dump() +
      " cells can be rendered as a volume" +
      (skipped.empty() ? "" : "; not supported: " + skipped));
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
                << (member.is_string() ? member.get<std::string>() : member.dump()) << "\n";
    }
  }
}

void WriteStatistics(const nlohmann::ordered_json& statistics, const AtomicFile& file)
{
  std::ofstream stream(file.GetTemporaryName());
  stream << statistics.dump(2) << "\n";
  stream.close();
  if (!stream)
  {
    throw WorkError("cannot write '" + file.GetName() + "'");
  }
}

/// The picture over the background, rounded to 8 bit once. The frame buffer of a window has 8 bit
/// already before its background is added.
vtkSmartPointer<vtkImageData> PutOverBackground(
  vtkImageData* image, const RenderOptions::Vector& background)
{
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->SetDimensions(image->GetDimensions());
  result->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto colors = vtk::DataArrayTupleRange<4>(image->GetPointData()->GetArray("RGBA"));
  auto pixels = vtk::DataArrayTupleRange<3>(result->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < colors.size(); ++i)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      const double value = colors[i][channel] + (1 - colors[i][3]) * background[channel];
      pixels[i][channel] = std::lround(255 * std::clamp(value, 0.0, 1.0));
    }
  }
  return result;
}

/// The picture as the window shows it.
vtkSmartPointer<vtkImageData> CaptureWindow(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> reader;
  reader->SetInput(window);
  reader->ShouldRerenderOff();
  reader->ReadFrontBufferOff();
  reader->SetInputBufferTypeToRGB();
  reader->Update();
  return reader->GetOutput();
}

void WritePicture(const RenderOptions& options, vtkRenderWindow* window, vtkImageData* image,
  const AtomicFile& output)
{
  if (GetExtension(output.GetName()) == ".vti")
  {
    WriteXml(image, output.GetTemporaryName(), output.GetName());
    return;
  }
  const int* dimensions = image->GetDimensions();
  const bool oneRayPerPixel = dimensions[0] == options.Width && dimensions[1] == options.Height;
  WritePng(oneRayPerPixel ? PutOverBackground(image, options.Background) : CaptureWindow(window),
    output.GetTemporaryName(), output.GetName());
}

vtkSmartPointer<vtkVolumeProperty> MakeProperty(
  const RenderOptions& options, const ColorAndOpacity& functions, const double bounds[6])
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(functions.Color);
  property->SetScalarOpacity(functions.Opacity);
  property->SetScalarOpacityUnitDistance(options.OpacityUnitDistance.value_or(
    DefaultUnitDistanceFraction * vtkBoundingBox(bounds).GetDiagonalLength()));
  for (std::size_t i = 0; i < options.Isovalues.size(); ++i)
  {
    property->GetIsoSurfaceValues()->SetValue(static_cast<int>(i), options.Isovalues[i]);
  }
  // Flat surfaces have no shape.
  property->SetShade(options.Shade || !options.Isovalues.empty());
  return property;
}

/// Renders the volume of an input once. Returns VTK's first error, empty where there was none;
/// warnings are printed then. mayChange: another method is taken if this one's error is too large,
/// which is returned as an error.
std::string Draw(const std::string& input, vtkTetrahedraVolumeMapper* mapper,
  vtkRenderWindow* window, bool mayChange)
{
  const MessageCapture messages;
  ProgressLine progress("rendering");
  progress.Observe(mapper, vtkCommand::ProgressEvent);
  progress.Observe(mapper, vtkCommand::VolumeMapperRenderProgressEvent);
  window->Render();
  if (messages.GetError().empty())
  {
    CheckRendered(input, nlohmann::ordered_json::parse(mapper->GetStatistics()));
    if (mayChange && !KeepsMaximumError(mapper))
    {
      return "its error is estimated to be larger than MaximumError";
    }
    messages.PrintWarnings();
  }
  return messages.GetError();
}

/// The statistics, with why this method was chosen where none was asked for.
nlohmann::ordered_json ReadStatistics(vtkTetrahedraVolumeMapper* mapper, const MethodChoice& method)
{
  const auto ofMapper = nlohmann::ordered_json::parse(mapper->GetStatistics());
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
  window->SetSize(options.Width, options.Height);
  window->SetMultiSamples(0);
  MethodChoice method = ChooseMethodFor(options, window);
  vtkSmartPointer<vtkTetrahedraVolumeMapper> mapper = MakeConfiguredMapper(method.Method, options);

  AtomicFile output(options.Output);
  std::unique_ptr<AtomicFile> statisticsOutput;
  if (!options.StatisticsFile.empty())
  {
    statisticsOutput = std::make_unique<AtomicFile>(options.StatisticsFile);
  }
  ColorAndOpacity functions;
  if (!options.TransferFile.empty())
  {
    ReadTransferFunction(options.TransferFile, functions);
  }

  const vtkSmartPointer<vtkDataObject> data = ReadMesh(options.Input, options.Plot3dSolution);
  const ArrayChoice choice = ChooseArray(data, options.Array, options.Component);
  if (options.TransferFile.empty())
  {
    MakeDefaultTransferFunction(choice.Range.data(), functions);
  }
  SelectScalars(choice, mapper);
  mapper->SetInputData(data.GetPointer());
  double bounds[6];
  mapper->GetBounds(bounds);
  if (!vtkBoundingBox(bounds).IsValid())
  {
    throw WorkError("'" + options.Input + "': it has no points");
  }

  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->SetProperty(MakeProperty(options, functions, bounds));
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(options.Background.data());
  renderer->AddVolume(volume);
  renderer->GetCullers()->RemoveAllItems(); // what is out of sight gives a picture, too
  window->AddRenderer(renderer);
  PlaceCamera(options, bounds, renderer);

  const bool mayChange = options.Method == "auto" && method.Method != "ray-cast";
  std::string error = Draw(options.Input, mapper, window, mayChange);
  if (mayChange && !error.empty())
  {
    // No room for the mesh, or too few digits, say: a processor has both.
    method = { "ray-cast", method.Method + " failed: " + error };
    mapper = MakeConfiguredMapper(method.Method, options);
    SelectScalars(choice, mapper);
    mapper->SetInputData(data.GetPointer());
    volume->SetMapper(mapper);
    error = Draw(options.Input, mapper, window, false);
  }
  if (!error.empty())
  {
    throw WorkError("'" + options.Input + "': " + error);
  }
  const nlohmann::ordered_json statistics = ReadStatistics(mapper, method);
  vtkImageData* image = mapper->GetOutputImage();
  if (IsEmpty(image))
  {
    std::cerr << "tetralux: warning: the picture is empty: no ray meets a cell that is not "
                 "transparent\n";
  }

  WritePicture(options, window, image, output);
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
