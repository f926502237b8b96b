// SPDX-License-Identifier: BSD-3-Clause
#ifndef Bench_h
#define Bench_h

#include "Commands/Render.h"

#include <string>
#include <vector>

/// What the options of `tetralux bench` say.
struct BenchOptions
{
  /// Of a file of the user's: what to colour by, how, and from where. Without a file, the size of the
  /// pictures and the threads; a size of 0 is left to the run.
  RenderOptions Scene;

  std::string DataFolder;            ///< of the real data; empty: TETRALUX_DATA, else none
  std::vector<std::string> Scenes;   ///< names to which the run is limited; empty: all
  std::vector<std::string> Settings; ///< "Property=Value ...", in place of those there are
  int Frames = 10;                   ///< measured for each picture, at most
  bool Quick = false;
  bool Features = false;
  std::string Output;
};

/// Measures error and time of methods and settings over scenes, and writes a folder with a page of
/// the results. Throws UsageError before anything is read, WorkError after.
void RunBench(const BenchOptions& options);

#endif
