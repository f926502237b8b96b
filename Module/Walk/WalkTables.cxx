// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/WalkTables.h"

#include "Base/Check.h"

#include <algorithm>

namespace tetralux
{
namespace
{

/// Margin of the boundary's boxes, in radii: covers the rounding of a single precision projection
/// of a box (three products and sums of numbers up to 1, each rounded by 2^-24) eight times over.
constexpr float BoxMargin = 1.f / (1 << 19);

/// Cells that are numbered in one go; fixed, so that numbers do not depend on the threads.
constexpr std::int64_t ChunkSize = 1 << 14;

Span<const float> GetCoordinates(Span<const WalkPoint<float>> points)
{
  return { reinterpret_cast<const float*>(points.data()), 4 * points.size() };
}

} // namespace

std::size_t WalkTables::GetSize() const
{
  return this->Faces.size() * sizeof(WalkFace) + this->Entries.size() * sizeof(WalkEntry) +
    this->Bvh.Nodes.size() * sizeof(BoundaryBvh::Node) +
    this->Bvh.Triangles.size() * sizeof(std::int32_t);
}

WalkTables MakeWalkTables(RawVector<WalkFace> faces, Span<const std::int32_t> cells,
  Span<const WalkPoint<float>> points, Span<const std::uint8_t> selected)
{
  WalkTables tables;
  tables.Faces = std::move(faces);
  const std::int64_t numberOfCells = static_cast<std::int64_t>(cells.size() / 4);
  const std::int64_t chunks = (numberOfCells + ChunkSize - 1) / ChunkSize;
  const auto isBoundary = [&](std::int64_t cell, int face)
  {
    const std::int32_t behind = tables.Faces[4 * cell + face].Cell;
    return behind < 0 || (!selected.empty() && !selected[behind]);
  };

  std::vector<std::int32_t> first(chunks + 1, 0);
#pragma omp parallel for schedule(static)
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
  {
    std::int32_t count = 0;
    const std::int64_t end = std::min(numberOfCells, (chunk + 1) * ChunkSize);
    for (std::int64_t cell = chunk * ChunkSize; cell < end; ++cell)
    {
      if (selected.empty() || selected[cell])
      {
        for (int face = 0; face < 4; ++face)
        {
          count += isBoundary(cell, face);
        }
      }
    }
    first[chunk + 1] = count;
  }
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
  {
    first[chunk + 1] += first[chunk];
  }

  tables.Entries.resize(first[chunks]);
  std::vector<std::int32_t> triangles(3 * tables.Entries.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
  {
    std::int32_t entryId = first[chunk];
    const std::int64_t end = std::min(numberOfCells, (chunk + 1) * ChunkSize);
    for (std::int64_t cell = chunk * ChunkSize; cell < end; ++cell)
    {
      if (!selected.empty() && !selected[cell])
      {
        continue;
      }
      const std::int32_t* corners = &cells[4 * cell];
      TETRALUX_CHECK(0 <= corners[0] && corners[0] < corners[1] && corners[1] < corners[2] &&
        corners[2] < corners[3] && corners[3] < static_cast<std::int64_t>(points.size()));
      for (int face = 0; face < 4; ++face)
      {
        if (!isBoundary(cell, face))
        {
          continue;
        }
        WalkEntry& entry = tables.Entries[entryId];
        std::copy(corners, corners + face, entry.Points);
        std::copy(corners + face + 1, corners + 4, entry.Points + face);
        entry.Cell = static_cast<std::int32_t>(cell);
        entry.Opposite = corners[face];
        std::copy_n(entry.Points, 3, &triangles[3 * static_cast<std::size_t>(entryId)]);
        tables.Faces[4 * cell + face] = { ~entryId, corners[face] };
        ++entryId;
      }
    }
    TETRALUX_CHECK(entryId == first[chunk + 1]);
  }
  tables.Bvh = BuildBoundaryBvh(GetCoordinates(points), triangles, BoxMargin);
  return tables;
}

void RefitWalkTables(WalkTables& tables, Span<const WalkPoint<float>> points)
{
  std::vector<std::int32_t> triangles;
  triangles.reserve(3 * tables.Entries.size());
  for (const WalkEntry& entry : tables.Entries)
  {
    triangles.insert(triangles.end(), entry.Points, entry.Points + 3);
  }
  RefitBoundaryBvh(tables.Bvh, GetCoordinates(points), triangles, BoxMargin);
}

} // namespace tetralux
