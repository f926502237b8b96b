// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IncrementalTable_h
#define tetralux_IncrementalTable_h

#include "Optics/TransferFunction.h"
#include "PreIntegration/PreIntegrationTable.h"

namespace tetralux
{

/// Fills a table by increments, to be compared with BuildPreIntegrationTable: the shortest segments
/// by the closed form, longer ones each from one that is a step shorter and one of a step (Weiler
/// et al. 2003, equations 5 and 6), by the table's own interpolation at the split. Errors add up
/// from one length to the next.
///
/// For LengthScale::Linear, ScalarAxis::Uniform and TexelFormat::Float. In all threads of OpenMP.
/// Leaves Bound as it is.
void BuildIncrementalTable(const TransferFunction& function, const PreIntegrationSettings& settings,
  PreIntegrationTable& table);

} // namespace tetralux

#endif
