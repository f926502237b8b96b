// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/IntakeChunk.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tetralux
{

void AddCounts(const IntakeChunk& chunk, TetrahedraIntakeReport& report)
{
  for (int type = 0; type < 256; ++type)
  {
    if (chunk.CellsByType[type])
    {
      report.CellsByType[type] += chunk.CellsByType[type];
    }
    if (chunk.SkippedByType[type])
    {
      report.SkippedByType[type] += chunk.SkippedByType[type];
    }
  }
  report.GhostCells += chunk.GhostCells;
  report.BlankedCells += chunk.BlankedCells;
  report.LowerDimensionalCells += chunk.LowerDimensionalCells;
  report.InvalidCells += chunk.InvalidCells;
  report.FoldedCells += chunk.FoldedCells;
}

void GatherChunks(std::vector<IntakeChunk>& chunks, TetrahedralMesh& mesh)
{
  const std::size_t numberOfChunks = chunks.size();
  std::vector<std::int64_t> firstTetrahedron(numberOfChunks + 1, 0);
  std::vector<std::int64_t> firstAdded(numberOfChunks + 1, 0);
  std::vector<std::int64_t> firstSource(numberOfChunks + 1, 0);
  for (std::size_t i = 0; i < numberOfChunks; ++i)
  {
    const IntakeChunk& chunk = chunks[i];
    firstTetrahedron[i + 1] = firstTetrahedron[i] + chunk.Parents.size();
    firstAdded[i + 1] = firstAdded[i] + chunk.AddedOffsets.size() - 1;
    firstSource[i + 1] = firstSource[i] + chunk.AddedSources.size();
  }

  const std::int64_t addedPoints = firstAdded.back();
  const auto inputPoints = static_cast<std::int64_t>(mesh.GetNumberOfPoints());
  mesh.Cells.resize(4 * firstTetrahedron.back());
  mesh.OriginalCells.resize(firstTetrahedron.back());
  if (addedPoints > 0)
  {
    mesh.Points.resize(3 * (inputPoints + addedPoints));
    mesh.OriginalPoints.resize(inputPoints + addedPoints);
    std::iota(mesh.OriginalPoints.begin(), mesh.OriginalPoints.begin() + inputPoints, 0);
    for (std::int64_t k = 0; k < addedPoints; ++k)
    {
      mesh.OriginalPoints[inputPoints + k] = static_cast<std::int32_t>(-1 - k);
    }
    mesh.AddedPoints.Offsets.resize(addedPoints + 1, 0);
    mesh.AddedPoints.Sources.resize(firstSource.back());
    mesh.AddedPoints.Weights.resize(firstSource.back());
  }

  vtkSMPTools::For(0, static_cast<vtkIdType>(numberOfChunks), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const IntakeChunk chunk = std::move(chunks[i]);
        const auto added = static_cast<std::int32_t>(inputPoints + firstAdded[i]);
        std::transform(chunk.Tetrahedra.begin(), chunk.Tetrahedra.end(),
          mesh.Cells.begin() + 4 * firstTetrahedron[i],
          [added](std::int32_t point) { return point >= 0 ? point : added + (-1 - point); });
        std::copy(chunk.Parents.begin(), chunk.Parents.end(),
          mesh.OriginalCells.begin() + firstTetrahedron[i]);
        std::copy(chunk.AddedCoordinates.begin(), chunk.AddedCoordinates.end(),
          mesh.Points.begin() + 3 * (inputPoints + firstAdded[i]));
        for (std::size_t k = 1; k < chunk.AddedOffsets.size(); ++k)
        {
          mesh.AddedPoints.Offsets[firstAdded[i] + k] = firstSource[i] + chunk.AddedOffsets[k];
        }
        std::copy(chunk.AddedSources.begin(), chunk.AddedSources.end(),
          mesh.AddedPoints.Sources.begin() + firstSource[i]);
        std::copy(chunk.AddedWeights.begin(), chunk.AddedWeights.end(),
          mesh.AddedPoints.Weights.begin() + firstSource[i]);
      }
    });
}

} // namespace tetralux
