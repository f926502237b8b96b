// SPDX-License-Identifier: BSD-3-Clause
#ifndef TrafficCommand_h
#define TrafficCommand_h

#include <functional>

struct BenchOptions;

namespace CLI
{
class App;
}

/// Adds --traffic to `tetralux bench`. The returned function runs the measurement and returns true
/// if --traffic is given, else it returns false.
///
/// The measurement prints to standard output what the order of S-triangles saves of the traffic
/// between a texturing unit and its memory (Knittel 1999, section 5), with the paper's numbers for
/// the paper's data: brain.vti and engine.vti in the folder of the data. A FILE, an image of
/// unsigned 8-bit values, is seen as the engine is. It throws UsageError if there is neither or if
/// other options are given, and WorkError if a file is no such image.
std::function<bool()> AddTrafficOptions(CLI::App* command, const BenchOptions& options);

#endif
