// SPDX-License-Identifier: BSD-3-Clause
#ifndef RenderCommand_h
#define RenderCommand_h

namespace CLI
{
class App;
}

/// Adds `tetralux render`, which renders a file to a picture.
void AddRenderCommand(CLI::App& app);

#endif
