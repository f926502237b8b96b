// SPDX-License-Identifier: BSD-3-Clause
// The command line: runs a command, turns errors into one line and an exit status.

#include "CommandLine/CommandErrors.h"
#include "CommandLine/StandardStreams.h"
#include "CommandLine/Supervisor.h"
#include "Commands/BenchCommand.h"
#include "Commands/GenerateCommand.h"
#include "Commands/InfoCommand.h"
#include "Commands/RenderCommand.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <string>

namespace
{

enum ExitStatus
{
  Done = 0,
  WorkFailed = 1,
  WrongUsage = 2
};

/// Describes an error of CLI11 in one line that points to the command's help.
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
  PrintMessage(message);
  return status;
}

/// Runs the command line. Throws what the commands throw, and CLI11's errors.
void Run(CLI::App& app, int argc, char* argv[])
{
  app.set_version_flag("--version", TETRALUX_VERSION);
  app.require_subcommand(1);
  app.footer("tetralux COMMAND --help prints the options of a command.\n"
             "Exit status: 0 done, 1 the work failed, 2 wrong usage.");
  AddRenderCommand(app);
  AddInfoCommand(app);
  AddGenerateCommand(app);
  AddBenchCommand(app);
  app.parse(argc, argv);
}

/// Runs the command line and returns the exit status.
int RunTool(int argc, char* argv[])
try
{
  CLI::App app(
    "Volume rendering of unstructured grids and image data with a known error", "tetralux");
  try
  {
    Run(app, argc, argv);
  }
  catch (const CLI::Success& success) // help and version
  {
    std::ostringstream text;
    app.exit(success, text);
    std::cout << text.str();
  }
  catch (const CLI::ParseError& error)
  {
    return Fail(Describe(error, app), WrongUsage);
  }
  CheckStandardOutput();
  return Done;
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

} // namespace

int main(int argc, char* argv[])
{
  OpenStandardStreams();
  return Supervise([argc, argv] { return RunTool(argc, argv); });
}
