// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchIntegral_h
#define BenchIntegral_h

struct BenchMeasurement;
struct BenchRun;

/// Integrates the rays of a scene, once, in double precision: the reference. Throws
/// WorkError, with one line, if the scene can't be prepared.
BenchMeasurement MeasureIntegral(const BenchRun& run);

#endif
