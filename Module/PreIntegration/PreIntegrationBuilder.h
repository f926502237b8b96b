// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PreIntegrationBuilder_h
#define tetralux_PreIntegrationBuilder_h

#include "PreIntegration/PreIntegrationTable.h"

#include <cstdint>

namespace tetralux
{

/// Fills a table in all threads of OpenMP; every number of threads makes the same bits. Uses the
/// memory of the table again if its size stays the same.
///
/// The time goes with the texels (at the speed of memory), and with their number along a scalar
/// squared times the nodes between two scalars.
///
/// Throws std::invalid_argument, with one line that says what is wrong: a transfer function that
/// MakeIntervalTable does not take, settings out of their ranges, colours outside of 0..1 for a
/// format that can't hold them, a scalar range or lengths beyond what single precision tells apart.
TETRALUXCORE_EXPORT void BuildPreIntegrationTable(const TransferFunction& function,
  const PreIntegrationSettings& settings, PreIntegrationTable& table);

/// Updates a table that was built from before to what BuildPreIntegrationTable makes of after.
/// Rebuilds the texels whose segments meet a scalar at which the two functions differ. Rebuilds all
/// texels if an axis changes (with ScalarAxis::Nodes: if a node comes, goes or moves, or if other
/// bends move texels), or if the largest attenuation passes a power of 2 on a long segment.
///
/// Returns the number of texels that were rebuilt. Throws as BuildPreIntegrationTable does, and
/// leaves the table as it is then.
TETRALUXCORE_EXPORT std::int64_t UpdatePreIntegrationTable(
  const TransferFunction& before, const TransferFunction& after, PreIntegrationTable& table);

/// The axes of a table; throw as BuildPreIntegrationTable does.
TETRALUXCORE_EXPORT ScalarAxisMap MakeScalarAxis(
  const TransferFunction& function, const PreIntegrationSettings& settings);
TETRALUXCORE_EXPORT LengthAxisMap MakeLengthAxis(const PreIntegrationSettings& settings);

} // namespace tetralux

#endif
