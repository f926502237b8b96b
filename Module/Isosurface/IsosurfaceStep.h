// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceStep_h
#define tetralux_IsosurfaceStep_h

#include "Base/Cached.h"
#include "Hierarchy/MinMaxTree.h"
#include "Isosurface/ActiveTree.h"
#include "Isosurface/CellField.h"
#include "Mesh/Gradients.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace tetralux
{

/// What follows from the points and scalars of one time step (Wald et al. 2007, section 6), and
/// from the values that were shown of it last.
struct IsosurfaceStep
{
  std::shared_ptr<MinMaxTree> Tree; ///< shared by steps with the same points
  MinMaxRanges Ranges;

  std::vector<double> Values; ///< ascending
  Cached<ActiveTree> Active;

  // One for each isopolygon.
  Cached<RawVector<CellField<3>>> Gradients; ///< between points
  Cached<RawVector<GradientRow>> CellGradients;
  Cached<RawVector<CellField<1>>> Colors;

  /// Bytes without the tree.
  std::size_t GetBytes() const
  {
    const ActiveTree& active = this->Active.Get();
    return this->Ranges.Nodes.size() * sizeof(MinMaxTree::Range) +
      active.Nodes.size() * sizeof(MinMaxTree::Node) + active.Polygons.size() * sizeof(Isopolygon) +
      this->Gradients.Get().size() * sizeof(CellField<3>) +
      this->CellGradients.Get().size() * sizeof(GradientRow) +
      this->Colors.Get().size() * sizeof(CellField<1>);
  }
};

} // namespace tetralux

#endif
