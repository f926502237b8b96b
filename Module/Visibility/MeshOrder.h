// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshOrder_h
#define tetralux_MeshOrder_h

#include "Base/Span.h"
#include "TetraluxCoreModule.h"
#include "Visibility/VisibilityOrder.h"
#include "Visibility/VisibilityView.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tetralux
{

class WalkMesh;

/// Which order is asked for.
enum class OrderWish
{
  /// Exact, by what costs less: across gaps, which needs nothing but the mesh. As Convexified from
  /// where on gaps were too many in a view, or took longer to find than all else takes. So a mesh
  /// that is seen once is hardly ever made convex, which takes some 25 times as long as an order.
  Automatic,

  Convexified, ///< Meshed, the mesh made convex; MeshedAcrossGaps if it can't be
  AcrossGaps,  ///< MeshedAcrossGaps
  NonConvex,   ///< MeshedNonConvex
  Centroids    ///< CentroidDistance
};

/// The visibility orders of one mesh, view after view. Makes it convex if a wish needs that. Which
/// method is used depends on the mesh, the wishes and the views alone.
class TETRALUXCORE_EXPORT MeshOrder
{
public:
  /// The mesh must outlive this, and its points must stay.
  explicit MeshOrder(WalkMesh& mesh);
  ~MeshOrder();

  /// Sorts, see VisibilityOrder::Sort. progress: called while the mesh is made convex, with a
  /// fraction 0..1. Returns nullptr if it returned false; else the cells, until the next call.
  const std::vector<std::int32_t>* Sort(const VisibilityView& view, OrderWish wish,
    VisibilityDirection direction, Span<const std::uint8_t> drawn = {},
    const std::function<bool(double)>& progress = {});

  /// What made the last order; after a Sort that was not aborted.
  const VisibilityOrder& Get() const { return *this->Order; }

  /// Why the mesh could not be made convex; empty if it could, or if no Sort tried.
  const std::string& GetRefusal() const;

  /// What the last Sort took beside sorting, seconds.
  double GetConvexificationSeconds() const { return this->ConvexificationSeconds; }
  double GetTableSeconds() const { return this->TableSeconds; }

private:
  WalkMesh& Mesh;
  std::unique_ptr<VisibilityOrder> Order;
  bool Imaginary = false;     ///< whether Order was made to have imaginary cells
  bool GapsAreCostly = false; ///< those of the view before
  double ConvexificationSeconds = 0;
  double TableSeconds = 0;
};

} // namespace tetralux

#endif
