// SPDX-License-Identifier: BSD-3-Clause

// The integral over a segment of a ray: nanoseconds for LaneCount of them at once. Compiled as
// the fastest kernels are.

#include "Integral/SegmentIntegral.h"
#include "Simd/InstructionSet.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;
using namespace tetralux::TETRALUX_ISA;

/// Which form of the integral a packet needs.
enum class Form
{
  Thin,
  Rising,
  Falling,
  Mixed ///< some lanes need each of them
};

void IntegrateSegments(benchmark::State& state, Form form)
{
#ifdef __AVX2__
  if (GetInstructionSet() != InstructionSet::Avx2)
  {
    state.SkipWithError("this processor has no AVX2");
    return;
  }
#endif
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int Packets = 256; // stay in the first-level cache
  std::vector<float> d0, d1;
  for (int i = 0; i < Packets * LaneCount; ++i)
  {
    const bool thin = form == Form::Thin || (form == Form::Mixed && i % 3 == 0);
    const bool rising = form == Form::Rising || (form == Form::Mixed && i % 3 == 1);
    const double depth = thin ? std::pow(10, -4 * unit(generator) - 0.5) : 2 + 8 * unit(generator);
    const double share = 0.5 * unit(generator);
    d0.push_back(static_cast<float>(2 * depth * (rising ? share : 1 - share)));
    d1.push_back(static_cast<float>(2 * depth * (rising ? 1 - share : share)));
  }
  Float8 front = 0.f, back = 0.f;
  for (auto _ : state)
  {
    for (int i = 0; i < Packets * LaneCount; i += LaneCount)
    {
      const SegmentWeights w = IntegrateSegment(LoadFloat8(&d0[i]), LoadFloat8(&d1[i]));
      front = front + w.Front * w.Transmittance;
      back = back + w.Back;
    }
    benchmark::DoNotOptimize(Lane(front, 0) + Lane(back, 0));
  }
  state.counters["Packet"] = benchmark::Counter(
    Packets, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
#ifdef __AVX2__
  state.SetLabel(GetName(InstructionSet::Avx2));
#else
  state.SetLabel(GetName(InstructionSet::Generic));
#endif
}

BENCHMARK_CAPTURE(IntegrateSegments, thin, Form::Thin)->Name("Integral/thin");
BENCHMARK_CAPTURE(IntegrateSegments, rising, Form::Rising)->Name("Integral/rising");
BENCHMARK_CAPTURE(IntegrateSegments, falling, Form::Falling)->Name("Integral/falling");
BENCHMARK_CAPTURE(IntegrateSegments, mixed, Form::Mixed)->Name("Integral/mixed");

} // namespace
