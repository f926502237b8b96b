// SPDX-License-Identifier: BSD-3-Clause
#ifndef InputFile_h
#define InputFile_h

#include <optional>
#include <string>

/// What the options say about the file to read.
struct InputFile
{
  /// A PLOT3D grid may be both of its files, with a comma between.
  std::string Name;

  std::string Plot3dSolution; ///< of PLOT3D coordinates; empty for all other files

  // Of a file with several time steps; at most one of them is given, and none is the first step.
  std::optional<double> Time;  ///< in the file's own units; the nearest step is taken
  std::optional<int> TimeStep; ///< counted from 0
};

#endif
