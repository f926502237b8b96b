// SPDX-License-Identifier: BSD-3-Clause
#ifndef IntakeChecks_h
#define IntakeChecks_h

// What tests of the intake share.

#include "CellPatch.h"

#include "Mesh/FaceNeighbors.h"
#include "Mesh/TetrahedralMesh.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

/// The largest error of a volume, in cubed units of the meshes. Their volumes, up to 100, are sums
/// of a few hundred products of coordinates up to 10, each rounded by 1e-16 of its size.
inline constexpr double VolumeTolerance = 1e-12;

inline CellPatch::Position KeepPosition(const CellPatch::Position& x) { return x; }

inline std::size_t CountBoundaryFaces(const tetralux::TetrahedralMesh& mesh)
{
  return tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints()).BoundaryFaces.size();
}

/// As a boundary layer: a millionth in one direction, turned out of the axes.
inline CellPatch::Position MapFlat(const CellPatch::Position& x)
{
  const double z = 1e-6 * x[2];
  return { 0.8 * x[0] - 0.6 * z, x[1], 0.6 * x[0] + 0.8 * z };
}

// Corners in VTK's order.
inline const std::vector<CellPatch::Position> Tetrahedron = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 },
  { 0, 0, 1 } };
inline const std::vector<CellPatch::Position> Box = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 },
  { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
inline const std::vector<CellPatch::Position> VoxelCorners = { { 0, 0, 0 }, { 1, 0, 0 },
  { 0, 1, 0 }, { 1, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 } };
inline const std::vector<CellPatch::Position> Wedge = { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 },
  { 0, 0, 1 }, { 0, 1, 1 }, { 1, 0, 1 } };
inline const std::vector<CellPatch::Position> Pyramid = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 },
  { 0, 1, 0 }, { 0.5, 0.5, 1 } };

/// Where a point of the mesh was before the map: the same weights apply before and after.
inline std::function<CellPatch::Position(std::int64_t)> MakeToBox(
  vtkUnstructuredGrid* grid, const tetralux::TetrahedralMesh& mesh)
{
  vtkDataArray* unmapped = grid->GetPointData()->GetArray("Unmapped");
  return [unmapped, &mesh](std::int64_t point)
  {
    CellPatch::Position x = { 0, 0, 0 };
    const std::int64_t original = mesh.OriginalPoints.empty() ? point : mesh.OriginalPoints[point];
    if (original >= 0)
    {
      unmapped->GetTuple(original, x.data());
      return x;
    }
    const auto& added = mesh.AddedPoints;
    for (std::int64_t j = added.Offsets[-1 - original]; j < added.Offsets[-original]; ++j)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        x[axis] += added.Weights[j] * unmapped->GetComponent(added.Sources[j], axis);
      }
    }
    return x;
  };
}

#endif
