// SPDX-License-Identifier: BSD-3-Clause
#include "Visibility/MeshOrder.h"

#include "Base/Stopwatch.h"
#include "Walk/WalkMesh.h"

namespace tetralux
{
namespace
{

/// Faces that finding gaps may look at for each boundary face. With some 15 cells for a boundary
/// face that takes as long as all else in an order.
constexpr std::int64_t CostlyLooks = 500;

} // namespace

//----------------------------------------------------------------------------
MeshOrder::MeshOrder(WalkMesh& mesh)
  : Mesh(mesh)
{
}

MeshOrder::~MeshOrder() = default;

//----------------------------------------------------------------------------
const std::vector<std::int32_t>* MeshOrder::Sort(const VisibilityView& view, OrderWish wish,
  VisibilityDirection direction, Span<const std::uint8_t> drawn,
  const std::function<bool(double)>& progress)
{
  this->ConvexificationSeconds = 0;
  this->TableSeconds = 0;
  const bool automatic = wish == OrderWish::Automatic;
  bool convexify = wish == OrderWish::Convexified || (automatic && this->GapsAreCostly);
  for (;;)
  {
    Stopwatch watch;
    if (convexify && !this->Mesh.GetConvexification())
    {
      this->Mesh.MakeConvex(progress);
      this->ConvexificationSeconds = watch.Lap();
      if (!this->Mesh.GetConvexification())
      {
        return nullptr;
      }
    }
    const bool imaginary =
      wish == OrderWish::Convexified || (automatic && this->Mesh.GetConvexification());
    if (!this->Order || this->Imaginary != imaginary)
    {
      this->Order.reset();
      this->Order = std::make_unique<VisibilityOrder>(this->Mesh, imaginary);
      this->Imaginary = imaginary;
      this->TableSeconds += watch.Lap();
    }
    const VisibilityMethod method = wish == OrderWish::NonConvex ? VisibilityMethod::MeshedNonConvex
      : wish == OrderWish::Centroids         ? VisibilityMethod::CentroidDistance
      : imaginary && this->Order->IsConvex() ? VisibilityMethod::Meshed
                                             : VisibilityMethod::MeshedAcrossGaps;
    const std::vector<std::int32_t>& order = this->Order->Sort(view, method, direction, drawn);
    const bool mayBeConvex = automatic && !this->Mesh.GetConvexification();
    this->GapsAreCostly = mayBeConvex &&
      this->Order->GetLooksForGaps() > CostlyLooks * this->Mesh.GetNumberOfBoundaryFaces();
    convexify = mayBeConvex && this->Order->GetUsedMethod() == VisibilityMethod::MeshedNonConvex;
    if (!convexify)
    {
      return &order;
    }
  }
}

//----------------------------------------------------------------------------
const std::string& MeshOrder::GetRefusal() const
{
  static const std::string none;
  return this->Imaginary ? this->Mesh.GetConvexification()->Refusal : none;
}

} // namespace tetralux
