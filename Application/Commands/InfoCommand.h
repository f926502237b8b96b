// SPDX-License-Identifier: BSD-3-Clause
#ifndef InfoCommand_h
#define InfoCommand_h

namespace CLI
{
class App;
}

/// Adds `tetralux info`, which prints what is in a file and what it takes to render it: cells by
/// type, points, arrays with their ranges, boundary, components, defects, memory, time to prepare.
void AddInfoCommand(CLI::App& app);

#endif
