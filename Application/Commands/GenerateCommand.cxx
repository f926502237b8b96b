// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/GenerateCommand.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "CommandLine/ProgressLine.h"
#include "Files/AtomicOutput.h"
#include "Files/GeneratedGrid.h"
#include "Files/WriteData.h"
#include "Generate/GeneratedMeshes.h"

#include "vtkUnstructuredGrid.h"

#include <iostream>
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
  bool List = false;
};

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

void GenerateFile(const GenerateOptions& options)
{
  if (GetExtension(options.Output) != ".vtu")
  {
    throw UsageError("--output: '" + options.Output + "' must end in .vtu");
  }
  const std::map<std::string, double> parameters = ReadParameters(options.Parameters);
  AtomicOutput output(options.Output);
  ProgressLine progress("generating " + options.Name);
  progress.ShowLabel();
  tetralux::GeneratedMesh generated;
  try
  {
    generated = tetralux::GenerateMesh(options.Name, parameters);
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(std::string("generate: ") + error.what());
  }
  WriteXml(MakeGrid(generated), output.GetTemporaryName(), options.Output);
  output.Commit();
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
    throw UsageError("--output is required: the file to write, ending in .vtu");
  }
  GenerateFile(options);
}

} // namespace

void AddGenerateCommand(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("generate", "Write a mesh that is made from a formula");
  const auto options = std::make_shared<GenerateOptions>();
  command->add_option("NAME", options->Name, "Which one: see --list")->type_name("");
  command->add_option("--output", options->Output, "File to write")->type_name("FILE.vtu");
  command->add_flag("--list", options->List, "Print the names, and the parameters of each");
  command->allow_extras();
  command->footer("Each parameter that --list shows is an option with a number behind it, as in\n"
                  "  tetralux generate ball --cells 20 --output ball.vtu");
  command->final_callback(
    [command, options]
    {
      options->Parameters = command->remaining();
      Run(*options);
    });
}
