// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshScene_h
#define tetralux_MeshScene_h

#include "Base/Cached.h"
#include "Integral/RaySegments.h"
#include "Mesh/Gradients.h"
#include "TetraluxCoreModule.h"
#include "Walk/WalkMesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace tetralux
{

/// A mesh and its scalars, of one time step, and what follows from both alone.
///
/// Cells, points and scalars are replaced each by itself. Versions say which of them changed; what
/// follows is made anew only if a version that it depends on did.
class TETRALUXCORE_EXPORT MeshScene
{
public:
  /// Replaces cells and points. Scalars must be set after it.
  void SetMesh(std::shared_ptr<WalkMesh> mesh);

  /// Moves the points of the same cells: WalkMesh::SetPoints. Scalars stay. Returns false, and
  /// changes nothing, where the mesh has to be made anew.
  bool SetPoints(const std::vector<double>& points);

  WalkMesh* GetMesh() const { return this->Mesh.get(); }

  /// Replaces the scalars: one for each point, or for each cell, of WalkMesh::GetMesh(). Cells that
  /// touch a scalar which is not finite contribute nothing. Throws std::invalid_argument if their
  /// number is wrong or there is no mesh.
  ///@{
  void SetPointScalars(std::vector<double> scalars);
  void SetCellScalars(std::vector<double> scalars);
  ///@}
  const std::vector<double>& GetScalars() const { return this->Scalars; }

  /// Sets further scalars of the same points or cells, for SceneOptics::SetComponents. Where one of
  /// them is not finite, the first one must not be. New scalars remove them. Throws
  /// std::invalid_argument if a number of them is wrong.
  void SetOtherScalars(std::vector<std::vector<double>> scalars);
  const std::vector<std::vector<double>>& GetOtherScalars() const { return this->OtherScalars; }

  bool HasCellScalars() const { return this->ScalarsOfCells; }

  /// Sets scalars at points that isosurfaces are coloured by, in place of their values; empty: they
  /// are not. New cells remove them. Throws std::invalid_argument if their number is wrong.
  void SetColorScalars(std::vector<double> scalars);
  const std::vector<double>& GetColorScalars() const { return this->ColorScalars; }

  /// Whether there are as many scalars as the mesh needs.
  bool IsComplete() const;

  /// Least and largest finite scalar; 0 and 0 if there is none.
  const double* GetScalarRange() const { return this->ScalarRange; }

  /// Cells that touch a scalar which is not finite.
  std::int64_t GetNumberOfBlankCells() const { return this->NumberOfBlankCells; }

  /// Versions of the cells, of the coordinates of their points, of the scalars with the further
  /// ones, and of those to colour by; 0: none. New cells are new points, too.
  ///@{
  std::uint64_t GetCellsVersion() const { return this->CellsVersion; }
  std::uint64_t GetPointsVersion() const { return this->PointsVersion; }
  std::uint64_t GetScalarsVersion() const { return this->ScalarsVersion; }
  std::uint64_t GetColorScalarsVersion() const { return this->ColorScalarsVersion; }
  ///@}

  /// Brings the longest edge, or the gradients, up to date.
  ///@{
  void PrepareLongestEdge();
  void PreparePointGradients();
  void PrepareCellGradients();
  ///@}

  /// Of the mesh, in its units. After PrepareLongestEdge.
  double GetLongestEdge() const { return this->LongestEdge.Get(); }

  /// Gradients of scalars at points, for smooth lighting: MakePointGradients in units of the mesh's
  /// radius and of half of the scalars' range. After PreparePointGradients.
  const std::vector<GradientRow>& GetPointGradients() const { return this->PointGradients.Get(); }

  /// Gradients of scalars in cells, in the same units. After PrepareCellGradients.
  const std::vector<GradientRow>& GetCellGradients() const { return this->CellGradients.Get(); }

  /// What gradients count scalars in: half of their range, or 1 where that is 0.
  double GetGradientUnit() const;

  /// DrawMeshRays; the same until the mesh, the scalars or the scale change. scale: world units of
  /// a length in the mesh.
  std::shared_ptr<const RaySample> DrawRays(double scale);

private:
  void SetScalars(std::vector<double> scalars, bool ofCells);
  void CountBlankCells();

  std::shared_ptr<WalkMesh> Mesh;
  std::vector<double> Scalars;
  std::vector<std::vector<double>> OtherScalars;
  bool ScalarsOfCells = false;
  double ScalarRange[2] = { 0, 0 }; ///< of the finite ones
  std::int64_t NumberOfBlankCells = 0;
  std::uint64_t CellsVersion = 0;
  std::uint64_t PointsVersion = 0;
  std::uint64_t ScalarsVersion = 0;
  std::vector<double> ColorScalars;
  std::uint64_t ColorScalarsVersion = 0;
  Cached<double> LongestEdge;
  Cached<std::vector<GradientRow>> PointGradients;
  Cached<std::vector<GradientRow>> CellGradients;
  Cached<std::shared_ptr<const RaySample>> Rays; ///< lengths as in the mesh
  Cached<std::shared_ptr<const RaySample>> ScaledRays;
};

} // namespace tetralux

#endif
