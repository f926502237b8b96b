// SPDX-License-Identifier: BSD-3-Clause
#include "Visibility/VisibilityOrder.h"

#include "Base/Check.h"
#include "Base/CountingSort.h"
#include "Base/RadixSort.h"
#include "Visibility/TwinFaces.h"
#include "Visibility/VisibilityArrows.h"
#include "Visibility/VisibilityCycles.h"
#include "Visibility/VisibilityGaps.h"
#include "Visibility/VisibilityGeometry.h"
#include "Walk/WalkMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

// What SortByArrows adds to the bits of VisibilityArrows.h.
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

namespace
{

/// Writes cells to their places, farthest first, without those that are not wanted.
class CellWriter
{
public:
  CellWriter(std::vector<std::int32_t>& order, VisibilityDirection direction,
    std::int64_t numberOfCells, Span<const std::uint8_t> drawn)
    : Order(order.data())
    , Next(direction == VisibilityDirection::BackToFront ? 0 : std::ptrdiff_t(order.size()) - 1)
    , Step(direction == VisibilityDirection::BackToFront ? 1 : -1)
    , NumberOfCells(numberOfCells)
    , Drawn(drawn.empty() ? nullptr : drawn.data())
  {
  }

  void operator()(std::int32_t cell)
  {
    if (cell < this->NumberOfCells && (this->Drawn == nullptr || this->Drawn[cell] != 0))
    {
      TETRALUX_CHECK(0 <= this->Next && this->Next < this->NumberOfCells);
      this->Order[this->Next] = cell;
      this->Next += this->Step;
    }
  }

private:
  std::int32_t* Order;
  std::ptrdiff_t Next;
  std::ptrdiff_t Step;
  std::int32_t NumberOfCells; ///< without imaginary ones
  const std::uint8_t* Drawn;
};

} // namespace

class VisibilityOrder::Internals
{
public:
  Internals(const WalkMesh& mesh, bool imaginaryCells);

  /// Fills KeyedCells with those that cells(cell) selects, by descending distance.
  template <class Select>
  void SortByDistance(const VisibilityView& view, const Select& select);

  /// Hands the cells to write(cell), each behind all that it hides: roots first, then from the
  /// others those that are left. False, and some cells in no particular order, where there is a
  /// cycle. gaps: arrows across empty space, or none.
  bool SortByArrows(Span<const KeyedItem> roots, const VisibilityGaps& gaps, CellWriter write);

  const WalkMesh& Mesh;
  std::vector<std::int32_t> ImaginaryCells;
  VisibilityGeometry Geometry;
  VisibilityArrows Arrows;
  std::vector<std::int32_t> Twins; ///< once gaps were asked for

  // Of the last order, kept for the next one.
  std::vector<std::uint8_t> States;
  std::unique_ptr<std::int32_t[]> Path; ///< one for each cell, hardly ever used that far
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
  geometry.Boundary = &mesh.GetTables();
  geometry.RelativePoints = mesh.GetPoints<float>();
  std::copy_n(mesh.GetCenter(), 3, geometry.Center.begin());
  geometry.Radius = mesh.GetRadius();
  const WalkTables& tables = imaginaryCells.empty() ? mesh.GetTables() : mesh.GetConvexTables();
  geometry.Faces = tables.Faces;
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
bool VisibilityOrder::Internals::SortByArrows(
  Span<const KeyedItem> roots, const VisibilityGaps& gaps, CellWriter write)
{
  // Depth first: a cell is placed once everything that it hides is. The bits of faces are cleared
  // as they are followed, so that a path needs no more than its cells.
  std::vector<std::int32_t> nextGaps;
  if (!gaps.Cells.empty())
  {
    nextGaps.assign(gaps.Begins.begin(), gaps.Begins.end() - 1);
  }
  const std::int64_t numberOfCells = this->Geometry.GetNumberOfCells();
  const std::int64_t numberOfRoots = static_cast<std::int64_t>(roots.size());
  std::uint8_t* const states = this->States.data();
  const WalkFace* const faces = this->Geometry.Faces.data();
  std::int32_t* const path = this->Path.get();
  bool cycle = false;
  for (std::int64_t i = 0; i < numberOfRoots + numberOfCells; ++i)
  {
    const std::int32_t root =
      i < numberOfRoots ? roots[i].Item : static_cast<std::int32_t>(i - numberOfRoots);
    if ((states[root] & VisitedCell) != 0)
    {
      continue;
    }
    states[root] |= VisitedCell;
    path[0] = root;
    std::int64_t depth = 1;
    while (depth > 0)
    {
      const std::int32_t cell = path[depth - 1];
      const WalkFace* facesOfCell = faces + 4 * static_cast<std::int64_t>(cell);
      const unsigned state = states[cell];
      bool leaf = true;
      for (unsigned face = 0; face < 4; ++face)
      {
        if ((state >> face & 1) != 0)
        {
          const std::int32_t behind = facesOfCell[face].Cell;
          TETRALUX_CHECK(0 <= behind && behind < numberOfCells);
          const unsigned stateBehind = states[behind];
          if ((stateBehind & VisitedCell) == 0)
          {
            // The faces before this one were followed, too.
            states[cell] = static_cast<std::uint8_t>(state & ~((2U << face) - 1));
            states[behind] = static_cast<std::uint8_t>(stateBehind | VisitedCell);
            path[depth++] = behind;
            leaf = false;
            break;
          }
          cycle = cycle || (stateBehind & PlacedCell) == 0;
        }
      }
      if (leaf && !nextGaps.empty())
      {
        states[cell] = static_cast<std::uint8_t>(state & ~HidingFaces);
        for (std::int32_t& gap = nextGaps[cell]; leaf && gap < gaps.Begins[cell + 1]; ++gap)
        {
          const std::int32_t behind = gaps.Cells[gap];
          if ((states[behind] & VisitedCell) == 0)
          {
            states[behind] |= VisitedCell;
            path[depth++] = behind;
            leaf = false;
          }
          else
          {
            cycle = cycle || (states[behind] & PlacedCell) == 0;
          }
        }
      }
      if (leaf)
      {
        --depth;
        states[cell] = static_cast<std::uint8_t>(state | PlacedCell);
        write(cell);
      }
      TETRALUX_CHECK(depth <= numberOfCells);
    }
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
  this->UsedMethod = method;
  this->LooksForGaps = 0;
  this->Order.resize(size);

  if (method == VisibilityMethod::CentroidDistance)
  {
    tables.SortByDistance(view, isDrawn);
#pragma omp parallel for schedule(static) if (size > (1 << 14))
    for (std::int64_t i = 0; i < size; ++i)
    {
      this->Order[direction == VisibilityDirection::BackToFront ? i : size - 1 - i] =
        tables.KeyedCells[i].Item;
    }
    return this->Order;
  }

  if (!tables.Path)
  {
    tables.States.resize(tables.Geometry.GetNumberOfCells());
    tables.Path = NewArray<std::int32_t>(tables.Geometry.GetNumberOfCells());
  }
  tables.Arrows.Point(view, tables.States);
  Span<const KeyedItem> roots;
  if (method != VisibilityMethod::Meshed)
  {
    tables.SortByDistance(
      view, [&](std::int64_t cell) { return (tables.States[cell] & EnteredCell) != 0; });
    roots = tables.KeyedCells;
  }
  VisibilityGaps gaps;
  if (method == VisibilityMethod::MeshedAcrossGaps)
  {
    if (tables.Twins.size() != tables.Geometry.Boundary->Entries.size())
    {
      tables.Twins = FindTwinFaces(tables.Geometry);
    }
    if (!FindGaps(tables.Geometry, tables.Arrows, tables.Twins, view, gaps))
    {
      this->UsedMethod = VisibilityMethod::MeshedNonConvex;
    }
    this->LooksForGaps = gaps.Looked;
  }
  CellWriter write(this->Order, direction, ofMesh, drawn);
  if (tables.SortByArrows(roots, gaps, write))
  {
    return this->Order;
  }
  tables.Arrows.Point(view, tables.States);
  for (const std::int32_t cell :
    SortWithCycles(tables.Geometry, view, tables.States, gaps, roots, this->Cycles))
  {
    write(cell);
  }
  return this->Order;
}

//----------------------------------------------------------------------------
std::size_t VisibilityOrder::GetSize() const
{
  const Internals& tables = *this->Tables;
  return tables.Arrows.GetSize() +
    (tables.ImaginaryCells.size() + tables.Twins.capacity()) * sizeof(std::int32_t) +
    tables.States.size() * (1 + sizeof(std::int32_t)) +
    (tables.KeyedCells.capacity() + tables.KeyedBuffer.capacity()) * sizeof(KeyedItem) +
    this->Order.capacity() * sizeof(std::int32_t);
}

} // namespace tetralux
