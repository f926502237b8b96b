// SPDX-License-Identifier: BSD-3-Clause
#ifndef Bench_h
#define Bench_h

struct BenchOptions;

/// Measures error and time of methods and settings in several scenes, and writes a folder with a
/// page of the results. Throws UsageError before anything is read, WorkError after.
void RunBench(const BenchOptions& options);

#endif
