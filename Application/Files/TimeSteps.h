// SPDX-License-Identifier: BSD-3-Clause
#ifndef TimeSteps_h
#define TimeSteps_h

#include "Files/InputFile.h"

#include <cstddef>
#include <string>
#include <vector>

/// The step that an input asks for, counted from 0: the one nearest to its time, or the first.
/// times: of all steps, ascending; empty in a file without time. Throws WorkError, with the range
/// there is, for a time or a step outside of it.
std::size_t ChooseTimeStep(const InputFile& input, const std::vector<double>& times);

/// "5 time steps, 0 .. 0.4".
std::string DescribeTimeSteps(const std::vector<double>& times);

#endif
