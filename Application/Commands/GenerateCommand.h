// SPDX-License-Identifier: BSD-3-Clause
#ifndef GenerateCommand_h
#define GenerateCommand_h

namespace CLI
{
class App;
}

/// Adds `tetralux generate`, which writes a generated mesh as .vtu, or lists the generators.
void AddGenerateCommand(CLI::App& app);

#endif
