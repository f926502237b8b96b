// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellPatch_h
#define CellPatch_h

#include "Mesh/TetrahedralMesh.h"

#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// A block of cells of any type that share their nodes, for tests: cells are added by their
/// corners, and nodes on edges, faces and in the middle are put where VTK's cell class wants them.
class CellPatch
{
public:
  using Position = std::array<double, 3>;

  /// Nodes are rounded to so many parts of a unit: many more than nodes of a cell are apart, and a
  /// multiple of all numbers up to 16, so that the means of up to 16 nodes of a grid are exact.
  static constexpr int PartsOfUnit = 720720;

  /// Adds a cell whose edges are straight between its corners.
  void AddCell(int type, const std::vector<Position>& corners);

  /// Adds a polyhedron; faces are positions in points.
  void AddPolyhedron(
    const std::vector<Position>& points, const std::vector<std::vector<int>>& faces);

  /// Fills a box of unit cells from (x, y, z) on with cells of a type: one each of the hexahedral
  /// ones, two wedges, six pyramids about the middle or twelve tetrahedra for each.
  void AddBoxes(int type, int x, int y, int z, int countX, int countY, int countZ);

  /// The grid, with point ids shuffled and points moved by a map.
  vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(
    std::uint64_t seed, const std::function<Position(const Position&)>& map) const;

  std::size_t GetNumberOfPoints() const { return this->Points.size(); }

private:
  std::int64_t AddPoint(const Position& x);

  struct CellEntry
  {
    int Type;
    std::vector<std::int64_t> Ids;
    std::vector<std::vector<std::int64_t>> Faces;
  };
  std::vector<Position> Points;
  std::map<Position, std::int64_t> IdOfPosition;
  std::vector<CellEntry> Cells;
};

/// An affine map with a positive determinant that is no similarity, and its determinant.
CellPatch::Position MapAffine(const CellPatch::Position& x);
double GetAffineDeterminant();

/// A smooth map under which no face of a grid of boxes stays planar.
CellPatch::Position MapWarped(const CellPatch::Position& x);

/// Sum of the signed volumes, and how many of them are not positive.
double GetVolume(const tetralux::TetrahedralMesh& mesh, std::int64_t* notPositive = nullptr);

/// Empty if every face is shared by two tetrahedra or lies on the boundary, all its points
/// in one of the planes of the box from 0 to size; else what is wrong. toBox takes mesh
/// points back to the box.
std::string FindConformityProblem(const tetralux::TetrahedralMesh& mesh,
  const std::function<CellPatch::Position(std::int64_t)>& toBox, const std::array<int, 3>& size);

#endif
