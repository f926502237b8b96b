// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_AllProcesses_h
#define tetralux_AllProcesses_h

namespace tetralux
{

/// Whether there are several processes, which render together.
bool IsParallel();

/// What follows from a number, or the bounds of data, in each process. To be called by all of them
/// at once. bounds: not initialized, or nullptr, where a process has no data; and then so in all.
///@{
double Add(double mine);
void UniteBounds(const double* mine, double united[6]);
///@}

} // namespace tetralux

#endif
