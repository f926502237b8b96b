// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/StabilityCommand.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "Stability/StabilitySuite.h"

#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace
{

struct StabilityOptions
{
  std::uint64_t Seed = 1;  ///< of the random cases
  int RandomCases = 10000; ///< number of random cases, in addition to those that are listed
};

constexpr int MaximumCases = 100000000;

/// Widths of the table's columns.
constexpr int GroupWidth = 32;
constexpr int NumberWidth = 11;

std::string FormatError(double error)
{
  std::ostringstream text;
  text << std::scientific << std::setprecision(1) << error;
  return text.str();
}

template <class CasesT, class RelativeT, class AbsoluteT, class PromiseT, class BadT>
void PrintColumns(const std::string& group, const CasesT& cases, const RelativeT& relative,
  const AbsoluteT& absolute, const PromiseT& promise, const BadT& bad)
{
  std::cout << "  " << std::left << std::setw(GroupWidth) << group << std::right;
  std::cout << std::setw(NumberWidth) << cases << std::setw(NumberWidth) << relative
            << std::setw(NumberWidth) << absolute << std::setw(NumberWidth) << promise
            << std::setw(NumberWidth) << bad << "\n";
}

void RunStability(const StabilityOptions& options)
{
  const std::vector<tetralux::StabilityGroup> groups =
    tetralux::MakeStabilityGroups(options.Seed, options.RandomCases);
  const std::vector<tetralux::StabilityForm> forms = tetralux::MakeStabilityForms();
  const std::vector<tetralux::StabilityRow> rows = tetralux::MeasureStability(groups, forms);

  std::cout << "Ray integrals over one segment, against quadrature in numbers of "
            << std::numeric_limits<tetralux::Extended>::digits
            << " bits.\n"
               "relative: largest error of a colour channel or the opacity, over the opacity\n"
               "absolute: largest error of a colour channel or the opacity\n"
               "promise:  largest error over what the form promises for the case, at most 1\n"
               "bad:      not finite, negative, or an opacity above 1\n"
               "Seed of the random combinations: "
            << options.Seed << "\n";

  int notFinite = 0;
  int negative = 0;
  int aboveOne = 0;
  std::string broken;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const tetralux::StabilityRow& row = rows[i];
    if (i % groups.size() == 0)
    {
      std::cout << "\n" << row.Form << ": promises " << forms[i / groups.size()].Promise << "\n";
      PrintColumns("", "cases", "relative", "absolute", "promise", "bad");
    }
    PrintColumns(row.Group, row.NumberOfCases, FormatError(row.RelativeError),
      FormatError(row.AbsoluteError), FormatError(row.ShareOfPromise),
      row.NotFinite + row.Negative + row.AboveOne);
    notFinite += row.NotFinite;
    negative += row.Negative;
    aboveOne += row.AboveOne;
    if (!row.IsKept() && broken.empty())
    {
      broken = row.Form + " on " + row.Group;
    }
  }
  std::cout << "\nNot finite: " << notFinite << ", negative: " << negative
            << ", opacity above 1: " << aboveOne << "\n";
  if (!broken.empty())
  {
    throw WorkError("a form of the ray integral breaks its promise: " + broken +
      ", with the seed " + std::to_string(options.Seed));
  }
}

} // namespace

std::function<bool()> AddStabilityOptions(CLI::App* command)
{
  const auto options = std::make_shared<StabilityOptions>();
  CLI::Option* stability = command->add_flag("--stability",
    "Measure, in place of pictures, the ray integral over one segment where it is hard to get "
    "right: each form of it against quadrature in extended precision");
  AddOption(command, "--seed", "With --stability: seed of the random cases; default: 1",
    [options](const std::string& option, const std::string& text)
    {
      options->Seed =
        static_cast<std::uint64_t>(ParseInteger(option, text, 0, std::numeric_limits<int>::max()));
    })
    ->type_name("N")
    ->needs(stability);
  AddOption(command, "--cases", "With --stability: number of random cases; default: 10000",
    [options](const std::string& option, const std::string& text)
    { options->RandomCases = ParseInteger(option, text, 0, MaximumCases); })
    ->type_name("N")
    ->needs(stability);
  return [command, stability, options]
  {
    if (stability->count() == 0)
    {
      return false;
    }
    RefuseOtherOptions(command, { "--stability", "--seed", "--cases" });
    RunStability(*options);
    return true;
  };
}
