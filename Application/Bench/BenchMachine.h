// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchMachine_h
#define BenchMachine_h

#include <string>
#include <utility>
#include <vector>

/// Returns what the results depend on, as pairs of a label and a value: the class of the processor,
/// cores, OpenGL's renderer, versions. Nothing in it tells which machine of its class this is.
std::vector<std::pair<std::string, std::string>> DescribeMachine(
  const std::string& openGLRenderer, int numberOfThreads);

#endif
