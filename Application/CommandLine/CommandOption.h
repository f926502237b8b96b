// SPDX-License-Identifier: BSD-3-Clause
#ifndef CommandOption_h
#define CommandOption_h

#include "CommandLine/CommandErrors.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <vector>

/// Adds an option to a command. If the option is given, parse(option, text) reads its text; it is
/// one of the functions of OptionValues.h, or calls one. help ends up in the command's --help.
template <class ParseT>
CLI::Option* AddOption(
  CLI::App* command, const std::string& name, const std::string& help, ParseT parse)
{
  return command
    ->add_option_function<std::string>(
      name, [name, parse](const std::string& text) { parse(name, text); }, help)
    ->type_name("");
}

/// Refuses an empty text, which stands for no name: often it comes from a variable of a script that
/// is not set.
inline CLI::Validator MakeNameCheck()
{
  return CLI::Validator([](std::string& text)
    { return text.empty() ? std::string("the name is empty") : std::string(); },
    "");
}

/// Throws UsageError if a command has an option that is not one of these. The first of names is the
/// option that the others have to go with.
inline void RefuseOtherOptions(const CLI::App* command, const std::vector<std::string>& names)
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

#endif
