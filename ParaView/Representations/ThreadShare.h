// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ThreadShare_h
#define tetralux_ThreadShare_h

namespace tetralux
{

/// Leaves each process of a parallel run its share of the machine's cores, at least one, instead of
/// all to each: what OpenMP offers from now on, and with it what NumberOfThreads automatic means.
/// Does nothing in a run of one process, and if OMP_NUM_THREADS says how many to take.
void ShareThreads();

} // namespace tetralux

#endif
