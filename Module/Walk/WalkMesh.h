// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_WalkMesh_h
#define tetralux_WalkMesh_h

#include "Base/Span.h"
#include "Convexify/Convexification.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/MeshCleaning.h"
#include "Mesh/TetrahedralMesh.h"
#include "TetraluxCoreModule.h"
#include "Walk/WalkTables.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace tetralux
{

/// The tables that a ray is walked through, built once for a mesh: 32 bytes a tetrahedron for the
/// topology and 16 a point for single precision; double precision costs 32 more a point, and only
/// once it is asked for.
///
/// The four points of each cell have ascending ids, and face i of a cell is the one opposite to its
/// i-th point: the index of a face then follows from comparing ids, and no table has to store how
/// neighbouring cells are turned against each other.
class TETRALUXCORE_EXPORT WalkMesh
{
public:
  /// Cleans and reorders the mesh (RemoveUnusableCells, OrderSpatially), finds its neighbours and
  /// boundary, and fills the tables: some 100 nanoseconds a tetrahedron on two threads.
  /// progress: called between the stages with the share that is done, 0..1; it may be empty. Where
  /// it returns false, the rest is left out: IsComplete() is false, and there are no cells.
  explicit WalkMesh(TetrahedralMesh mesh, const std::function<bool(double)>& progress = {});

  bool IsComplete() const { return this->Complete; }

  /// The mesh in the order of the tables; OriginalPoints and OriginalCells lead back to the input.
  const TetrahedralMesh& GetMesh() const { return this->Mesh; }

  std::int32_t GetNumberOfCells() const
  {
    return static_cast<std::int32_t>(this->Mesh.GetNumberOfCells());
  }

  const RemovedCells& GetRemovedCells() const { return this->Removed; }
  std::int64_t GetNumberOfNonManifoldFaces() const { return this->NumberOfNonManifoldFaces; }
  std::int64_t GetNumberOfComponents() const { return this->NumberOfComponents; }
  std::int32_t GetNumberOfBoundaryFaces() const
  {
    return static_cast<std::int32_t>(this->Tables.Entries.size());
  }

  /// A table's coordinates are (x - Center) / Radius: at most 1 in length. Radius is 1 for an empty
  /// mesh.
  const double* GetCenter() const { return this->Center; }
  double GetRadius() const { return this->Radius; }

  /// Half the edges of the box around the points, of which Center is the middle.
  const double* GetHalfSize() const { return this->HalfSize; }

  /// Moves the points: new coordinates of the points of GetMesh(), three each. Cells, their order
  /// and their neighbours stay; what follows from coordinates is made anew, and the boxes over the
  /// boundary are fitted. What MakeConvex added is dropped. Returns false, and changes nothing, if
  /// cells would have to come or go: a coordinate is not finite, or cells were removed since theirs
  /// were not. Throws std::invalid_argument if the number of coordinates is wrong.
  bool SetPoints(const std::vector<double>& points);

  /// The scalars of the points of GetMesh(), as (s - offset) / scale. Values that are not finite
  /// become not-a-number; cells that touch one contribute nothing.
  /// real: float or double, whichever table the next rays need; the other one is left as it was.
  template <class Real>
  void SetPointScalars(Span<const double> scalars, double offset, double scale);

  /// Makes the mesh convex by imaginary cells (Convexify), unless that was tried before. progress
  /// as there; after an abort it may be tried again.
  void MakeConvex(const std::function<bool(double)>& progress = {});

  /// Whether a ray that left the mesh never enters it again: tetralux::IsConvex, kept.
  bool IsConvex();

  /// What MakeConvex did; nullptr before it. Ids are those of GetMesh().
  const Convexification* GetConvexification() const { return this->Convex.get(); }

  /// The topology of all cells and the imaginary ones, which come behind; empty where there are
  /// none: before MakeConvex, where it was refused, and where the mesh is convex.
  const WalkTables& GetConvexTables() const { return this->ConvexTables; }

  /// Bytes of all tables, without GetMesh().
  std::size_t GetTableSize() const;

  template <class Real>
  const WalkPoint<Real>* GetPoints() const;
  /// Of the mesh, and behind them those that MakeConvex added.
  std::size_t GetNumberOfTablePoints() const { return this->FloatPoints.size(); }
  /// The topology of all cells.
  const WalkTables& GetTables() const { return this->Tables; }
  const WalkFace* GetFaces() const { return this->Tables.Faces.data(); }
  const WalkEntry* GetEntries() const { return this->Tables.Entries.data(); }
  const BoundaryBvh& GetBvh() const { return this->Tables.Bvh; }

private:
  void MeasureBox(); ///< center and radius
  template <class Real>
  std::vector<WalkPoint<Real>>& GetPointTable();
  template <class Real>
  void FillCoordinates();
  FaceNeighbors MakeNeighbors() const; ///< as FindFaceNeighbors, from Tables

  TetrahedralMesh Mesh;
  bool Complete = true;
  RemovedCells Removed;
  std::int64_t NumberOfNonManifoldFaces = 0;
  std::int64_t NumberOfComponents = 0;
  double Center[3] = { 0, 0, 0 };
  double HalfSize[3] = { 0, 0, 0 };
  double Radius = 1;
  std::vector<WalkPoint<float>> FloatPoints;
  std::vector<WalkPoint<double>> DoublePoints;
  WalkTables Tables;
  std::vector<double> SteinerPoints; ///< behind the points of the mesh in the tables
  std::unique_ptr<Convexification> Convex;
  WalkTables ConvexTables;
  std::optional<bool> Convexity;
};

} // namespace tetralux

#endif
