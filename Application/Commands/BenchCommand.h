// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchCommand_h
#define BenchCommand_h

namespace CLI
{
class App;
}

/// Adds `tetralux bench`, which measures error against run time. With --stability it runs
/// StabilityCommand.h instead, with --traffic TrafficCommand.h.
void AddBenchCommand(CLI::App& app);

#endif
