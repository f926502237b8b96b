// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_AllProcesses_h
#define tetralux_AllProcesses_h

#include <vector>

namespace tetralux
{

/// Whether there are several processes, which render together.
bool IsParallel();

/// This process's number, 0 for the first one.
int GetProcess();

/// What follows from a number, or the bounds of data, in each process. To be called by all of them
/// at once. bounds: not initialized, or nullptr, where a process has no data; and then so in all.
///@{
double Add(double mine);
void UniteBounds(const double* mine, double united[6]);
///@}

/// Returns the numbers of all processes one after another, those of the first one first. To be
/// called by all of them at once, with as many numbers each.
std::vector<double> Gather(const std::vector<double>& mine);

} // namespace tetralux

#endif
