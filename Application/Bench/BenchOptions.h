// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchOptions_h
#define BenchOptions_h

#include "Setup/SceneOptions.h"

#include <cstdlib>
#include <string>
#include <vector>

/// What the options of `tetralux bench` say.
struct BenchOptions
{
  /// The user's file, its scalars and its camera. Without a file, only the size of the pictures and
  /// the threads count. A size of 0 is left to the run.
  SceneOptions Scene;

  std::string DataFolder;            ///< of the real data; empty: TETRALUX_DATA, or none
  std::vector<std::string> Scenes;   ///< names to which the run is limited; empty: all
  std::vector<std::string> Settings; ///< "Property=Value ...", instead of the listed ones
  int Frames = 10;                   ///< measured for each picture, at most
  bool Quick = false;
  bool Features = false;
  std::string Output;
};

/// The folder of the real data, or nothing.
inline std::string GetDataFolder(const BenchOptions& options)
{
  const char* folder = std::getenv("TETRALUX_DATA");
  const bool given = !options.Scene.Input.Name.empty() || !options.DataFolder.empty();
  return given || folder == nullptr ? options.DataFolder : folder;
}

#endif
