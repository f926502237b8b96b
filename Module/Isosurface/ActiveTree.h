// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ActiveTree_h
#define tetralux_ActiveTree_h

#include "Base/RawVector.h"
#include "Hierarchy/MinMaxTree.h"
#include "Isosurface/CellField.h"
#include "Isosurface/Isopolygon.h"
#include "Mesh/Gradients.h"
#include "TetraluxCoreModule.h"

#include <vector>

namespace tetralux
{

/// The part of a MinMaxTree that some values are in, with their isopolygons: made once, and traced
/// until values, scalars or points change (Wald et al. 2007, section 4.4, full pre-computation, and
/// figure 5). Nodes with one active child are left out, and boxes fit the polygons.
struct ActiveTree
{
  /// Leaves hold Polygons[First ... First + Count).
  std::vector<MinMaxTree::Node> Nodes;
  RawVector<Isopolygon> Polygons;
};

/// threads is at least 1; the tree is the same for any number. memory: of polygons that are of no
/// use any more.
TETRALUXCORE_EXPORT ActiveTree MakeActiveTree(const MinMaxTree& tree, const MinMaxRanges& ranges,
  const IsopolygonSource& source, int threads, RawVector<Isopolygon> memory = {});

/// The scalars of points in each polygon's cell.
TETRALUXCORE_EXPORT RawVector<CellField<1>> MakeScalarFields(
  const ActiveTree& tree, const IsopolygonSource& source, const double* scalars, int threads);

/// The gradients of each polygon's cell, interpolated between those of its points.
TETRALUXCORE_EXPORT RawVector<CellField<3>> MakeGradientFields(const ActiveTree& tree,
  const IsopolygonSource& source, const GradientRow* gradients, int threads);

/// MakeCellGradient of each polygon's cell. memory: of gradients that are of no use any more.
TETRALUXCORE_EXPORT RawVector<GradientRow> MakePolygonGradients(const ActiveTree& tree,
  const TetrahedralMesh& mesh, Span<const double> scalars, double length, double scalar,
  int threads, RawVector<GradientRow> memory = {});

} // namespace tetralux

#endif
