// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/FaceNeighbors.h"

#include "Base/CountingSort.h"
#include "Base/DisjointSets.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace tetralux
{
namespace
{

constexpr std::int32_t NoNeighbor = -1;

/// A cell's four points by ascending id, and for each the face opposite to it.
struct SortedCell
{
  std::int32_t Points[4];
  int Faces[4] = { 0, 1, 2, 3 };

  explicit SortedCell(const std::int32_t* points)
  {
    std::copy(points, points + 4, this->Points);
    this->Order(0, 1);
    this->Order(2, 3);
    this->Order(0, 2);
    this->Order(1, 3);
    this->Order(1, 2);
  }

private:
  void Order(int i, int j)
  {
    if (this->Points[j] < this->Points[i])
    {
      std::swap(this->Points[i], this->Points[j]);
      std::swap(this->Faces[i], this->Faces[j]);
    }
  }
};

/// The smallest point of a cell, or the second smallest one.
std::int32_t GetSmallPoint(const std::int32_t* points, bool second)
{
  const auto [min01, max01] = std::minmax(points[0], points[1]);
  const auto [min23, max23] = std::minmax(points[2], points[3]);
  return second ? std::min(std::max(min01, min23), std::min(max01, max23)) : std::min(min01, min23);
}

/// Matches the faces that have the same smallest point by their other two points: a hash table with
/// linear probing, small enough for the innermost cache.
class FaceMatcher
{
public:
  /// maximumSize: faces that one bucket holds at most.
  FaceMatcher(FaceNeighbors& result, std::int64_t maximumSize)
    : Result(result)
    , Slots(NewArray<Slot>(GetCapacity(maximumSize)))
  {
  }

  void Start(std::int64_t size)
  {
    const std::int64_t capacity = GetCapacity(size);
    this->Mask = static_cast<std::uint64_t>(capacity - 1);
    std::fill_n(this->Slots.get(), capacity, Slot{});
  }

  /// face: 4 * cell + face of the cell.
  void Add(std::int32_t secondPoint, std::int32_t thirdPoint, std::int32_t face)
  {
    const std::uint64_t key =
      static_cast<std::uint64_t>(secondPoint) << 32 | static_cast<std::uint32_t>(thirdPoint);
    // The bits in the middle of the product depend on both points; 2^64 divided by the golden ratio
    // spreads neighboring ids.
    std::uint64_t slotId = (key ^ key >> 29) * 0x9e3779b97f4a7c15u >> 32 & this->Mask;
    while (this->Slots[slotId].Count != 0 && this->Slots[slotId].Key != key)
    {
      slotId = (slotId + 1) & this->Mask;
    }

    Slot& slot = this->Slots[slotId];
    ++slot.Count;
    if (slot.Count == 1)
    {
      slot.Key = key;
      slot.Face = face;
    }
    if (slot.Count == 2)
    {
      this->Connect(face, slot.Face / 4, slot.Face % 4);
      this->Connect(slot.Face, face / 4, face % 4);
      return;
    }
    if (slot.Count == 3)
    {
      this->Connect(4 * this->Result.Neighbors[slot.Face] + this->Result.NeighborFaces[slot.Face],
        NoNeighbor, 0);
      this->Connect(slot.Face, NoNeighbor, 0);
      ++this->NumberOfNonManifoldFaces;
    }
    this->Connect(face, NoNeighbor, 0);
  }

  std::int64_t NumberOfNonManifoldFaces = 0;

private:
  struct Slot
  {
    std::uint64_t Key;
    std::int32_t Face; ///< the first one with the key
    std::int32_t Count = 0;
  };

  /// Most faces come in pairs: no more than about half of the slots are in use.
  static std::int64_t GetCapacity(std::int64_t size)
  {
    std::int64_t capacity = 8;
    while (capacity <= size)
    {
      capacity *= 2;
    }
    return capacity;
  }

  void Connect(std::int32_t face, std::int32_t neighbor, int neighborFace)
  {
    this->Result.Neighbors[face] = neighbor;
    this->Result.NeighborFaces[face] = static_cast<std::uint8_t>(neighborFace);
  }

  FaceNeighbors& Result;
  std::unique_ptr<Slot[]> Slots;
  std::uint64_t Mask = 0;
};

/// Fills Neighbors (NoNeighbor on the boundary), NeighborFaces and NumberOfNonManifoldFaces.
void MatchFaces(FaceNeighbors& result, Span<const std::int32_t> cells, std::int64_t numberOfPoints)
{
  // Three faces of a cell have the cell's smallest point as theirs, and one the second smallest:
  // entry 2 * cell stands for the three, entry 2 * cell + 1 for the one.
  const Buckets buckets =
    SortIntoBuckets(static_cast<std::int64_t>(cells.size() / 2), numberOfPoints,
      [&](std::int64_t entry) { return GetSmallPoint(&cells[entry / 2 * 4], entry % 2 != 0); });

  std::int32_t largestBucket = 0;
  for (std::int64_t point = 0; point < numberOfPoints; ++point)
  {
    largestBucket = std::max(largestBucket, buckets.Begin[point + 1] - buckets.Begin[point]);
  }

  std::int64_t numberOfNonManifoldFaces = 0;
  // Neighboring points are in neighboring cells: not too small pieces keep the threads apart.
#pragma omp parallel reduction(+ : numberOfNonManifoldFaces)
  {
    FaceMatcher matcher(result, std::int64_t{ 3 } * largestBucket);
#pragma omp for schedule(static, 4096)
    for (std::int64_t point = 0; point < numberOfPoints; ++point)
    {
      const std::int32_t begin = buckets.Begin[point];
      const std::int32_t end = buckets.Begin[point + 1];
      matcher.Start(std::int64_t{ 3 } * (end - begin));
      for (std::int32_t i = begin; i < end; ++i)
      {
        const std::int32_t cell = buckets.Items[i] / 2;
        const SortedCell sorted(&cells[std::size_t{ 4 } * cell]);
        const auto& points = sorted.Points;
        if (buckets.Items[i] % 2 == 0)
        {
          matcher.Add(points[2], points[3], 4 * cell + sorted.Faces[1]);
          matcher.Add(points[1], points[3], 4 * cell + sorted.Faces[2]);
          matcher.Add(points[1], points[2], 4 * cell + sorted.Faces[3]);
        }
        else
        {
          matcher.Add(points[2], points[3], 4 * cell + sorted.Faces[0]);
        }
      }
    }
    numberOfNonManifoldFaces += matcher.NumberOfNonManifoldFaces;
  }
  result.NumberOfNonManifoldFaces = numberOfNonManifoldFaces;
}

/// Lists the boundary faces and puts their numbers into Neighbors.
void NumberBoundaryFaces(FaceNeighbors& result)
{
  const auto numberOfFaces = static_cast<std::int64_t>(result.Neighbors.size());
  const int numberOfParts = omp_get_max_threads();
  std::vector<std::int32_t> first(numberOfParts + 1, 0);
  ForEachPart(numberOfParts, numberOfFaces,
    [&](int part, std::int64_t begin, std::int64_t end)
    {
      first[part + 1] = static_cast<std::int32_t>(
        std::count(result.Neighbors.data() + begin, result.Neighbors.data() + end, NoNeighbor));
    });
  std::partial_sum(first.begin(), first.end(), first.begin());

  result.BoundaryFaces.resize(first.back());
  ForEachPart(numberOfParts, numberOfFaces,
    [&](int part, std::int64_t begin, std::int64_t end)
    {
      std::int32_t boundaryFace = first[part];
      for (std::int64_t face = begin; face < end; ++face)
      {
        if (result.Neighbors[face] == NoNeighbor)
        {
          result.BoundaryFaces[boundaryFace] = static_cast<std::int32_t>(face);
          result.Neighbors[face] = ~boundaryFace++;
        }
      }
    });
}

std::int64_t CountComponents(const FaceNeighbors& result)
{
  const auto numberOfCells = static_cast<std::int64_t>(result.Neighbors.size() / 4);
  const int numberOfParts = omp_get_max_threads();
  DisjointSets sets(numberOfCells);
  std::int64_t numberOfUnions = 0;

  // Unites each cell of the part with the neighbors that come before it, from firstNeighbor on.
  const auto unite = [&](std::int64_t cell, std::int64_t firstNeighbor, std::int64_t lastNeighbor)
  {
    std::int64_t count = 0;
    for (int face = 0; face < 4; ++face)
    {
      const std::int32_t neighbor = result.Neighbors[4 * cell + face];
      if (neighbor >= firstNeighbor && neighbor < lastNeighbor)
      {
        count += sets.Unite(static_cast<std::int32_t>(cell), neighbor);
      }
    }
    return count;
  };

  // First inside each part, where the sets of the parts are disjoint; then across.
  std::vector<std::int64_t> unions(numberOfParts, 0);
  ForEachPart(numberOfParts, numberOfCells,
    [&](int part, std::int64_t begin, std::int64_t end)
    {
      std::int64_t count = 0;
      for (std::int64_t cell = begin; cell < end; ++cell)
      {
        count += unite(cell, begin, cell);
      }
      unions[part] = count;
    });
  numberOfUnions = std::accumulate(unions.begin(), unions.end(), numberOfUnions);
  for (int part = 1; part < numberOfParts; ++part)
  {
    const std::int64_t begin = numberOfCells * part / numberOfParts;
    const std::int64_t end = numberOfCells * (part + 1) / numberOfParts;
    for (std::int64_t cell = begin; cell < end; ++cell)
    {
      numberOfUnions += unite(cell, 0, begin);
    }
  }
  return numberOfCells - numberOfUnions;
}

} // namespace

//----------------------------------------------------------------------------
FaceNeighbors FindFaceNeighbors(Span<const std::int32_t> cells, std::size_t numberOfPoints)
{
  FaceNeighbors result;
  result.Neighbors.resize(cells.size());
  result.NeighborFaces.resize(cells.size());
  MatchFaces(result, cells, static_cast<std::int64_t>(numberOfPoints));
  NumberBoundaryFaces(result);
  result.NumberOfComponents = CountComponents(result);
  return result;
}

} // namespace tetralux
