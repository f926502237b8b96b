// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IntakeChunk_h
#define tetralux_IntakeChunk_h

#include "Intake/IntakeReport.h"
#include "Mesh/TetrahedralMesh.h"

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// Cells that one task splits before its results are put aside: enough to make the overhead of a
/// task vanish, few enough to share the work evenly.
constexpr vtkIdType ChunkSize = 8192;

/// What one task made of its cells.
struct IntakeChunk
{
  std::vector<std::int32_t> Tetrahedra; ///< ids in the mesh, or -1 - k: point k added here
  std::vector<std::int64_t> Parents;    ///< ids of the block's cells
  std::vector<double> AddedCoordinates;
  std::vector<std::int64_t> AddedOffsets = { 0 };
  std::vector<std::int64_t> AddedSources; ///< ids in the mesh
  std::vector<double> AddedWeights;

  std::array<std::int64_t, 256> CellsByType = {};
  std::array<std::int64_t, 256> SkippedByType = {};
  std::int64_t GhostCells = 0;
  std::int64_t BlankedCells = 0;
  std::int64_t LowerDimensionalCells = 0;
  std::int64_t InvalidCells = 0;
  std::int64_t FoldedCells = 0;
};

/// Adds what a chunk counts to the report.
void AddCounts(const IntakeChunk& chunk, TetrahedraIntakeReport& report);

/// Puts chunks together in their order into a mesh that has the input's points, and frees them.
void GatherChunks(std::vector<IntakeChunk>& chunks, TetrahedralMesh& mesh);

} // namespace tetralux

#endif
