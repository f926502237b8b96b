// SPDX-License-Identifier: BSD-3-Clause
#ifndef CommandOption_h
#define CommandOption_h

#include <CLI/CLI.hpp>

#include <string>

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

#endif
