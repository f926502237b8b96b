// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/MeshCleaning.h"

#include "Base/CountingSort.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tetralux
{
namespace
{

enum Verdict : std::uint8_t
{
  Usable,
  HasInvalidPointId,
  HasNonFiniteCoordinate,
  HasRepeatedPoint,
  IsDuplicate,
  NumberOfVerdicts
};

/// The points of a cell but its smallest, ascending: what tells apart the cells of one bucket.
struct CellKey
{
  std::int32_t Points[3];
  std::int32_t Cell;

  bool operator<(const CellKey& other) const
  {
    return std::tie(this->Points[0], this->Points[1], this->Points[2], this->Cell) <
      std::tie(other.Points[0], other.Points[1], other.Points[2], other.Cell);
  }
  bool HasSamePoints(const CellKey& other) const
  {
    return std::equal(this->Points, this->Points + 3, other.Points);
  }
};

CellKey MakeCellKey(const std::int32_t* cellPoints, std::int32_t cell)
{
  std::int32_t points[4];
  std::copy(cellPoints, cellPoints + 4, points);
  std::iter_swap(points, std::min_element(points, points + 4));
  const auto order = [&points](int i, int j)
  {
    const auto [smaller, larger] = std::minmax({ points[i], points[j] });
    points[i] = smaller;
    points[j] = larger;
  };
  order(1, 2);
  order(2, 3);
  order(1, 2);
  return { { points[1], points[2], points[3] }, cell };
}

/// For each point, whether a coordinate is infinite or not a number; nothing if none is.
std::unique_ptr<bool[]> FindNonFinitePoints(const TetrahedralMesh& mesh)
{
  const auto numberOfPoints = static_cast<std::int64_t>(mesh.GetNumberOfPoints());
  auto nonFinite = NewArray<bool>(numberOfPoints);
  bool any = false;
#pragma omp parallel for schedule(static) reduction(|| : any)
  for (std::int64_t point = 0; point < numberOfPoints; ++point)
  {
    const double* coordinates = &mesh.Points[3 * point];
    nonFinite[point] = !(std::isfinite(coordinates[0]) && std::isfinite(coordinates[1]) &&
      std::isfinite(coordinates[2]));
    any = any || nonFinite[point];
  }
  return any ? std::move(nonFinite) : nullptr;
}

Verdict JudgeAlone(
  const std::int32_t* points, std::int64_t numberOfPoints, const bool* nonFinitePoints)
{
  if (std::any_of(points, points + 4,
        [numberOfPoints](std::int32_t point) { return point < 0 || point >= numberOfPoints; }))
  {
    return HasInvalidPointId;
  }
  if (nonFinitePoints != nullptr &&
    std::any_of(
      points, points + 4, [nonFinitePoints](std::int32_t p) { return nonFinitePoints[p]; }))
  {
    return HasNonFiniteCoordinate;
  }
  const bool repeated = points[0] == points[1] || points[0] == points[2] ||
    points[0] == points[3] || points[1] == points[2] || points[1] == points[3] ||
    points[2] == points[3];
  return repeated ? HasRepeatedPoint : Usable;
}

void JudgeDuplicates(const TetrahedralMesh& mesh, Verdict* verdicts)
{
  const auto numberOfPoints = static_cast<std::int64_t>(mesh.GetNumberOfPoints());
  // By the smallest point; the last bucket takes the cells that go anyway.
  const Buckets buckets =
    SortIntoBuckets(static_cast<std::int64_t>(mesh.GetNumberOfCells()), numberOfPoints + 1,
      [&](std::int64_t cell) -> std::int64_t
      {
        const std::int32_t* points = &mesh.Cells[4 * cell];
        return verdicts[cell] == Usable
          ? std::min(std::min(points[0], points[1]), std::min(points[2], points[3]))
          : numberOfPoints;
      });

  std::int32_t largestBucket = 0;
  for (std::int64_t point = 0; point < numberOfPoints; ++point)
  {
    largestBucket = std::max(largestBucket, buckets.Begin[point + 1] - buckets.Begin[point]);
  }

#pragma omp parallel
  {
    const auto keys = NewArray<CellKey>(largestBucket);
#pragma omp for schedule(static, 4096)
    for (std::int64_t point = 0; point < numberOfPoints; ++point)
    {
      const std::int32_t begin = buckets.Begin[point];
      const std::int32_t size = buckets.Begin[point + 1] - begin;
      for (std::int32_t i = 0; i < size; ++i)
      {
        const std::int32_t cell = buckets.Items[begin + i];
        keys[i] = MakeCellKey(&mesh.Cells[std::size_t{ 4 } * cell], cell);
      }
      std::sort(keys.get(), keys.get() + size);
      for (std::int32_t i = 1; i < size; ++i)
      {
        if (keys[i].HasSamePoints(keys[i - 1]))
        {
          verdicts[keys[i].Cell] = IsDuplicate;
        }
      }
    }
  }
}

void KeepUsableCells(TetrahedralMesh& mesh, const Verdict* verdicts)
{
  const std::size_t numberOfCells = mesh.GetNumberOfCells();
  const bool isOriginal = mesh.OriginalCells.empty();
  mesh.OriginalCells.resize(numberOfCells);
  std::size_t kept = 0;
  for (std::size_t cell = 0; cell < numberOfCells; ++cell)
  {
    if (verdicts[cell] == Usable)
    {
      std::copy_n(&mesh.Cells[4 * cell], 4, &mesh.Cells[4 * kept]);
      mesh.OriginalCells[kept] =
        isOriginal ? static_cast<std::int32_t>(cell) : mesh.OriginalCells[cell];
      ++kept;
    }
  }
  mesh.Cells.resize(4 * kept);
  mesh.OriginalCells.resize(kept);
}

} // namespace

//----------------------------------------------------------------------------
RemovedCells RemoveUnusableCells(TetrahedralMesh& mesh)
{
  const auto numberOfPoints = static_cast<std::int64_t>(mesh.GetNumberOfPoints());
  const auto numberOfCells = static_cast<std::int64_t>(mesh.GetNumberOfCells());
  const auto nonFinitePoints = FindNonFinitePoints(mesh);
  const auto verdicts = NewArray<Verdict>(numberOfCells);
#pragma omp parallel for schedule(static)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    verdicts[cell] = JudgeAlone(&mesh.Cells[4 * cell], numberOfPoints, nonFinitePoints.get());
  }
  JudgeDuplicates(mesh, verdicts.get());

  std::int64_t counts[NumberOfVerdicts] = {};
#pragma omp parallel for schedule(static) reduction(+ : counts)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    ++counts[verdicts[cell]];
  }
  if (counts[Usable] != numberOfCells)
  {
    KeepUsableCells(mesh, verdicts.get());
  }
  return { counts[HasInvalidPointId], counts[HasNonFiniteCoordinate], counts[HasRepeatedPoint],
    counts[IsDuplicate] };
}

} // namespace tetralux
