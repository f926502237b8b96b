// SPDX-License-Identifier: BSD-3-Clause
// The command line: options to calls, errors to one line and an exit status.

#include "Bench/Bench.h"
#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"
#include "Commands/Generate.h"
#include "Commands/Info.h"
#include "Commands/Render.h"
#include "Commands/Stability.h"
#include "Files/ReadMesh.h"
#include "Setup/MapperProperties.h"
#include "Setup/Methods.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace
{

enum ExitStatus
{
  Done = 0,
  WorkFailed = 1,
  WrongUsage = 2
};

/// Largest width and height of a picture: what OpenGL frame buffers commonly hold.
constexpr int MaximumSize = 16384;

/// Adds an option whose text is read by parse(option, text) when it is given.
template <class ParseT>
CLI::Option* AddOption(
  CLI::App* command, const std::string& name, const std::string& help, ParseT parse)
{
  return command
    ->add_option_function<std::string>(
      name, [name, parse](const std::string& text) { parse(name, text); }, help)
    ->type_name("");
}

/// X,Y,Z into an optional vector.
auto ReadVector(std::optional<RenderOptions::Vector>& vector)
{
  return [&vector](const std::string& option, const std::string& text)
  {
    const std::vector<double> values = ParseNumbers(option, text, 3, "X,Y,Z");
    vector = { values[0], values[1], values[2] };
  };
}

CLI::Option* AddInput(CLI::App* command, std::string& input, std::string& plot3dSolution)
{
  CLI::Option* option =
    command->add_option("IN", input, "File to read: " + GetInputHelp())->type_name("");
  command
    ->add_option("--plot3d-q", plot3dSolution,
      "Solution file of the PLOT3D coordinates IN; as well, IN may be both with a comma between: "
      "xyz.bin,q.bin")
    ->type_name("FILE");
  return option;
}

/// What to colour by, and how.
void AddScalarOptions(CLI::App* command, RenderOptions& options)
{
  command
    ->add_option("--array", options.Array,
      "Array to colour by, of the points or else of the cells; default: the active scalars, else "
      "the first array of floating point numbers")
    ->type_name("NAME");
  AddOption(command, "--component",
    "Component of an array that has several, counted from 0, or magnitude, the default",
    [&options](const std::string& option, const std::string& text)
    {
      if (text != "magnitude")
      {
        try
        {
          ParseInteger(option, text, 0, 1 << 30);
        }
        catch (const UsageError&)
        {
          throw UsageError(
            option + ": '" + text + "' is neither magnitude nor a number counted from 0");
        }
      }
      options.Component = text;
    })
    ->type_name("I|magnitude");
  command
    ->add_option("--transfer", options.TransferFile,
      "Colour and opacity: a preset of ParaView, or a list of them, of which the first is used, at "
      "its own scalar values; default: cool to warm over the array's range, opacity from 0 to 1")
    ->type_name("FILE.json");
  AddOption(command, "--opacity-unit-distance",
    "Length over which the opacity is reached, in units of the data: attenuation is opacity / D; "
    "default: 1/20 of the diagonal of the bounds",
    [&options](const std::string& option, const std::string& text)
    { options.OpacityUnitDistance = ParsePositive(option, text); })
    ->type_name("D");
}

void AddCameraOptions(CLI::App* command, RenderOptions& options)
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

void AddSizeOptions(CLI::App* command, RenderOptions& options)
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
    { options.NumberOfThreads = ParseInteger(option, text, 0, 1024); })
    ->type_name("N");
}

void AddRenderCommand(CLI::App& app, RenderOptions& options)
{
  CLI::App* command = app.add_subcommand("render", "Render a file to a picture");
  AddInput(command, options.Input, options.Plot3dSolution)->required();
  AddScalarOptions(command, options);
  command->add_option("--method", options.Method, "How to render: " + JoinNames(GetMethodNames()))
    ->capture_default_str()
    ->type_name("NAME");
  AddCameraOptions(command, options);
  AddSizeOptions(command, options);
  AddOption(command, "--isovalues",
    "Show the surfaces of these scalars, lit, instead of a volume; each has its colour and opacity",
    [&options](const std::string& option, const std::string& text)
    { options.Isovalues = ParseNumbers(option, text); })
    ->type_name("A,B,...");

  command->add_flag("--shade", options.Shade, "Let a light at the camera shine on the volume");
  AddOption(command, "--background", "Colour behind a .png, each from 0 to 1; default: 0,0,0",
    [&options](const std::string& option, const std::string& text)
    {
      const std::vector<double> color = ParseNumbers(option, text, 3, "R,G,B");
      if (*std::min_element(color.begin(), color.end()) < 0 ||
        *std::max_element(color.begin(), color.end()) > 1)
      {
        throw UsageError(option + ": '" + text + "' is not R,G,B, each from 0 to 1");
      }
      options.Background = { color[0], color[1], color[2] };
    })
    ->type_name("R,G,B");
  AddOption(command, "--max-error",
    "Largest error of a colour channel that is aimed at, from 0 to 1; default: 1e-4",
    [&options](const std::string& option, const std::string& text)
    {
      const double error = ParsePositive(option, text);
      if (error > 1)
      {
        throw UsageError(option + ": '" + text + "' is not a number above 0 and at most 1");
      }
      options.MaximumError = error;
    })
    ->type_name("E");
  command
    ->add_option("--set", options.Settings,
      "Set a property of the mapper, and once more for each further one: " +
        JoinNames(GetPropertyNames()))
    ->allow_extra_args(false)
    ->type_name("Property=Value");
  command->add_flag_callback(
    "--list-properties",
    []
    {
      std::cout << DescribeProperties();
      throw CLI::Success();
    },
    "Print what --set takes: the properties, their values, defaults and meanings");
  command
    ->add_option_function<std::string>(
      "--stats",
      [&options](const std::string& text)
      {
        options.PrintStatistics = text.empty();
        options.StatisticsFile = text;
      },
      "What it took: to standard output, or as JSON to a file")
    ->expected(0, 1)
    ->type_name("[FILE.json]");
  command
    ->add_option("--output", options.Output,
      "Picture to write: .png, 8 bit over the background; .vti, arrays of float, RGBA "
      "premultiplied "
      "without background and Depth along the ray in world units, -1 where nothing is")
    ->required()
    ->type_name("FILE");
  command->final_callback([&options] { RenderPicture(options); });
}

void AddInfoCommand(CLI::App& app, InfoOptions& options)
{
  CLI::App* command =
    app.add_subcommand("info", "Print what is in a file, its defects, and what it takes to render");
  AddInput(command, options.Input, options.Plot3dSolution)->required();
  command->final_callback([&options] { PrintInfo(options); });
}

void AddGenerateCommand(CLI::App& app, GenerateOptions& options, bool& list)
{
  CLI::App* command = app.add_subcommand("generate", "Write a mesh that is made from a formula");
  command->add_option("NAME", options.Name, "Which one: see --list")->type_name("");
  command->add_option("--output", options.Output, "File to write")->type_name("FILE.vtu");
  command->add_flag("--list", list, "Print the names, and the parameters of each");
  command->allow_extras();
  command->footer("Each parameter that --list shows is an option with a number behind it, as in\n"
                  "  tetralux generate ball --cells 20 --output ball.vtu");
  command->final_callback(
    [command, &options, &list]
    {
      if (list)
      {
        ListGenerators();
        return;
      }
      if (options.Name.empty())
      {
        throw UsageError("generate: NAME is required; tetralux generate --list prints the names");
      }
      if (options.Output.empty())
      {
        throw UsageError("--output is required: the file to write, ending in .vtu");
      }
      options.Parameters = command->remaining();
      GenerateFile(options);
    });
}

/// The first of some options goes with the others of them alone.
void RefuseOtherOptions(const CLI::App* command, const std::vector<std::string>& names)
{
  for (const CLI::Option* option : command->get_options())
  {
    const std::string name = option->get_name();
    if (option->count() > 0 && std::find(names.begin(), names.end(), name) == names.end())
    {
      throw UsageError(names.front() + ": does not go with " + name);
    }
  }
}

/// What bench takes in place of everything else.
CLI::Option* AddStabilityOptions(CLI::App* command, StabilityOptions& options)
{
  CLI::Option* stability = command->add_flag("--stability",
    "Measure, in place of pictures, the ray integral over one segment where it is hard to get "
    "right: each form of it against quadrature in extended precision");
  AddOption(command, "--seed", "With --stability: seed of the random cases; default: 1",
    [&options](const std::string& option, const std::string& text)
    {
      options.Seed =
        static_cast<std::uint64_t>(ParseInteger(option, text, 0, std::numeric_limits<int>::max()));
    })
    ->type_name("N")
    ->needs(stability);
  AddOption(command, "--cases", "With --stability: number of random cases; default: 10000",
    [&options](const std::string& option, const std::string& text)
    { options.RandomCases = ParseInteger(option, text, 0, 100000000); })
    ->type_name("N")
    ->needs(stability);
  return stability;
}

void AddBenchCommand(CLI::App& app, BenchOptions& options, StabilityOptions& stabilityOptions)
{
  CLI::App* command = app.add_subcommand(
    "bench", "Measure error against run time, of methods and settings, and of VTK's own mappers");
  AddInput(command, options.Scene.Input, options.Scene.Plot3dSolution)
    ->description("File to measure with, in place of the scenes there are: " + GetInputHelp());
  options.Scene.Width = options.Scene.Height = 0; // left to the run
  AddScalarOptions(command, options.Scene);
  AddCameraOptions(command, options.Scene);
  AddSizeOptions(command, options.Scene);
  command
    ->add_option("--data", options.DataFolder,
      "Folder with bluntfinxyz.bin, bluntfinq.bin and can.vtu of the VTK examples; default: the "
      "variable TETRALUX_DATA, else generated scenes alone")
    ->type_name("FOLDER");
  command
    ->add_option("--scene", options.Scenes,
      "Measure this scene alone, and once more for each further one; default: all")
    ->allow_extra_args(false)
    ->type_name("NAME");
  command
    ->add_option("--setting", options.Settings,
      "Measure this in place of the settings there are, and once more for each further one: "
      "properties as render --set takes them, with blanks between, of ray-cast or of a method "
      "named "
      "before them")
    ->allow_extra_args(false)
    ->type_name("'[METHOD] Property=Value ...'");
  AddOption(command, "--frames", "Frames timed of each picture, at most; default: 10",
    [&options](const std::string& option, const std::string& text)
    { options.Frames = ParseInteger(option, text, 1, 10000); })
    ->type_name("N");
  command->add_flag("--features", options.Features,
    "Measure also what each feature costs when it is used and when it is not");
  command->add_flag(
    "--quick", options.Quick, "Small scenes and pictures, two frames: to see that all works");
  command
    ->add_option("--output", options.Output,
      "Folder to write: index.html, results.csv, charts and pictures; one that an earlier run "
      "wrote "
      "is replaced")
    ->type_name("FOLDER");
  const CLI::Option* stability = AddStabilityOptions(command, stabilityOptions);
  command->final_callback(
    [command, stability, &options, &stabilityOptions]
    {
      if (*stability)
      {
        RefuseOtherOptions(command, { "--stability", "--seed", "--cases" });
        RunStability(stabilityOptions);
        return;
      }
      if (options.Output.empty())
      {
        throw UsageError("bench: --output is required: the folder to write");
      }
      RunBench(options);
    });
}

/// CLI11's errors in words of this tool.
std::string Describe(const CLI::ParseError& error, const CLI::App& app)
{
  std::string command = "tetralux";
  for (const CLI::App* chosen : app.get_subcommands())
  {
    command += " " + chosen->get_name();
  }
  return std::string(error.what()) + "; see " + command + " --help";
}

int Fail(const std::string& message, ExitStatus status)
{
  std::cerr << "tetralux: " << message << "\n";
  return status;
}

} // namespace

int main(int argc, char* argv[])
{
  CLI::App app("Volume rendering of unstructured grids with a known error", "tetralux");
  app.set_version_flag("--version", TETRALUX_VERSION);
  app.require_subcommand(1);
  app.footer("tetralux COMMAND --help prints the options of a command.\n"
             "Exit status: 0 done, 1 the work failed, 2 wrong usage.");
  RenderOptions renderOptions;
  InfoOptions infoOptions;
  GenerateOptions generateOptions;
  BenchOptions benchOptions;
  StabilityOptions stabilityOptions;
  bool listGenerators = false;
  AddRenderCommand(app, renderOptions);
  AddInfoCommand(app, infoOptions);
  AddGenerateCommand(app, generateOptions, listGenerators);
  AddBenchCommand(app, benchOptions, stabilityOptions);

  try
  {
    app.parse(argc, argv);
    return Done;
  }
  catch (const CLI::Success& success) // help and version
  {
    return app.exit(success);
  }
  catch (const CLI::ParseError& error)
  {
    return Fail(Describe(error, app), WrongUsage);
  }
  catch (const UsageError& error)
  {
    return Fail(error.what(), WrongUsage);
  }
  catch (const WorkError& error)
  {
    return Fail(error.what(), WorkFailed);
  }
  catch (const std::bad_alloc&)
  {
    return Fail("there is not enough memory", WorkFailed);
  }
  catch (const std::exception& error)
  {
    return Fail(error.what(), WorkFailed);
  }
}
