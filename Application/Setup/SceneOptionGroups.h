// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneOptionGroups_h
#define SceneOptionGroups_h

#include <string>

struct InputFile;
struct SceneOptions;
namespace CLI
{
class App;
class Option;
} // namespace CLI

/// Groups of options that several commands share. Each function adds a group to a command. The
/// second argument receives what is given and must live as long as the command.
///@{
/// The file to read, IN, --plot3d-q, --time and --time-step. Returns IN.
CLI::Option* AddInputOptions(CLI::App* command, InputFile& input);

/// --array, --component, --transfer, --opacity-unit-distance.
void AddScalarOptions(CLI::App* command, SceneOptions& options);

/// --camera-position, --camera-focal-point, --camera-view-up, --camera-view-angle,
/// --camera-parallel-scale.
void AddCameraOptions(CLI::App* command, SceneOptions& options);

/// --size, --threads.
void AddSizeOptions(CLI::App* command, SceneOptions& options);
///@}

#endif
