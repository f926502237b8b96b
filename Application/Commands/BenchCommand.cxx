// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/BenchCommand.h"

#include "Bench/Bench.h"
#include "Bench/BenchOptions.h"
#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "Commands/StabilityCommand.h"
#include "Commands/TrafficCommand.h"
#include "Files/MeshFormats.h"
#include "Setup/SceneOptionGroups.h"

#include <functional>
#include <memory>
#include <string>

namespace
{

constexpr int MaximumFrames = 10000;

void AddSceneOptions(CLI::App* command, BenchOptions& options)
{
  SceneOptions& scene = options.Scene;
  AddInputOptions(command, scene.Input)
    ->description("File to measure with, in place of the scenes there are: " + GetInputHelp());
  scene.Width = scene.Height = 0; // left to the run
  AddScalarOptions(command, scene);
  AddCameraOptions(command, scene);
  AddSizeOptions(command, scene);
  command
    ->add_option("--data", options.DataFolder,
      "Folder with bluntfinxyz.bin, bluntfinq.bin and can.vtu of the VTK examples, and engine.vti, "
      "image data, if it is there; default: the variable TETRALUX_DATA, else generated scenes "
      "alone")
    ->check(MakeNameCheck())
    ->type_name("FOLDER");
  command
    ->add_option("--scene", options.Scenes,
      "Measure this scene alone, and once more for each further one; default: all")
    ->check(MakeNameCheck())
    ->allow_extra_args(false)
    ->type_name("NAME");
}

void AddRunOptions(CLI::App* command, BenchOptions& options)
{
  command
    ->add_option("--setting", options.Settings,
      "Measure this in place of the settings there are, and once more for each further one: "
      "properties as render --set takes them, with blanks between, of ray-cast or of a method "
      "named before them; triangle-caster measures with scenes of image data, all others with "
      "those of cells")
    ->check(MakeNameCheck())
    ->allow_extra_args(false)
    ->type_name("'[METHOD] Property=Value ...'");
  AddOption(command, "--frames", "Frames timed of each picture, at most; default: 10",
    [&options](const std::string& option, const std::string& text)
    { options.Frames = ParseInteger(option, text, 1, MaximumFrames); })
    ->type_name("N");
  command->add_flag("--features", options.Features,
    "Measure also what each feature costs when it is used and when it is not");
  command->add_flag(
    "--quick", options.Quick, "Small scenes and pictures, two frames: to see that all works");
  command
    ->add_option("--output", options.Output,
      "Folder to write: index.html, results.json, results.csv and pictures; one that an earlier "
      "run "
      "wrote is replaced")
    ->check(MakeNameCheck())
    ->type_name("FOLDER");
}

} // namespace

void AddBenchCommand(CLI::App& app)
{
  CLI::App* command = app.add_subcommand(
    "bench", "Measure error against run time, of methods and settings, and of VTK's own mappers");
  const auto options = std::make_shared<BenchOptions>();
  AddSceneOptions(command, *options);
  AddRunOptions(command, *options);
  const std::function<bool()> runStability = AddStabilityOptions(command);
  const std::function<bool()> runTraffic = AddTrafficOptions(command, *options);
  command->final_callback(
    [options, runStability, runTraffic]
    {
      if (runStability() || runTraffic())
      {
        return;
      }
      if (options->Output.empty())
      {
        throw UsageError("bench: --output is required: the folder to write");
      }
      RunBench(*options);
    });
}
