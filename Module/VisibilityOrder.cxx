// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityOrder.h"

#include "RadixSort.h"
#include "VisibilityArrows.h"
#include "VisibilityCycles.h"
#include "VisibilityGeometry.h"
#include "WalkMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

// What SortByFaces adds to the bits of VisibilityArrows.h.
constexpr std::uint8_t VisitedCell = 0x40;
constexpr std::uint8_t PlacedCell = 0x80;

/// How far away the centroids of cells are, relative to the centre of the mesh: so that single
/// precision resolves cells however far away the viewer is.
class CentroidDistances
{
public:
  CentroidDistances(
    const VisibilityGeometry& geometry, const WalkMesh& mesh, const VisibilityView& view)
    : Geometry(geometry)
    , View(view)
  {
    double length = 0;
    for (const double component : view.Direction)
    {
      length = std::hypot(length, component);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Direction[axis] = view.Direction[axis] / length;
    }
    this->Offset = this->Measure(mesh.GetCenter());
  }

  float operator()(std::int64_t cell) const
  {
    const auto corners = this->Geometry.GetCorners(cell);
    double centroid[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      centroid[axis] =
        0.25 * (corners[0][axis] + corners[1][axis] + corners[2][axis] + corners[3][axis]);
    }
    return static_cast<float>(this->Measure(centroid) - this->Offset);
  }

private:
  double Measure(const double* point) const
  {
    double product = 0, square = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double difference = point[axis] - this->View.Eye[axis];
      square += difference * difference;
      product += point[axis] * this->Direction[axis];
    }
    return this->View.Parallel ? product : std::sqrt(square);
  }

  const VisibilityGeometry& Geometry;
  const VisibilityView& View;
  double Direction[3]; ///< of length 1
  double Offset = 0;   ///< distance of the mesh's centre
};

} // namespace

class VisibilityOrder::Internals
{
public:
  Internals(const WalkMesh& mesh, bool imaginaryCells);

  /// Fills KeyedCells with those that cells(cell) selects, by descending distance.
  template <class Select>
  void SortByDistance(const VisibilityView& view, const Select& select);

  /// Hands the cells to place(cell), each behind all that it hides: roots first, then from the others
  /// those that are left. False, and some cells in no particular order, where there is a cycle.
  template <class Place>
  bool SortByFaces(Span<const KeyedItem> roots, const Place& place);

  const WalkMesh& Mesh;
  std::vector<std::int32_t> ImaginaryCells;
  VisibilityGeometry Geometry;
  VisibilityArrows Arrows;

  // Of the last order, kept for the next one.
  std::vector<std::uint8_t> States;
  std::vector<std::int32_t> Path;
  std::vector<KeyedItem> KeyedCells, KeyedBuffer;
};

namespace
{

std::vector<std::int32_t> SortImaginaryCells(const WalkMesh& mesh)
{
  std::vector<std::int32_t> cells;
  if (!mesh.GetConvexTables().Faces.empty())
  {
    cells = mesh.GetConvexification()->Cells;
    for (std::size_t cell = 0; cell < cells.size(); cell += 4)
    {
      std::sort(&cells[cell], &cells[cell] + 4);
    }
  }
  return cells;
}

VisibilityGeometry MakeGeometry(const WalkMesh& mesh, Span<const std::int32_t> imaginaryCells)
{
  VisibilityGeometry geometry;
  geometry.Points = mesh.GetMesh().Points;
  geometry.Cells = mesh.GetMesh().Cells;
  geometry.RelativePoints = mesh.GetPoints<float>();
  std::copy_n(mesh.GetCenter(), 3, geometry.Center.begin());
  geometry.Radius = mesh.GetRadius();
  geometry.Faces = imaginaryCells.empty() ? mesh.GetTables().Faces : mesh.GetConvexTables().Faces;
  if (!imaginaryCells.empty())
  {
    geometry.SteinerPoints = mesh.GetConvexification()->SteinerPoints;
    geometry.ImaginaryCells = imaginaryCells;
  }
  return geometry;
}

} // namespace

//----------------------------------------------------------------------------
VisibilityOrder::Internals::Internals(const WalkMesh& mesh, bool imaginaryCells)
  : Mesh(mesh)
  , ImaginaryCells(imaginaryCells ? SortImaginaryCells(mesh) : std::vector<std::int32_t>())
  , Geometry(MakeGeometry(mesh, this->ImaginaryCells))
  , Arrows(this->Geometry)
{
}

//----------------------------------------------------------------------------
template <class Select>
void VisibilityOrder::Internals::SortByDistance(const VisibilityView& view, const Select& select)
{
  // Each part of the cells for itself, so that the order does not depend on the number of threads.
  constexpr std::int64_t ChunkSize = 1 << 14;
  const std::int64_t numberOfCells = this->Geometry.GetNumberOfCells();
  const std::int64_t chunks = (numberOfCells + ChunkSize - 1) / ChunkSize;
  std::vector<std::int64_t> begins(chunks + 1, 0);
#pragma omp parallel for schedule(static) if (chunks > 1)
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
  {
    const std::int64_t end = std::min(numberOfCells, (chunk + 1) * ChunkSize);
    for (std::int64_t cell = chunk * ChunkSize; cell < end; ++cell)
    {
      begins[chunk + 1] += select(cell) ? 1 : 0;
    }
  }
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
  {
    begins[chunk + 1] += begins[chunk];
  }
  this->KeyedCells.resize(begins[chunks]);
  const CentroidDistances distances(this->Geometry, this->Mesh, view);
#pragma omp parallel for schedule(static) if (chunks > 1)
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
  {
    std::int64_t next = begins[chunk];
    const std::int64_t end = std::min(numberOfCells, (chunk + 1) * ChunkSize);
    for (std::int64_t cell = chunk * ChunkSize; cell < end; ++cell)
    {
      if (select(cell))
      {
        this->KeyedCells[next++] = { ~GetSortableBits(distances(cell)),
          static_cast<std::int32_t>(cell) };
      }
    }
  }
  SortByKey(this->KeyedCells, this->KeyedBuffer);
}

//----------------------------------------------------------------------------
template <class Place>
bool VisibilityOrder::Internals::SortByFaces(Span<const KeyedItem> roots, const Place& place)
{
  // Depth first: a cell is placed once everything that it hides is. The bits of faces are cleared as
  // they are followed, so that a path needs no more than its cells.
  std::uint8_t* states = this->States.data();
  const WalkFace* faces = this->Geometry.Faces.data();
  bool cycle = false;
  const auto visit = [&](std::int32_t root)
  {
    if ((states[root] & VisitedCell) != 0)
    {
      return;
    }
    states[root] |= VisitedCell;
    this->Path.push_back(root);
    while (!this->Path.empty())
    {
      const std::int32_t cell = this->Path.back();
      const WalkFace* facesOfCell = faces + 4 * static_cast<std::int64_t>(cell);
      const std::uint8_t state = states[cell];
      bool leaf = true;
      for (int face = 0; face < 4; ++face)
      {
        if ((state >> face & 1) != 0)
        {
          const std::int32_t behind = facesOfCell[face].Cell;
          if ((states[behind] & VisitedCell) == 0)
          {
            // The faces before this one were followed, too.
            states[cell] = state & static_cast<std::uint8_t>(~((2 << face) - 1));
            states[behind] |= VisitedCell;
            this->Path.push_back(behind);
            leaf = false;
            break;
          }
          cycle = cycle || (states[behind] & PlacedCell) == 0;
        }
      }
      if (leaf)
      {
        this->Path.pop_back();
        states[cell] |= PlacedCell;
        place(cell);
      }
    }
  };
  for (const KeyedItem& root : roots)
  {
    visit(root.Item);
  }
  const std::int64_t numberOfCells = this->Geometry.GetNumberOfCells();
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    visit(static_cast<std::int32_t>(cell));
  }
  return !cycle;
}

//----------------------------------------------------------------------------
VisibilityOrder::VisibilityOrder(const WalkMesh& mesh, bool imaginaryCells)
  : Tables(std::make_unique<Internals>(mesh, imaginaryCells))
{
}

VisibilityOrder::~VisibilityOrder() = default;
VisibilityOrder::VisibilityOrder(VisibilityOrder&&) noexcept = default;
VisibilityOrder& VisibilityOrder::operator=(VisibilityOrder&&) noexcept = default;

//----------------------------------------------------------------------------
bool VisibilityOrder::IsConvex() const
{
  const Convexification* convex = this->Tables->Mesh.GetConvexification();
  return convex != nullptr && convex->Refusal.empty() &&
    convex->Cells.size() == this->Tables->ImaginaryCells.size();
}

//----------------------------------------------------------------------------
const std::vector<std::int32_t>& VisibilityOrder::Sort(const VisibilityView& view,
  VisibilityMethod method, VisibilityDirection direction, Span<const std::uint8_t> drawn)
{
  Internals& tables = *this->Tables;
  const std::int64_t ofMesh = static_cast<std::int64_t>(tables.Geometry.Cells.size() / 4);
  const auto isDrawn = [&](std::int64_t cell)
  { return cell < ofMesh && (drawn.empty() || drawn[cell] != 0); };
  const std::int64_t size =
    drawn.empty() ? ofMesh : ofMesh - std::count(drawn.begin(), drawn.end(), std::uint8_t{ 0 });
  this->Cycles = {};
  this->Order.resize(size);
  // Both ways yield the farthest cell first.
  const std::int64_t first = direction == VisibilityDirection::BackToFront ? 0 : size - 1;
  const std::int64_t step = direction == VisibilityDirection::BackToFront ? 1 : -1;

  if (method == VisibilityMethod::CentroidDistance)
  {
    tables.SortByDistance(view, isDrawn);
#pragma omp parallel for schedule(static) if (size > (1 << 14))
    for (std::int64_t i = 0; i < size; ++i)
    {
      this->Order[first + i * step] = tables.KeyedCells[i].Item;
    }
    return this->Order;
  }

  tables.States.resize(tables.Geometry.GetNumberOfCells());
  tables.Arrows.Point(view, tables.States);
  Span<const KeyedItem> roots;
  if (method == VisibilityMethod::MeshedNonConvex)
  {
    tables.SortByDistance(
      view, [&](std::int64_t cell) { return (tables.States[cell] & EnteredCell) != 0; });
    roots = tables.KeyedCells;
  }
  std::int64_t next = first;
  const auto place = [&](std::int32_t cell)
  {
    if (isDrawn(cell))
    {
      this->Order[next] = cell;
      next += step;
    }
  };
  if (!tables.SortByFaces(roots, place))
  {
    tables.Arrows.Point(view, tables.States);
    next = first;
    for (const std::int32_t cell :
      SortWithCycles(tables.Geometry, view, tables.States, roots, this->Cycles))
    {
      place(cell);
    }
  }
  return this->Order;
}

//----------------------------------------------------------------------------
std::size_t VisibilityOrder::GetSize() const
{
  const Internals& tables = *this->Tables;
  return tables.Arrows.GetSize() + tables.ImaginaryCells.size() * sizeof(std::int32_t) +
    tables.States.capacity() + tables.Path.capacity() * sizeof(std::int32_t) +
    (tables.KeyedCells.capacity() + tables.KeyedBuffer.capacity()) * sizeof(KeyedItem) +
    this->Order.capacity() * sizeof(std::int32_t);
}

} // namespace tetralux
