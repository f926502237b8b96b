// SPDX-License-Identifier: BSD-3-Clause
#ifndef Generate_h
#define Generate_h

#include <string>
#include <vector>

struct GenerateOptions
{
  std::string Name;
  std::string Output;
  std::vector<std::string> Parameters; ///< "--name", "value", or "--name=value", as they came
};

/// Makes a mesh by its name and writes it as .vtu.
void GenerateFile(const GenerateOptions& options);

/// Prints every generator with its parameters to standard output.
void ListGenerators();

#endif
