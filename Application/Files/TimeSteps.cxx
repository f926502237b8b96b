// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TimeSteps.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/OptionValues.h"

#include <algorithm>
#include <cmath>
#include <iterator>

std::size_t ChooseTimeStep(const InputFile& input, const std::vector<double>& times)
{
  if (!input.Time && !input.TimeStep)
  {
    return 0;
  }
  const std::string option = input.Time ? "--time: " + FormatNumber(*input.Time)
                                        : "--time-step: " + std::to_string(*input.TimeStep);
  if (times.empty())
  {
    throw WorkError(option + ": '" + input.Name + "' has no time steps");
  }
  if (input.TimeStep)
  {
    const auto step = static_cast<std::size_t>(*input.TimeStep);
    if (step >= times.size())
    {
      throw WorkError(option + " is not one of the steps of '" + input.Name + "', 0 .. " +
        std::to_string(times.size() - 1));
    }
    return step;
  }
  if (*input.Time < times.front() || *input.Time > times.back())
  {
    throw WorkError(
      option + " is outside of '" + input.Name + "': it has " + DescribeTimeSteps(times));
  }
  const auto nearest = std::min_element(times.begin(), times.end(),
    [&input](double a, double b) { return std::abs(a - *input.Time) < std::abs(b - *input.Time); });
  return static_cast<std::size_t>(std::distance(times.begin(), nearest));
}

std::string DescribeTimeSteps(const std::vector<double>& times)
{
  return std::to_string(times.size()) + (times.size() == 1 ? " time step, " : " time steps, ") +
    FormatNumber(times.front()) + (times.size() == 1 ? "" : " .. " + FormatNumber(times.back()));
}
