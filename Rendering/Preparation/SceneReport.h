// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SceneReport_h
#define tetralux_SceneReport_h

// What statistics say of a scene.

#include "Integral/Integrator.h"
#include "Report/Json.h"

namespace tetralux
{

class ScenePreparation;

/// Adds the seconds of the stages of the last Update.
void DescribeSeconds(const ScenePreparation& preparation, Json& seconds);

/// Counts of the input's points and cells, and its array.
Json DescribeInput(const ScenePreparation& preparation);

/// Counts and sizes of what was built.
Json DescribeTables(const ScenePreparation& preparation);

/// Bytes of what is kept: the mesh in double precision, its scalars, the tables that rays are
/// walked through, imaginary cells, and the pre-integration table.
Json DescribeMemory(const ScenePreparation& preparation);

/// How segments are integrated, by which table, and why.
Json DescribeSegments(const ScenePreparation& preparation, Integrator integrator);

} // namespace tetralux

#endif
