// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ScalarRange_h
#define tetralux_ScalarRange_h

#include <array>

namespace tetralux
{

struct SelectedArray;

/// Smallest and largest finite scalar of an array. Where all are the same, or none is finite, the
/// second number is the first one plus 1.
std::array<double, 2> FindScalarRange(const SelectedArray& scalars);

} // namespace tetralux

#endif
