// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/GenerateCommand.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "CommandLine/ProgressLine.h"
#include "Files/AtomicOutput.h"
#include "Files/GeneratedGrid.h"
#include "Files/WriteData.h"
#include "Files/WriteSeries.h"
#include "Generate/GeneratedMeshes.h"

#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

struct GenerateOptions
{
  std::string Name;
  std::string Output;
  std::vector<std::string> Parameters; ///< "--name", "value", or "--name=value"
  int Steps = 0;                       ///< of time; 0: a single mesh
  bool List = false;
};

constexpr int LargestNumberOfSteps = 10000;
constexpr const char* TimeParameter = "time";

std::map<std::string, double> ReadParameters(const std::vector<std::string>& arguments)
{
  std::map<std::string, double> parameters;
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    const std::string& argument = arguments[i];
    if (argument.compare(0, 2, "--") != 0)
    {
      throw UsageError("generate: '" + argument + "' is not --parameter VALUE");
    }
    const std::size_t equals = argument.find('=');
    const std::string option = argument.substr(0, equals);
    if (equals == std::string::npos && i + 1 == arguments.size())
    {
      throw UsageError(option + ": there is no value behind it");
    }
    const std::string text =
      equals == std::string::npos ? arguments[++i] : argument.substr(equals + 1);
    parameters[option.substr(2)] = ParseNumber(option, text);
  }
  return parameters;
}

void CheckExtension(const GenerateOptions& options, const std::string& extension)
{
  const bool isList = options.Steps > 0; // whose files are beside it
  if (isList ? GetExtension(options.Output) != extension
             : !HasExtension(options.Output, { extension }))
  {
    throw UsageError("--output: '" + options.Output + "' must end in " + extension +
      (isList ? ", a list of time steps" : ", or be -, a pipe or a device"));
  }
}

void WriteMesh(const std::string& name, const std::map<std::string, double>& parameters,
  const AtomicOutput& output)
{
  tetralux::GeneratedMesh generated;
  try
  {
    generated = tetralux::GenerateMesh(name, parameters);
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(std::string("generate: ") + error.what());
  }
  WriteXml(MakeGrid(generated), output.GetTemporaryName(), output.GetName());
}

void GenerateFile(const GenerateOptions& options)
{
  CheckExtension(options, ".vtu");
  const std::map<std::string, double> parameters = ReadParameters(options.Parameters);
  AtomicOutput output(options.Output);
  ProgressLine progress("generating " + options.Name);
  WriteMesh(options.Name, parameters, output);
  output.Commit();
}

bool Moves(const tetralux::Generator& generator)
{
  return std::any_of(generator.Parameters.begin(), generator.Parameters.end(),
    [](const tetralux::GeneratorParameter& parameter) { return parameter.Name == TimeParameter; });
}

void CheckMoves(const std::string& name)
{
  std::vector<std::string> moving;
  bool stands = false;
  for (const tetralux::Generator& generator : tetralux::GetGenerators())
  {
    if (Moves(generator))
    {
      moving.push_back(generator.Name);
    }
    else
    {
      stands = stands || generator.Name == name;
    }
  }
  if (stands)
  {
    throw UsageError(
      "--steps: the mesh '" + name + "' does not move; these do: " + JoinNames(moving));
  }
}

/// The steps of one period, in files beside the list of them.
void GenerateSteps(const GenerateOptions& options)
{
  CheckExtension(options, ".pvd");
  CheckMoves(options.Name);
  std::map<std::string, double> parameters = ReadParameters(options.Parameters);
  if (parameters.count(TimeParameter) != 0)
  {
    throw UsageError("--steps has all times of a period: leave out --time");
  }
  AtomicOutput list(options.Output);
  const std::filesystem::path path(options.Output);
  std::vector<SeriesStep> steps;
  std::list<AtomicOutput> files;
  ProgressLine progress("generating " + options.Name);
  for (int step = 0; step < options.Steps; ++step)
  {
    char number[16];
    std::snprintf(number, sizeof(number), "_%04d", step);
    const std::string file = path.stem().string() + number + ".vtu";
    files.emplace_back((path.parent_path() / file).string());
    parameters[TimeParameter] = static_cast<double>(step) / options.Steps;
    WriteMesh(options.Name, parameters, files.back());
    steps.push_back({ parameters[TimeParameter], { file } });
    progress.Show((step + 1.0) / options.Steps);
  }
  WritePvd(steps, list.GetTemporaryName(), options.Output);
  for (AtomicOutput& file : files)
  {
    file.Commit();
  }
  list.Commit();
}

void ListGenerators()
{
  for (const tetralux::Generator& generator : tetralux::GetGenerators())
  {
    std::cout << generator.Name << ": " << generator.Description << "\n";
    for (const tetralux::GeneratorParameter& parameter : generator.Parameters)
    {
      std::cout << "  --" << parameter.Name << " " << FormatNumber(parameter.Default) << "  ("
                << FormatNumber(parameter.Minimum) << " .. " << FormatNumber(parameter.Maximum)
                << ") " << parameter.Description << "\n";
    }
  }
}

void Run(const GenerateOptions& options)
{
  if (options.List)
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
    throw UsageError("--output is required: the file to write, ending in .vtu, or in .pvd with "
                     "--steps");
  }
  if (options.Steps > 0)
  {
    GenerateSteps(options);
  }
  else
  {
    GenerateFile(options);
  }
}

} // namespace

void AddGenerateCommand(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("generate", "Write a mesh that is made from a formula");
  const auto options = std::make_shared<GenerateOptions>();
  command->add_option("NAME", options->Name, "Which one: see --list")
    ->check(MakeNameCheck())
    ->type_name("");
  command
    ->add_option(
      "--output", options->Output, "File to write; - is standard output, which gets .vtu")
    ->check(MakeNameCheck())
    ->type_name("FILE.vtu|FILE.pvd");
  command
    ->add_option("--steps", options->Steps,
      "Write so many time steps of one period of a mesh that moves, as FILE_0000.vtu and so on "
      "beside the list of them, FILE.pvd; those move that have a parameter time")
    ->type_name("N")
    ->check(CLI::Range(1, LargestNumberOfSteps));
  command->add_flag("--list", options->List, "Print the names, and the parameters of each");
  command->allow_extras();
  command->footer("Each parameter that --list shows is an option with a number behind it, as in\n"
                  "  tetralux generate ball --cells 20 --output ball.vtu\n"
                  "  tetralux generate ring --steps 20 --output ring.pvd");
  command->final_callback(
    [command, options]
    {
      options->Parameters = command->remaining();
      Run(*options);
    });
}
