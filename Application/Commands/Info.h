// SPDX-License-Identifier: BSD-3-Clause
#ifndef Info_h
#define Info_h

#include <string>

struct InfoOptions
{
  std::string Input;
  std::string Plot3dSolution;
};

/// Prints to standard output what is in a file and what rendering it takes: cells by type, points,
/// arrays with their ranges, boundary, components, defects, memory and time to prepare.
void PrintInfo(const InfoOptions& options);

#endif
