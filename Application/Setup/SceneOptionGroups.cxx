// SPDX-License-Identifier: BSD-3-Clause
#include "Setup/SceneOptionGroups.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "Files/InputFile.h"
#include "Files/MeshFormats.h"
#include "Setup/SceneOptions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace
{

/// Largest width and height of a picture: what OpenGL frame buffers commonly hold.
constexpr int MaximumSize = 16384;

/// Largest number that --component takes; arrays have far fewer components.
constexpr int MaximumComponent = 1 << 30;

/// Largest number that --time-step takes; files have fewer steps.
constexpr int MaximumTimeStep = 1 << 30;

constexpr int MaximumThreads = 1024;

/// X,Y,Z into an optional vector.
auto ReadVector(std::optional<SceneOptions::Vector>& vector)
{
  return [&vector](const std::string& option, const std::string& text)
  {
    const std::vector<double> values = ParseNumbers(option, text, 3, "X,Y,Z");
    vector = { values[0], values[1], values[2] };
  };
}

void CheckComponent(const std::string& option, const std::string& text)
{
  if (text == "magnitude")
  {
    return;
  }
  try
  {
    ParseInteger(option, text, 0, MaximumComponent);
  }
  catch (const UsageError&)
  {
    throw UsageError(option + ": '" + text + "' is neither magnitude nor a number counted from 0");
  }
}

} // namespace

CLI::Option* AddInputOptions(CLI::App* command, InputFile& input)
{
  CLI::Option* option =
    command
      ->add_option("IN", input.Name,
        "File to read; - is standard input, which may have VTK XML, VTK legacy, Exodus or NRRD: " +
          GetInputHelp())
      ->check(MakeNameCheck())
      ->type_name("");
  command
    ->add_option("--plot3d-q", input.Plot3dSolution,
      "Solution file of the PLOT3D coordinates IN; as well, IN may be both with a comma between: "
      "xyz.bin,q.bin")
    ->check(MakeNameCheck())
    ->type_name("FILE");
  CLI::Option* time = AddOption(command, "--time",
    "Time step nearest to this time of a file that has several, in the file's units; info lists "
    "them; default: the first step",
    [&input](const std::string& name, const std::string& text) {
      input.Time = ParseNumber(name, text);
    })->type_name("T");
  AddOption(command, "--time-step", "The same by its number, counted from 0",
    [&input](const std::string& name, const std::string& text)
    { input.TimeStep = ParseInteger(name, text, 0, MaximumTimeStep); })
    ->type_name("N")
    ->excludes(time);
  return option;
}

void AddScalarOptions(CLI::App* command, SceneOptions& options)
{
  command
    ->add_option("--array", options.Array,
      "Array to colour by, of the points or else of the cells; default: the active scalars, else "
      "the first array of floating point numbers")
    ->check(MakeNameCheck())
    ->type_name("NAME");
  AddOption(command, "--component",
    "Component of an array that has several, counted from 0, or magnitude, the default",
    [&options](const std::string& option, const std::string& text)
    {
      CheckComponent(option, text);
      options.Component = text;
    })
    ->type_name("I|magnitude");
  command
    ->add_option("--transfer", options.TransferFile,
      "Colour and opacity: a preset of ParaView, or a list of them, of which the first is used, at "
      "its own scalar values; default: cool to warm over the array's range, opacity from 0 to 1")
    ->check(MakeNameCheck())
    ->type_name("FILE.json");
  AddOption(command, "--opacity-unit-distance",
    "Length over which the opacity is reached, in units of the data: attenuation is opacity / D; "
    "default: 1/20 of the diagonal of the bounds",
    [&options](const std::string& option, const std::string& text)
    { options.OpacityUnitDistance = ParsePositive(option, text); })
    ->type_name("D");
}

void AddCameraOptions(CLI::App* command, SceneOptions& options)
{
  AddOption(command, "--camera-position",
    "Where the camera is; default: where it sees everything, 30 degrees to the right and 20 up",
    ReadVector(options.CameraPosition))
    ->type_name("X,Y,Z");
  AddOption(command, "--camera-focal-point", "What it looks at; default: the middle of the data",
    ReadVector(options.CameraFocalPoint))
    ->type_name("X,Y,Z");
  AddOption(command, "--camera-view-up", "Direction that is up in the picture; default: 0,1,0",
    ReadVector(options.CameraViewUp))
    ->type_name("X,Y,Z");
  AddOption(command, "--camera-view-angle", "Vertical angle in perspective; default: 30",
    [&options](const std::string& option, const std::string& text)
    {
      const double angle = ParsePositive(option, text);
      if (angle >= 180)
      {
        throw UsageError(option + ": '" + text + "' is not an angle below 180 degrees");
      }
      options.CameraViewAngle = angle;
    })
    ->type_name("DEG");
  AddOption(command, "--camera-parallel-scale",
    "Parallel projection, with half of the picture's height in units of the data",
    [&options](const std::string& option, const std::string& text)
    { options.CameraParallelScale = ParsePositive(option, text); })
    ->type_name("S");
}

void AddSizeOptions(CLI::App* command, SceneOptions& options)
{
  AddOption(command, "--size", "Pixels of the picture; default: 512,512",
    [&options](const std::string& option, const std::string& text)
    {
      const std::vector<double> size = ParseNumbers(option, text, 2, "W,H");
      if (std::any_of(size.begin(), size.end(),
            [](double pixels)
            { return pixels < 1 || pixels > MaximumSize || pixels != std::floor(pixels); }))
      {
        throw UsageError(option + ": '" + text + "' is not W,H, each an integer from 1 to " +
          std::to_string(MaximumSize));
      }
      options.Width = static_cast<int>(size[0]);
      options.Height = static_cast<int>(size[1]);
    })
    ->type_name("W,H");
  AddOption(command, "--threads", "Threads that render; default: 0, one for each core",
    [&options](const std::string& option, const std::string& text)
    { options.NumberOfThreads = ParseInteger(option, text, 0, MaximumThreads); })
    ->type_name("N");
}
