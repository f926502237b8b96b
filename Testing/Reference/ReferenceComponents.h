// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceComponents_h
#define tetralux_ReferenceComponents_h

#include "Optics/ComponentFunctions.h"
#include "ReferenceRenderer.h"

namespace tetralux
{

/// A picture of several scalars, by small steps through each cell on its own: emission and
/// absorption, of a mesh whose cells do not overlap. scalars: of each component, at points or at
/// cells as mesh.CellScalars says; mesh.Scalars is not read. Between nodes of the functions there
/// are at least ReferenceSteps in a cell, of an optical depth of at most ReferenceStepDepth. Four
/// numbers for each pixel, as ReferenceImage::Rgba.
std::vector<double> RenderComponents(const ReferenceMesh& mesh,
  const std::vector<std::vector<double>>& scalars, const ComponentFunctions& components,
  const RayGrid& rays, const RayLimits& limits = {});

constexpr double ReferenceStepDepth = 0.005;
constexpr int ReferenceSteps = 40;

} // namespace tetralux

#endif
