// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/RenderCommand.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "Commands/Render.h"
#include "Setup/MapperProperties.h"
#include "Setup/Methods.h"
#include "Setup/SceneOptionGroups.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace
{

SceneOptions::Vector ReadColor(const std::string& option, const std::string& text)
{
  const std::vector<double> color = ParseNumbers(option, text, 3, "R,G,B");
  if (*std::min_element(color.begin(), color.end()) < 0 ||
    *std::max_element(color.begin(), color.end()) > 1)
  {
    throw UsageError(option + ": '" + text + "' is not R,G,B, each from 0 to 1");
  }
  return { color[0], color[1], color[2] };
}

double ReadError(const std::string& option, const std::string& text)
{
  const double error = ParseNumber(option, text);
  if (error < 0 || error > 1)
  {
    throw UsageError(option + ": '" + text + "' is not a number from 0 to 1");
  }
  return error;
}

/// Options that tell what is seen of the scene, and how exactly.
void AddPictureOptions(CLI::App* command, RenderOptions& options)
{
  AddOption(command, "--isovalues",
    "Show the surfaces of these scalars, lit, instead of a volume; each has its colour and opacity",
    [&options](const std::string& option, const std::string& text)
    { options.Isovalues = ParseNumbers(option, text); })
    ->type_name("A,B,...");
  AddOption(command, "--slice-plane",
    "A point and the normal of the plane that --set BlendMode=slice shows of image data",
    [&options](const std::string& option, const std::string& text)
    { options.SlicePlane = ParseNumbers(option, text, 6, "X,Y,Z,NX,NY,NZ"); })
    ->type_name("X,Y,Z,NX,NY,NZ");
  command
    ->add_option("--color-array", options.ColorArray,
      "Colour surfaces by this point array, with --method isosurface or auto; of several "
      "components the magnitude, or --set ColorArrayComponent=N")
    ->check(MakeNameCheck())
    ->type_name("NAME");
  command->add_flag("--shade", options.Shade, "Let a light at the camera shine on the volume");
  AddOption(command, "--background", "Colour behind a .png, each from 0 to 1; default: 0,0,0",
    [&options](const std::string& option, const std::string& text)
    { options.Background = ReadColor(option, text); })
    ->type_name("R,G,B");
  AddOption(command, "--max-error",
    "Largest error of a colour channel that is aimed at, from 0 to 1; default: 1e-4",
    [&options](const std::string& option, const std::string& text)
    { options.MaximumError = ReadError(option, text); })
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
}

void AddOutputOptions(CLI::App* command, RenderOptions& options)
{
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
      "Picture to write: .png, 8 bit over the background, also for - (standard output), pipes and "
      "devices; .vti, arrays of float, RGBA "
      "premultiplied without background and Depth along the ray in world units, -1 where nothing "
      "is")
    ->required()
    ->check(MakeNameCheck())
    ->type_name("FILE");
}

} // namespace

void AddRenderCommand(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("render", "Render a file to a picture");
  const auto options = std::make_shared<RenderOptions>();
  SceneOptions& scene = options->Scene;
  AddInputOptions(command, scene.Input)->required();
  AddScalarOptions(command, scene);
  command->add_option("--method", options->Method, "How to render: " + JoinNames(GetMethodNames()))
    ->capture_default_str()
    ->type_name("NAME");
  AddCameraOptions(command, scene);
  AddSizeOptions(command, scene);
  AddPictureOptions(command, *options);
  AddOutputOptions(command, *options);
  command->final_callback([options] { RenderPicture(*options); });
}
