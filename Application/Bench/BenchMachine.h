// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchMachine_h
#define BenchMachine_h

#include <string>
#include <utility>
#include <vector>

/// What the results depend on, as pairs of a label and a value: the class of the processor, cores,
/// what renders OpenGL, versions. Nothing that tells one machine of its class from another.
std::vector<std::pair<std::string, std::string>> DescribeMachine(
  const std::string& openGLRenderer, int numberOfThreads);

#endif
