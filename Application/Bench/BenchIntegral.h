// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchIntegral_h
#define BenchIntegral_h

struct BenchMeasurement;
struct BenchRun;

/// Integrates the rays of a scene of image data, once: the reference of such a scene.
BenchMeasurement MeasureIntegral(const BenchRun& run);

#endif
